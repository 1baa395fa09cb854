#include "solver/run/monitors.hpp"

#include <algorithm>
#include <cmath>

namespace granvof {
namespace {

constexpr double next_to_nothing = 1e-9;  // of the tank: a share of less is rounding

// Of what there was, or of what has come in or left where that is more: a tank may start empty.
double unaccounted(double now, double at_start, double left, double tank) {
  const double whole = std::max(at_start, std::fabs(left));
  return whole > next_to_nothing * tank ? std::fabs(now - at_start + left) / whole : 0.0;
}

}  // namespace

Monitors::Monitors(const Grid& grid, const Scene& scene, const State& start)
    : grid_(grid),
      tank_(scene.tank[0] * scene.tank[1] * scene.tank[2]),
      rho_s_(scene.solid.density),
      solid_volume_(solid_volume(start)),
      liquid_volume_(liquid_volume(start)) {
  update(start, 0.0, 0.0);
}

double Monitors::solid_volume(const State& s) const {
  const double* f = s.f_s.data();
  return grid_.cell_volume * sum_over(grid_.cells, grid_.all_cells(), [=](std::ptrdiff_t c) { return f[c]; });
}

double Monitors::liquid_volume(const State& s) const {
  const double *f = s.f_s.data(), *a = s.alpha.data();
  return grid_.cell_volume *
         sum_over(grid_.cells, grid_.all_cells(), [=](std::ptrdiff_t c) { return a[c] * (1.0 - f[c]); });
}

void Monitors::update(const State& s, double liquid_left, double solid_left) {
  liquid_left_ += liquid_left;
  solid_left_ += solid_left;
  solid_error_ = std::max(solid_error_, unaccounted(solid_volume(s), solid_volume_, solid_left_, tank_));
  liquid_error_ = std::max(liquid_error_, unaccounted(liquid_volume(s), liquid_volume_, liquid_left_, tank_));
  const double* f = s.f_s.data();
  solid_max_ = max_over(grid_.cells, grid_.all_cells(), solid_max_, [=](std::ptrdiff_t c) { return f[c]; });
  solid_min_ =
      -max_over(grid_.cells, grid_.all_cells(), -solid_min_, [=](std::ptrdiff_t c) { return -f[c]; });
  outlet_load_ = load_on_outlets(s);
}

double Monitors::load_on_outlets(const State& s) const {
  const double *p = s.p_s.data(), *f = s.f_s.data(), rho_s = rho_s_;
  double load = 0.0;
  grid_.for_each_passing_side([&](int d, bool upper) {
    if (!grid_.tank_side(d, upper).passes_grains) return;
    const double *u = s.u_s[d].data(), sign = upper ? 1.0 : -1.0;
    const std::ptrdiff_t beside = upper ? grid_.stride(d) : 0;
    load = max_over(grid_.cells, grid_.side_cells(d, upper), load, [=](std::ptrdiff_t c) {
      const double leaving = std::max(sign * u[c + beside], 0.0);
      return p[c] - rho_s * f[c] * leaving * leaving;
    });
  });
  return load;
}

std::string Monitors::not_finite(const State& s) const {
  const auto finite = [&](const Field& field) {
    const double* v = field.data();
    return std::isfinite(
        max_over(grid_.cells, grid_.all_cells(), 0.0, [=](std::ptrdiff_t c) { return std::fabs(v[c]); }));
  };
  for (const CellQuantity& q : cell_quantities)
    if (!finite(s.*q.field)) return q.name;
  for (const FaceQuantity& q : face_quantities)
    for (int d = 0; d < grid_.dim; ++d)
      if (!finite((s.*q.field)[d])) return q.name;
  for (const EnergyTerm& term : energy_terms)
    if (!std::isfinite(s.energy.*term.value)) return term.name;
  return {};
}

void Monitors::restore(const Values& v) {
  solid_volume_ = v.solid_volume;
  liquid_volume_ = v.liquid_volume;
  liquid_left_ = v.liquid_left;
  solid_left_ = v.solid_left;
  solid_error_ = v.solid_error;
  liquid_error_ = v.liquid_error;
  solid_max_ = v.solid_max;
  solid_min_ = v.solid_min;
}

}  // namespace granvof
