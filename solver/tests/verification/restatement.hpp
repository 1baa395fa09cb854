// A scene and the same scene in other units, run side by side.
#pragma once

#include <cmath>
#include <string>

#include "solver/scene/restate.hpp"
#include "solver/scene/scales.hpp"
#include "solver/tests/verification/measured_scenes.hpp"

namespace granvof::test {

inline Scene restated(const Scene& scene, const UnitFactors& factors) {
  return parse_scene(restated_case(scene, factors), scene.name + " restated");
}

// Largest difference of a field, its dimension's factor taken out, over the field's largest value or,
// where that is more, its scale: at rest, a velocity is a share of the scene's. What grains carry counts by
// their share of the cell: without any, their colour is what was there last.
struct Difference {
  double value = 0.0;
  std::string field = "none";

  void take(const std::string& name, const Field& a, const Field& b, double factor,
            const Field* share = nullptr, double scale = 0.0) {
    double off = 0.0, most = scale;
    for (std::size_t i = 0; i < a.span().size(); ++i) {
      const double weight = share ? share->span()[i] : 1.0;
      off = std::fmax(off, weight * std::fabs(b.span()[i] / factor - a.span()[i]));
      most = std::fmax(most, weight * std::fabs(a.span()[i]));
    }
    if (most > 0.0) off /= most;
    if (off > value || !std::isfinite(off)) {
      value = off;
      field = name;
    }
  }
};

// Of where everything is and how it moves.
inline Difference difference_of_motion(const Scene& scene, const State& a, const State& b,
                                       const UnitFactors& factors) {
  const double velocity = factors.of({0, 1, -1}), scale = scales_of(scene).velocity;
  Difference d;
  d.take("f_s", a.f_s, b.f_s, 1.0);
  d.take("alpha", a.alpha, b.alpha, 1.0);
  d.take("packing", a.packing, b.packing, 1.0, &a.f_s);
  d.take("phi", a.phi, b.phi, 1.0, &a.f_s);
  for (int i = 0; i < scene.dimensions; ++i) {
    d.take("u_s", a.u_s[i], b.u_s[i], velocity, nullptr, scale);
    d.take("u_c", a.u_c[i], b.u_c[i], velocity, nullptr, scale);
  }
  return d;
}

// Of what follows from small differences of that: pressures and Theta.
inline Difference difference_of_stress(const State& a, const State& b, const UnitFactors& factors) {
  const double pressure = factors.of({1, -1, -2});
  Difference d;
  d.take("p_c", a.p_c, b.p_c, pressure);
  d.take("p_s", a.p_s, b.p_s, pressure);
  d.take("theta", a.theta, b.theta, factors.of({0, 2, -2}), &a.f_s);
  return d;
}

}  // namespace granvof::test
