// How alike two scenes are, by their dimensionless numbers, and what the model's error was in those that have
// a record: what a finer grid does not mend.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compare/checks/check.hpp"
#include "compare/study/quantity.hpp"
#include "solver/scene/scene.hpp"

namespace granvof::compare {

struct Number {
  std::string_view name;
  double value;  // > 0
};

// What surrounds the grains, and the numbers that a bed of them is told by.
struct SceneNumbers {
  std::string_view surroundings;  // "no grains", "dry", "submerged", "floating", "above liquid", "partly wet"
  // With a bed: density ratio rho_s / rho_f, Stokes number (of a grain that falls freely,
  // sqrt(rho_s |rho_s - rho_f| g d^3) / (18 mu_f), Courrech du Pont et al. 2003), aspect ratio h0 / l0,
  // grains over the height h0 / d. f is the liquid where the bed's foot is in it. Without: aspect ratio of
  // the liquid.
  std::vector<Number> numbers;
};

SceneNumbers numbers_of(const Scene& scene);

// Rows of a comparison that are kept, as far as they tell an error of the model.
struct KnownRow {
  std::string run;     // id
  std::string metric;  // with its instant, as "run_out@10"
  std::string reference_kind;
  double value;
  double reference;
};

// From the rows of results.json (`granvof-compare check`) or of compare/kept/verify. Throws
// std::runtime_error where the file cannot be read.
std::vector<KnownRow> read_known_rows(const std::filesystem::path& file);

// What a model was off by in one recorded scene.
struct ModelError {
  std::string run;     // id in the table of checks
  std::string preset;  // of the model
  std::string kind;    // of the reference
  // Relative [-]: of a curve the rms over its recorded instants, over the largest reference; of a value the
  // smallest and the largest over its instants.
  double lowest, highest;
  int instants;
};

struct LikeScene {
  std::string case_name;
  SceneNumbers numbers;
  double farthest;  // largest factor between two numbers of the scenes, >= 1
  std::vector<ModelError> errors;
};

// Scenes of the table that records or published series judge in this quantity (a metric by its name, whatever
// its instant), in the same surroundings, without the scene itself; the nearest first: by the sum of squares
// of the logarithms of the ratios of the numbers. At most `most`.
std::vector<LikeScene> like_scenes(const Scene& scene, const Quantity& quantity, const Table& table,
                                   std::span<const KnownRow> rows, const std::filesystem::path& cases,
                                   std::size_t most = 2);

// Factor between two numbers of two scenes up to which they are called near.
inline constexpr double near_factor = 2.0;

// `preset` of the scene's model.
std::string preset_of(const Scene& scene);

// Lines for people: each scene with the two sets of numbers and what each preset was off by.
std::vector<std::string> likeness_text(const SceneNumbers& here, const std::vector<LikeScene>& scenes);

}  // namespace granvof::compare
