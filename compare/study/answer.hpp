// The value that `advise` was asked for, and what it is good to.
#pragma once

#include <optional>
#include <string>

#include "compare/study/advise_scene.hpp"

namespace granvof::compare {

// All in the unit of the quantity.
struct Answer {
  bool confirmed = false;     // of the configuration that is advised; else of the reference
  double value = 0.0;         // of a curve: at its end
  std::optional<double> end;  // of a curve: where that is
  // Against our own finest grid: the largest of what grids differ by.
  std::optional<double> by_grid;
  // Likewise: what the preset was off by in the nearest recorded scene, taken over to this value; nothing:
  // not known.
  std::optional<double> by_model;
  // Against another reference: the distance from it; of the reference itself its uncertainty.
  std::optional<double> by_both;
};

// Nothing where neither a configuration nor the reference has a value.
std::optional<Answer> answer_of(const AdviseReport& report);

// "answer: run_out@3 0.74 [-], +- 0.03 by the grid, ...".
std::string answer_text(const AdviseReport& report, const Answer& answer);

}  // namespace granvof::compare
