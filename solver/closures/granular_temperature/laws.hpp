// What of (7) is solved, that model.granular_temperature chooses from. The first is the paper's. Each says
//   agitates: grains have a Theta at all,
//   is_transported: it is carried and conducted, and changes in time; else in steady balance.
// Equations: docs/theory/kinetic-theory.md.
#pragma once

#include "solver/closures/granular_temperature/algebraic.hpp"
#include "solver/closures/granular_temperature/off.hpp"
#include "solver/closures/granular_temperature/transported.hpp"
#include "solver/model/laws.hpp"

namespace granvof::closures {

struct TemperatureModels : Choices<TemperatureTransported, TemperatureAlgebraic, TemperatureOff> {};

inline bool agitates(TemperatureModel chosen) {
  return chosen.with([](auto model) { return model.agitates; });
}
inline bool is_transported(TemperatureModel chosen) {
  return chosen.with([](auto model) { return model.is_transported; });
}

}  // namespace granvof::closures
