#include "solver/run/step_control.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace granvof {
namespace {

constexpr double growth = 1.2;
constexpr double after_refused_step = 0.4;
constexpr double rows_of_the_gate_in_a_step = 0.5;
constexpr double first_share_of_dt_max = 0.1;
constexpr double elastic_courant =
    0.5;  // of explicit contact pressure; leapfrog's limit is 1 / sqrt(dimensions)

// In which the fastest elastic wave of the solid, of speed sqrt(dP_s/df_s / rho_s), crosses half a cell [s]:
// the fluid between the grains only slows it. Infinite where no grains touch.
double longest_elastic_step(const Grid& grid, const Scene& scene, const closures::SolidLaw& law,
                            const State& s) {
  const double *f = s.f_s.data(), *theta = s.theta.data(), *packing = s.packing.data();
  const double e = scene.solid.restitution, rho_s = scene.solid.density;
  const double stiffest = max_over(grid.cells, grid.all_cells(), 0.0, [=](std::ptrdiff_t c) {
    return closures::solid_pressure(f[c], {theta[c], e, 0.0, packing[c]}, law).slope;
  });
  if (stiffest <= 0.0) return std::numeric_limits<double>::infinity();
  const double shortest = *std::min_element(grid.h.begin(), grid.h.begin() + grid.dim);
  return elastic_courant * shortest / std::sqrt(stiffest / rho_s);
}

}  // namespace

StepControl::StepControl(const Grid& grid, const Scene& scene, const closures::SolidLaw& law)
    : grid_(grid), scene_(scene), law_(law), last_(first_share_of_dt_max * scene.numerics.dt_max) {}

double StepControl::next(const State& s) const {
  double rate = 0.0;  // of crossing a cell [1/s]
  const double *f = s.f_s.data(), least = solid_that_counts_in(scene_);
  for (int d = 0; d < grid_.dim; ++d) {
    const double *uc = s.u_c[d].data(), *us = s.u_s[d].data();
    const std::ptrdiff_t stride = grid_.stride(d);
    const double speed = max_over(grid_.cells, grid_.fluid_faces(d), 0.0, [=](std::ptrdiff_t c) {
      const double solid = f[c] + f[c - stride] > 2.0 * least ? std::fabs(us[c]) : 0.0;
      return std::max(std::fabs(uc[c]), solid);
    });
    rate = std::max(rate, speed / grid_.h[d]);
  }
  double dt = std::min(scene_.numerics.dt_max, growth * last_);
  if (rate > 0.0) dt = std::min(dt, scene_.numerics.cfl / rate);
  if (scene_.numerics.contact_pressure == ContactPressure::explicit_)
    dt = std::min(dt, longest_elastic_step(grid_, scene_, law_, s));
  if (scene_.gate) {
    const double risen = scene_.tank[1] / scene_.gate->speed;
    if (s.time < 0.0) {
      dt = -s.time / std::ceil(-s.time / dt * (1.0 - 1e-9));  // meet the release, without a tiny last step
    } else if (s.time < risen) {
      dt = std::min(dt, rows_of_the_gate_in_a_step * grid_.h[1] / scene_.gate->speed);
    }
  }
  return dt;
}

double StepControl::after_refusal(double dt) const {
  return after_refused_step * dt;
}

}  // namespace granvof
