// mu(I) = mu_s + (mu_2 - mu_s) / (I_0 / I + 1), Jop, Forterre & Pouliquen, Nature 441 (2006), fitted to
// points.
#pragma once

#include <vector>

namespace demvof {

struct FrictionPoint {
  double inertial_number = 0.0;  // I [-]
  double friction = 0.0;         // mu [-]
};

struct FrictionLaw {
  double at_rest = 0.0;  // mu_s [-]
  double limit = 0.0;    // mu_2 [-]
  double scale = 0.0;    // I_0 [-]
  double operator()(double inertial_number) const;
};

struct FrictionFit {
  FrictionLaw law;
  FrictionLaw band;  // half width of each parameter: twice its jackknife standard error
  double rms = 0.0;  // of the points about the law [-]
};

// Least squares; I_0 searched in [0.01, 10]. Throws std::invalid_argument with fewer than four points.
FrictionFit fit_friction(const std::vector<FrictionPoint>& points);

}  // namespace demvof
