// One row of the table of checks (compare/checks.toml), as data.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compare/checks/parameters.hpp"

namespace granvof::compare {

// How often a row is checked; each includes those before it.
enum class Frequency { short_, verify, nightly, weekly };

// Where the reference comes from.
enum class ReferenceKind { theory, published, dem, aim, regression };

// What the value is asked to be, relative to the reference.
enum class Relation { equal, at_most, at_least };

struct Reference {
  ReferenceKind kind = ReferenceKind::theory;
  std::string source;                  // equation, citation or record, as shown in the report
  std::optional<double> value;         // typed number, in the metric's unit
  std::optional<std::string> formula;  // name in checks/theory.hpp, computed from the scene
  std::optional<std::string> record;   // scene of reference/results whose variants carry the same metric
  double band = 0.0;                   // uncertainty of the reference (half width), in the metric's unit
};

struct Tolerance {
  double value = 0.0;     // >= 0
  bool relative = false;  // to the magnitude of the reference
  std::string unit;       // of an absolute tolerance; equals the metric's unit
};

// A failure that is known: its cause, and how far off it may be before it counts as worse.
struct ExpectedFailure {
  std::string reason;
  double distance = 0.0;  // largest distance from the tolerance's edge to be accepted as known, metric's unit
  std::string cause;      // key of a Cause; empty in a table that declares none
};

// What several expected failures have in common.
struct Cause {
  std::string key, text;
};

struct Check {
  std::string id;     // unique
  std::string label;  // tells rows of the same metric apart; may be empty
  std::string run;    // id of the run it reads
  std::string metric;
  Parameters parameters;
  Reference reference;
  Relation relation = Relation::equal;
  Tolerance tolerance;
  bool asserted = true;  // false: reported with its verdict, which does not count
  Frequency frequency = Frequency::verify;
  std::optional<ExpectedFailure> expected_failure;
  int line = 0;  // in the table
};

// A run the table needs: `granvof run <case_file> --set ... --out <runs>/<id>`.
struct PlannedRun {
  std::string id;                                    // directory below out/runs
  std::string case_name;                             // file stem in cases/
  std::vector<std::string> set;                      // overrides "key=value"
  std::optional<std::string> beside = std::nullopt;  // id of a run whose checks are made of this one too, but
                                                     // for those of kind regression
  Frequency frequency = Frequency::short_;           // of a run beside another: its checks are due no oftener
};

struct Table {
  std::vector<PlannedRun> runs;
  std::vector<Check> checks;
  std::vector<Cause> causes;
};

std::string_view name_of(Frequency frequency);
std::string_view name_of(ReferenceKind kind);
std::string_view name_of(Relation relation);

}  // namespace granvof::compare
