// Energy stored by the elastic contact pressure (13), tabulated.
// Equations: docs/theory/contact.md.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "solver/closures/contact_pressure.hpp"

namespace granvof::closures {

// E [J/m3] of a bed at f_s whose grains touch at f_p: what its expansion gives back. From P dV = -dE per
// grain volume, E = f_s int_{f_p}^{f_s} P_s^ES / x^2 dx. With P_s^ES = x g(x - f_p), y = x - f_p this is f_s
// int g / (f_p + y) dy. Tabulated once (Simpson) are I = int g / (f_s,min + y) dy and G = int g dy; E = f_s I
// G / (G + (f_p - f_s,min) I) is exact at f_p = f_s,min, and off by 2e-5 at the densest f_p and f_s (the
// variance of y over f_p^2, times (f_p - f_s,min) / f_p). Read by a cubic through values and slopes; beyond
// the table's end it goes on along the last cubic.
class ElasticEnergy {
 public:
  explicit ElasticEnergy(const Contact& contact, double end = 0.7)
      : contact_(contact), step_((end - contact.solid_fraction_min) / pieces), integrals_(pieces + 1) {
    for (int i = 0; i < pieces; ++i) {
      const Integrals& from = integrals_[i];
      const double middle = law((i + 0.5) * step_), last = law((i + 1) * step_);
      const auto sum = [&](double at_start, double at_middle, double at_end) {
        return step_ / 6.0 * (at_start + 4.0 * at_middle + at_end);
      };
      integrals_[i + 1] = {
          from.energy + sum(from.law / packed(i), middle / packed(i + 0.5), last / packed(i + 1)),
          from.work + sum(from.law, middle, last), last};
    }
  }

  // f_s in [0, 1], packing f_p in [f_s,min, 1).
  double operator()(double f_s, double packing) const {
    if (f_s <= packing) return 0.0;
    const double position = (f_s - packing) / step_;
    const int i = std::min(static_cast<int>(position), pieces - 1);
    const double s = position - i, rest = 1.0 - s;
    const Integrals &a = integrals_[i], &b = integrals_[i + 1];
    const auto cubic = [=, this](double from, double slope, double to, double slope_to) {
      return rest * rest * ((1.0 + 2.0 * s) * from + s * step_ * slope) +
             s * s * ((3.0 - 2.0 * s) * to - rest * step_ * slope_to);
    };
    const double energy = cubic(a.energy, a.law / packed(i), b.energy, b.law / packed(i + 1));
    const double denser = packing - contact_.solid_fraction_min;
    if (denser == 0.0) return f_s * energy;
    const double work = cubic(a.work, a.law, b.work, b.law);
    return f_s * energy * work / (work + denser * energy);
  }

  // -dE/df_p [J/m3], what the contacts gain by a packing that falls. With P = f_s g it is g + f_s int g / x^2
  // dx, and (P + E) / f_s but for the square of (f_s - f_p) / f_s.
  double by_packing(double f_s, double packing) const {
    if (f_s <= packing) return 0.0;
    return (elastic_pressure(f_s, contact_, packing).value + (*this)(f_s, packing)) / f_s;
  }

 private:
  static constexpr int pieces = 512;
  struct Integrals {
    double energy = 0.0, work = 0.0, law = 0.0;  // I, G, g
  };
  double packed(double i) const { return contact_.solid_fraction_min + i * step_; }
  double law(double y) const {
    const double f_s = contact_.solid_fraction_min + y;
    return elastic_pressure(f_s, contact_).value / f_s;
  }

  Contact contact_;
  double step_;
  std::vector<Integrals> integrals_;
};

}  // namespace granvof::closures
