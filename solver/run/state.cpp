#include "solver/run/state.hpp"

#include <cmath>
#include <vector>

#include "solver/closures/shear_dilatancy.hpp"
#include "solver/operators/mixture.hpp"
#include "solver/run/energy_budget.hpp"
#include "solver/scene/fill.hpp"
#include "solver/scene/gravity.hpp"

namespace granvof {
namespace {

template <typename Body>
void for_cells(const Grid& grid, Body&& body) {
  const Layout& l = grid.cells;
  for (int k = 0; k < l.n[2]; ++k)
    for (int j = 0; j < l.n[1]; ++j)
      for (int i = 0; i < l.n[0]; ++i) body(std::array<int, 3>{i, j, k}, l.index(i, j, k));
}

// A bed whose packing is a matter of its history is at rest at whatever solid fraction it has: P_s carries
// the submerged weight above, and f_p follows from (13). Grains lighter than the fluid about them bear
// nothing yet.
void settle(const Grid& grid, const Scene& scene, State& s) {
  const Layout& l = grid.cells;
  const char* solid = grid.obstacles.solid();
  for (int k = 0; k < l.n[2]; ++k) {
    for (int i = 0; i < l.n[0]; ++i) {
      double load = 0.0;
      for (int j = l.n[1] - 1; j >= 0; --j) {
        const std::ptrdiff_t c = l.index(i, j, k);
        if (solid != nullptr && solid[c] != 0) {  // what lies on an obstacle does not press on what is below
          load = 0.0;
          continue;
        }
        const double excess =
            scene.solid.density - mixture(s.alpha[c], scene.liquid.density, scene.gas.density);
        const double weight = std::fmax(excess, 0.0) * s.f_s[c] * normal_gravity(scene) * grid.h[1];
        if (s.f_s[c] > scene.contact.solid_fraction_min) {
          s.p_s[c] = load + 0.5 * weight;
          s.packing[c] = closures::packing_that_bears(s.p_s[c], s.f_s[c], scene.contact);
        }
        load += weight;
      }
    }
  }
}

}  // namespace

State::State(const Grid& grid)
    : f_s(grid),
      alpha(grid),
      p_c(grid),
      p_s(grid),
      theta(grid),
      phi(grid),
      packing(grid),
      u_s(grid),
      u_c(grid),
      u_strain(grid) {}

void State::fill_ghosts(const Boundary& boundary) {
  boundary.fill_solid_fraction(f_s);
  boundary.fill_liquid_share(alpha);
  boundary.fill_pressure(p_c);
  boundary.fill_scalar(p_s);
  boundary.fill_scalar(theta);
  boundary.fill_scalar(phi);
  boundary.fill_scalar(packing);
  boundary.fill_velocity(u_s, Phase::solid);
  boundary.fill_velocity(u_c, Phase::fluid);
  boundary.fill_velocity(u_strain, Phase::solid);
}

State initial_state(const Grid& grid, const Scene& scene, const Boundary& boundary) {
  State s(grid);
  s.time = 0.0 - scene.times.hold;  // 0, not -0, without a hold
  const double loosest = scene.contact.solid_fraction_min;
  s.packing.fill(loosest);
  for_cells(grid, [&](const std::array<int, 3>& cell, std::ptrdiff_t c) {
    Box box;
    for (int d = 0; d < 3; ++d) box.upper[d] = (box.lower[d] = cell[d] * grid.h[d]) + grid.h[d];
    if (scene.bed) {
      const double share = share_of(*scene.bed, box);
      s.f_s[c] = scene.bed->solid_fraction * share;
      s.phi[c] = share > 0.0 ? colour_of(*scene.bed, box) : 0.0;
    }
    s.alpha[c] = share_of(scene.liquid_boxes, box);
  });
  // Hydrostatic from the top down, with the continuous phase alone: grains at rest hang on P_s, not on P_c.
  // Under an inclined top, from its middle.
  const Layout& l = grid.cells;
  const double normal = normal_gravity(scene), along = confined_gravity(scene)[0];
  const auto density = [&](std::ptrdiff_t c) {
    return mixture(s.alpha[c], scene.liquid.density, scene.gas.density);
  };
  const auto pressure_at_the_top = [&](int k) {
    std::vector<double> pressure(static_cast<std::size_t>(l.n[0]), 0.0);
    double mean = 0.0;
    for (int i = 1; i < l.n[0]; ++i) {
      const std::ptrdiff_t c = l.index(i, l.n[1] - 1, k);
      const std::size_t here = static_cast<std::size_t>(i);
      pressure[here] = pressure[here - 1] + 0.5 * (density(c - 1) + density(c)) * along * grid.h[0];
      mean += pressure[here] / l.n[0];
    }
    for (double& p : pressure) p -= mean;
    return pressure;
  };
  for (int k = 0; k < l.n[2]; ++k) {
    const std::vector<double> top = pressure_at_the_top(k);
    for (int i = 0; i < l.n[0]; ++i) {
      double pressure = top[static_cast<std::size_t>(i)], above = 0.0;
      for (int j = l.n[1] - 1; j >= 0; --j) {
        const std::ptrdiff_t c = l.index(i, j, k);
        const double here = density(c);
        pressure += 0.5 * (above + here) * normal * grid.h[1];
        s.p_c[c] = pressure;
        above = here;
      }
    }
  }
  // Until here as if the tank were empty: the water on both sides of an obstacle is one body.
  for (const std::ptrdiff_t c : grid.obstacles.cells()) s.f_s[c] = s.alpha[c] = s.phi[c] = s.p_c[c] = 0.0;
  if (scene.model.shear_dilatancy) settle(grid, scene, s);
  s.fill_ghosts(boundary);
  s.energy = EnergyBudget(grid, scene, boundary).stored(s);
  return s;
}

}  // namespace granvof
