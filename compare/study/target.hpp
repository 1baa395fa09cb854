// What an error is measured against, with the reference's own uncertainty.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "compare/checks/evaluate.hpp"
#include "compare/study/quantity.hpp"

namespace granvof::compare {

struct Target {
  std::string kind;            // "DEM", "theory", "published" or "own finest grid"
  std::string source;          // record, formula, citation, or grid and method
  Observed observed;           // undefined where there is no such reference: `note` says why
  double floor = 0.0;          // relative uncertainty: an error below it means nothing [-]
  std::optional<double> cost;  // of a DEM reference [core-s per simulated s], one variant
  std::string note;
};

inline constexpr const char* kind_of_own = "own finest grid";

// Mean of the records of `name` that belong to `scene`; floor: half of the largest distance between two of
// them, at least what relative_uncertainty() says.
Target dem_target(const Quantity& quantity, const Scene& scene, const std::filesystem::path& records,
                  const std::string& name);
// A formula of checks/theory.hpp, computed from `run`.
Target theory_target(const Run& run, const std::string& formula);
// A series of cases/published.
Target published_target(const Run& run, const std::string& file, const std::string& column);
// Our own run; floor: how far the run on the next coarser cells is from it.
Target own_target(const Quantity& quantity, const Run& finest, const std::string& method, const Run* coarser);

}  // namespace granvof::compare
