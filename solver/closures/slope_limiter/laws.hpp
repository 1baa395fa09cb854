// The slopes within a cell that bound what a face carries of the grains, that numerics.solid_flux chooses
// from. The first is the paper's. Each has
//   second_order: it makes fluxes of second order where f_s is smooth,
//   slope(a, b): between the differences to both sides, in their units; symmetric, 0 at an extremum.
#pragma once

#include "solver/closures/slope_limiter/none.hpp"
#include "solver/closures/slope_limiter/superbee.hpp"
#include "solver/closures/slope_limiter/van_leer.hpp"
#include "solver/model/laws.hpp"

namespace granvof::closures {

struct SlopeLimiters : Choices<LimiterNone, LimiterVanLeer, LimiterSuperbee> {};

inline bool is_of_second_order(SlopeLimiter chosen) {
  return chosen.with([](auto limiter) { return limiter.second_order; });
}

}  // namespace granvof::closures
