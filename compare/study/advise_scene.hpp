// `granvof-compare advise`: the walk of advise.hpp on a real scene, and its answer as a case file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "compare/study/advise.hpp"
#include "compare/study/runner.hpp"
#include "compare/study/target.hpp"

namespace granvof::compare {

struct AdviseInput {
  std::filesystem::path case_file;
  std::vector<std::string> set;  // overrides of all runs
  Quantity quantity;
  double tolerance = 0.05;    // relative, > 0
  std::vector<double> cells;  // large to small, at least two
  std::filesystem::path records;
  std::vector<Check> checks;  // rows of this scene, for the theory of a metric
  std::vector<Panel> panels;  // of the chart of this scene, for a published series and the reference method
  std::optional<Against> against = std::nullopt;  // the reference; nothing: the first that there is
};

struct AdviseReport {
  std::string scene, version;
  AdviseInput input;
  Target target;
  Advice advice;
  std::vector<std::string> set;  // of the chosen configuration, all overrides
};

// The reference is the DEM records of the scene where there are some, else theory or a published series, else
// our own finest grid (of the first method, unless the panels name another; it is no reference for a method
// of other equations, which is then not tried); or the one that the input names. Throws std::runtime_error
// where there is none.
AdviseReport advise_scene(const AdviseInput& input, const std::vector<Method>& methods,
                          const std::vector<Part>& parts, Runner& runner);

std::string advise_text(const AdviseReport& report);
std::string advise_json(const AdviseReport& report);

// A case based on `case_file` with `set`, for a file `name`.toml in `directory`; its header is the evidence.
std::string advised_case(const AdviseReport& report, const std::filesystem::path& directory,
                         const std::string& name);

}  // namespace granvof::compare
