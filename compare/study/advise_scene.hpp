// `granvof-compare advise`: the walk of advise.hpp on a real scene, and its answer as a case file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "compare/study/advise.hpp"
#include "compare/study/like_scene.hpp"
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
  std::vector<LikeScene> like{};                  // recorded scenes, the nearest first
};

// A reference whose own uncertainty is more than this share of the tolerance cannot tell whether it is met.
inline constexpr double largest_floor = 0.5;

// A preset's result on the cells where all are tried.
struct OtherModel {
  std::string method;
  std::optional<double> distance;  // from that of the model that is advised on, relative [-]
  std::string failure;
  std::string preset{};           // that it makes; empty: none
  std::optional<double> value{};  // in the unit of the quantity; nothing: a curve, or it has none
  double cost = 0.0;              // [core-s per simulated s]
};

struct AdviseReport {
  std::string scene, version;
  AdviseInput input;
  Target target;
  Advice advice;
  std::vector<std::string> set;  // of the chosen configuration, all overrides
  std::string refusal;           // why nothing can be told; empty: it can
  SceneNumbers numbers{};
  std::string model{};               // against our own finest grid: the method that stands for it
  OtherModel itself{};               // likewise, its result
  std::vector<OtherModel> others{};  // likewise, those of the other presets
  double others_cell = 0.0;          // where they were tried [m]
  Observed observed{};               // of the chosen configuration
  std::string preset{};              // of its model; where none was chosen, of our own finest grid
};

// Each with the preset that it makes in this scene, where it makes one.
std::vector<Method> with_presets(std::vector<Method> methods, const AdviseInput& input);

// Cell sizes to walk by default: of `grids` (of the scene's chart), else of four, two, one, a half and a
// quarter times the case's own, those not below a grain [m], large to small; at least two.
std::vector<double> cells_to_advise(const std::vector<double>& grids, const Scene& scene);

// All that a walk may run, one list a size of cells: what advise_scene() runs at most.
std::vector<std::vector<Job>> jobs_of(const AdviseInput& input, const std::vector<Method>& methods,
                                      const std::vector<Part>& parts);

// The reference is the DEM records of the scene where there are some, else theory or a published series, else
// our own finest grid; or the one that the input names. Our own finest grid is of one model, and only methods
// of that model are tried: of the preset that was off by least in the nearest recorded scene, where one is
// near, else of the scene's own; the other presets are then run once, and what they differ by is stated. A
// reference with an uncertainty above `largest_floor` of the tolerance is refused before the walk. Throws
// std::runtime_error where there is no reference.
AdviseReport advise_scene(const AdviseInput& input, const std::vector<Method>& methods,
                          const std::vector<Part>& parts, Runner& runner);

// What the figure is and what it is worth, then the answer.
std::vector<std::string> advise_summary(const AdviseReport& report);
std::string advise_text(const AdviseReport& report);
// Lines of a table, a column a preset: what each gives, what it was off by in the nearest recorded scene, and
// its cost; none where no others were tried.
std::vector<std::string> presets_table(const AdviseReport& report);
std::string advise_json(const AdviseReport& report);

// A case based on `case_file` with `set`, for a file `name`.toml in `directory`; its header is the evidence.
std::string advised_case(const AdviseReport& report, const std::filesystem::path& directory,
                         const std::string& name);

}  // namespace granvof::compare
