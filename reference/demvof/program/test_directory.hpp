// Run directory of tests of a case's beads: the chute's windows as series.csv, numbers as monitors of
// run.json.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "reference/demvof/bulk_friction/chute.hpp"
#include "reference/demvof/program/record_scene.hpp"

namespace demvof {

// Before hours of work: granvof::OutputError unless options.out is new or empty, or holds earlier tests of
// the same scene of the same kind, told by their monitor `sign`.
void require_own_tests(const std::filesystem::path& out, const granvof::Scene& scene,
                       const std::string& sign);

// granvof::CaseError for beads that LIGGGHTS does not accept, and where nothing weighs.
void check_tests(const granvof::Scene& scene);

// Does `tests` in a process of their own, with a scratch folder, once the two above have passed. Returns the
// exit code; nothing is written before the end of the tests, and nothing is where they are stopped.
using Tests = std::function<int(const granvof::Scene& scene, const RecordOptions& options,
                                const std::filesystem::path& scratch)>;
int record_tests(const granvof::Scene& scene, const RecordOptions& options, const std::string& sign,
                 const Tests& tests);

// The chute of the case's beads; scratch is the folder for intermediate files.
ChuteSettings chute_settings(const granvof::Scene& scene, unsigned seed, const std::string& scratch);

using Monitors = std::map<std::string, double>;
// Fit, bands and angles of a chute.
Monitors friction_monitors(const ChuteResult& result, const FrictionFit& fit);
FrictionFit fit_of(const ChuteResult& result);

class TestClock {
 public:
  TestClock();
  const std::string& date() const { return date_; }
  double wall_seconds() const;

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::string date_;
};

// Throws granvof::OutputError.
void write_tests(const granvof::Scene& scene, const RecordOptions& options, const TestClock& clock,
                 const ChuteResult& result, const Monitors& monitors);

}  // namespace demvof
