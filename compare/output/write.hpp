// What a comparison leaves behind: results.json, results.csv, junit.xml, curves.json and a table for the
// terminal.
#pragma once

#include <filesystem>
#include <string>

#include "compare/checks/evaluate.hpp"

namespace granvof::compare {

// Columns: scene,metric,value,unit,reference,reference_kind,reference_source,tolerance,verdict.
std::string results_csv(const Evaluation& evaluation);
// All of it: rows with distances and notes, runs with cost, host and hashes, counts of verdicts.
std::string results_json(const Evaluation& evaluation, Frequency frequency, const std::string& date);
// One test case a row; unexpected verdicts are failures, what was not run or is stale counts as skipped.
std::string junit_xml(const Evaluation& evaluation);
// Derived curves of runs and records, by the same code as the metrics, for the plots.
std::string curves_json(const Evaluation& evaluation);
// One line a row, unexpected ones marked, and a summary line.
std::string terminal_table(const Evaluation& evaluation);

// Tolerance as shown to people: "1e-12 [-]", "10 %", "0.01 [-], at most", "reported".
std::string tolerance_text(const Check& check);

// Metric with its parameter: "run_out@10".
std::string metric_label(const Check& check);

}  // namespace granvof::compare
