// From the table and the runs on disk to one result a row.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "compare/checks/check.hpp"
#include "compare/checks/verdict.hpp"
#include "compare/engine/order.hpp"
#include "compare/input/run.hpp"

namespace granvof::compare {

struct Paths {
  std::filesystem::path runs;     // out/runs
  std::filesystem::path cases;    // cases
  std::filesystem::path records;  // reference/results
};

// What the user left out by name; it is reported as not run, and does not turn the exit code.
struct LeftOut {
  bool records = false;  // rows that are judged by a record
  bool canary = false;
};

struct Result {
  Check check;
  std::string unit;
  std::optional<double> value;
  std::optional<double> reference;
  double band = 0.0;
  Judgement judgement;
  std::string note;  // why there is no value or no verdict; empty otherwise
};

struct RunSummary {
  PlannedRun plan;
  RunState state = RunState::missing;
  std::string reason;
  std::optional<RunFacts> facts;
};

struct Evaluation {
  std::vector<RunSummary> runs;
  std::vector<Result> results;
  std::vector<Cause> causes;                        // of the table
  std::map<std::string, Run> usable;                // the runs that could be read, by id
  std::map<std::string, std::vector<Run>> records;  // recorded variants that could be read, by record
  std::map<std::string, std::vector<Run>> peers;    // stock programs' runs of the same case, by run

  int unexpected() const;
};

// Rows due at `frequency`, in the order of the table.
std::vector<Check> due_checks(const Table& table, Frequency frequency);
// The runs those rows read, in the order of the table.
std::vector<PlannedRun> due_runs(const Table& table, Frequency frequency);
// Those runs as orders of the run engine, into RUNS/ID; timed where a due row is of their cost.
std::vector<Order> orders_of(const Table& table, Frequency frequency, const Paths& paths);

// What the driver found when it ran the reference's canary: agrees, differs or not_run, and why.
struct Canary {
  Verdict verdict = Verdict::not_run;
  std::string note;
};

// The row that says so, for the end of the table; red unless it agrees or was left out.
Result canary_result(const Canary& canary, const LeftOut& left_out);

// A run, record or file that is damaged is an error of the rows that take it, and every other row is judged;
// a damaged record that no row takes, but the plots, has a row of its own.
// Throws CaseError if a case file of the table cannot be read, TableError if no check is due, OutputError if
// bands.json is damaged.
Evaluation evaluate(const Table& table, Frequency frequency, const Paths& paths,
                    const LeftOut& left_out = {});

}  // namespace granvof::compare
