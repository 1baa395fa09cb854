#include "solver/run/state.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/operators/mixture.hpp"

namespace granvof {
namespace {

// Share of the cell at (i, j, k) that lies inside the box [-].
double overlap(const Grid& grid, const Box& box, const std::array<int, 3>& cell) {
  double share = 1.0;
  for (int d = 0; d < grid.dim; ++d) {
    const double lower = cell[d] * grid.h[d], upper = lower + grid.h[d];
    share *=
        std::clamp((std::min(upper, box.upper[d]) - std::max(lower, box.lower[d])) / grid.h[d], 0.0, 1.0);
  }
  return share;
}

// The same for the bed, whose front face may slope: the cell is cut into thin columns.
double overlap(const Grid& grid, const Bed& bed, const std::array<int, 3>& cell) {
  constexpr int columns = 16;
  if (bed.slope >= 90.0) return overlap(grid, bed.box, cell);
  const double rise = std::tan(bed.slope * std::numbers::pi / 180.0);
  double share = 0.0;
  for (int i = 0; i < columns; ++i) {
    const double x = (cell[0] + (i + 0.5) / columns) * grid.h[0];
    Box part = bed.box;
    part.upper[1] = std::min(part.upper[1], part.lower[1] + std::max(bed.box.upper[0] - x, 0.0) * rise);
    part.lower[0] = std::max(part.lower[0], (cell[0] + double(i) / columns) * grid.h[0]);
    part.upper[0] = std::min(part.upper[0], (cell[0] + double(i + 1) / columns) * grid.h[0]);
    if (part.upper[1] > part.lower[1] && part.upper[0] > part.lower[0]) share += overlap(grid, part, cell);
  }
  return share;
}

template <typename Body>
void for_cells(const Grid& grid, Body&& body) {
  const Layout& l = grid.cells;
  for (int k = 0; k < l.n[2]; ++k)
    for (int j = 0; j < l.n[1]; ++j)
      for (int i = 0; i < l.n[0]; ++i) body(std::array<int, 3>{i, j, k}, l.index(i, j, k));
}

}  // namespace

State::State(const Grid& grid)
    : f_s(grid),
      alpha(grid),
      p_c(grid),
      p_s(grid),
      theta(grid),
      phi(grid),
      u_s(grid),
      u_c(grid),
      u_strain(grid) {}

void State::fill_ghosts(const Boundary& boundary) {
  boundary.fill_scalar(f_s, 0.0);
  boundary.fill_scalar(alpha, 0.0);
  boundary.fill_pressure(p_c);
  boundary.fill_scalar(p_s);
  boundary.fill_scalar(theta);
  boundary.fill_scalar(phi);
  boundary.fill_velocity(u_s, Phase::solid);
  boundary.fill_velocity(u_c, Phase::fluid);
  boundary.fill_velocity(u_strain, Phase::solid);
}

State initial_state(const Grid& grid, const Scene& scene, const Boundary& boundary) {
  State s(grid);
  s.time = 0.0 - scene.times.hold;  // 0, not -0, without a hold
  for_cells(grid, [&](const std::array<int, 3>& cell, std::ptrdiff_t c) {
    if (scene.bed) {
      const double share = overlap(grid, *scene.bed, cell);
      s.f_s[c] = scene.bed->solid_fraction * share;
      s.phi[c] = share > 0.0 ? 1.0 : 0.0;
    }
    double liquid = 0.0;
    for (const Box& box : scene.liquid_boxes) liquid += overlap(grid, box, cell);
    s.alpha[c] = std::min(liquid, 1.0);
  });
  // Hydrostatic from the top down, with the continuous phase alone: grains at rest hang on P_s, not on P_c.
  const Layout& l = grid.cells;
  for (int k = 0; k < l.n[2]; ++k) {
    for (int i = 0; i < l.n[0]; ++i) {
      double pressure = 0.0, above = 0.0;
      for (int j = l.n[1] - 1; j >= 0; --j) {
        const std::ptrdiff_t c = l.index(i, j, k);
        const double here = mixture(s.alpha[c], scene.liquid.density, scene.gas.density);
        pressure += 0.5 * (above + here) * scene.gravity * grid.h[1];
        s.p_c[c] = pressure;
        above = here;
      }
    }
  }
  s.fill_ghosts(boundary);
  return s;
}

}  // namespace granvof
