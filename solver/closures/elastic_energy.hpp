// Energy stored by the elastic contact pressure (13), tabulated.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "solver/closures/contact_pressure.hpp"

namespace granvof::closures {

// E(f_s) [J/m3] of a bed compressed from f_s,min: what its expansion gives back. From P dV = -dE per grain
// volume, E = f_s int_{f_s,min}^{f_s} P_s^ES / x^2 dx. The integral is tabulated once (Simpson) and read by a
// cubic through values and slopes; beyond `end` it goes on along the last cubic.
class ElasticEnergy {
 public:
  explicit ElasticEnergy(const Contact& contact, double end = 0.7)
      : contact_(contact), start_(contact.solid_fraction_min), step_((end - start_) / pieces) {
    integral_.push_back(0.0);
    slope_.push_back(0.0);
    for (int i = 0; i < pieces; ++i) {
      const double a = start_ + i * step_;
      const double middle = integrand(a + 0.5 * step_), last = integrand(a + step_);
      integral_.push_back(integral_.back() + step_ / 6.0 * (slope_.back() + 4.0 * middle + last));
      slope_.push_back(last);
    }
  }

  // f_s in [0, 1].
  double operator()(double f_s) const {
    if (f_s <= start_) return 0.0;
    const double position = (f_s - start_) / step_;
    const int i = std::min(static_cast<int>(position), pieces - 1);
    const double s = position - i, rest = 1.0 - s;
    const double cubic = rest * rest * ((1.0 + 2.0 * s) * integral_[i] + s * step_ * slope_[i]) +
                         s * s * ((3.0 - 2.0 * s) * integral_[i + 1] - rest * step_ * slope_[i + 1]);
    return f_s * cubic;
  }

 private:
  static constexpr int pieces = 512;
  double integrand(double f) const { return elastic_pressure(f, contact_).value / (f * f); }

  Contact contact_;
  double start_, step_;
  std::vector<double> integral_, slope_;
};

}  // namespace granvof::closures
