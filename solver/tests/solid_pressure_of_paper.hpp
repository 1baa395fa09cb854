// P_s and P_s^E of the paper's collisions where the grains touch at f_s,min, for tests that vary one thing.
#pragma once

#include "solver/closures/solid_pressure.hpp"

namespace granvof::test {

inline closures::PressureAndSlope solid_pressure(double f_s, double theta, double e, double rho_s,
                                                 const Contact& c, bool dense_excess, double resting = 0.0) {
  return closures::solid_pressure(f_s, {theta, e, resting, c.solid_fraction_min},
                                  closures::SolidLaw(rho_s, c, dense_excess));
}
inline double enduring_pressure(double f_s, double theta, double e, double rho_s, const Contact& c,
                                bool dense_excess, double resting = 0.0) {
  return closures::enduring_pressure(f_s, {theta, e, resting, c.solid_fraction_min},
                                     closures::SolidLaw(rho_s, c, dense_excess));
}

}  // namespace granvof::test
