#include "solver/run/initial_state.hpp"

#include <algorithm>
#include <cmath>

#include "solver/closures/packing/laws.hpp"
#include "solver/closures/shear_dilatancy.hpp"
#include "solver/operators/mixture.hpp"
#include "solver/run/energy_budget.hpp"
#include "solver/run/hydrostatic_pressure.hpp"
#include "solver/scene/fill.hpp"
#include "solver/scene/gravity.hpp"

namespace granvof {
namespace {

// A bed whose packing is a matter of its history is at rest at whatever solid fraction it has: P_s carries
// the submerged weight of the grains above, and f_p follows from (13). What no floor or lid holds hangs in
// free fall, or floats: of its load only what bends it is borne, none where all grains weigh alike.
void settle_column(const Grid& grid, const Scene& scene, int i, int k, State& s) {
  const Layout& l = grid.cells;
  const int rows = l.n[1];
  const auto weight = [&](int j) {  // submerged, per area [Pa]
    const std::ptrdiff_t c = l.index(i, j, k);
    return (scene.solid.density - fluid_density(scene, s, c)) * s.f_s[c] * normal_gravity(scene) * grid.h[1];
  };
  // What grains bear on the face above a cell beside half the weight of both its cells [Pa].
  const auto more_above = [&](int j) {
    if (j == rows - 1) return 0.0;
    const std::ptrdiff_t c = l.index(i, j, k), above = l.index(i, j + 1, k);
    const double f_s = 0.5 * (s.f_s[c] + s.f_s[above]);
    return f_s * (scene.solid.density * normal_gravity(scene) * grid.h[1] - (s.p_c[c] - s.p_c[above])) -
           0.5 * (weight(j) + weight(j + 1));
  };
  const auto has_grains = [&](int j) { return s.f_s[l.index(i, j, k)] >= least_solid_fraction; };
  const char* solid = grid.obstacles.solid();
  const auto borne_by = [&](int j, bool upper) {  // by a floor, a lid, an obstacle
    if (j == (upper ? rows - 1 : 0)) return grid.side(1, upper).bears_grains;
    return solid != nullptr && solid[l.index(i, upper ? j + 1 : j - 1, k)] != 0;
  };
  for (int top = rows - 1; top >= 0; --top) {
    if (!has_grains(top)) continue;
    double load = borne_by(top, true) ? 0.0 : more_above(top), grains = 0.0;  // of all cells down to `bottom`
    int bottom = top;
    for (int j = top; j >= 0 && has_grains(j); --j) {
      bottom = j;
      load += weight(j);
      if (!borne_by(j, false)) load += more_above(j - 1);
      grains += s.f_s[l.index(i, j, k)];
    }
    const bool on_floor = load > 0.0 && borne_by(bottom, false),
               under_lid = load < 0.0 && borne_by(top, true);
    double p = under_lid ? -load : borne_by(top, true) ? 0.0 : more_above(top);  // at the upper face
    const double per_grain = on_floor || under_lid ? 0.0 : load / grains;
    for (int j = top; j >= bottom; --j) {
      const std::ptrdiff_t c = l.index(i, j, k);
      const double half = 0.5 * (weight(j) - per_grain * s.f_s[c]);
      if (s.f_s[c] > scene.contact.solid_fraction_min) {
        s.p_s[c] = std::max(p + half, 0.0);
        s.packing[c] = scene.model.packing_at_start().with([&](auto law) {
          return law.at_start([&] { return closures::packing_that_bears(s.p_s[c], s.f_s[c], scene.contact); },
                              scene.contact);
        });
      }
      p += 2.0 * half;
      if (j > bottom) p += more_above(j - 1);
    }
    top = bottom;
  }
}

void settle(const Grid& grid, const Scene& scene, State& s) {
  for (int k = 0; k < grid.cells.n[2]; ++k)
    for (int i = 0; i < grid.cells.n[0]; ++i) settle_column(grid, scene, i, k, s);
}

}  // namespace

State initial_state(const Grid& grid, const Scene& scene, const Boundary& boundary) {
  State s(grid);
  s.time = 0.0 - scene.times.hold;  // 0, not -0, without a hold
  const double loosest = scene.contact.solid_fraction_min;
  s.packing.fill(loosest);
  for_each_place(grid.all_cells(), [&](const std::array<int, 3>& cell) {
    const std::ptrdiff_t c = grid.cells.index(cell);
    Box box;
    for (int d = 0; d < 3; ++d) box.upper[d] = (box.lower[d] = cell[d] * grid.h[d]) + grid.h[d];
    if (scene.bed) {
      const double share = share_of(*scene.bed, box);
      s.f_s[c] = scene.bed->solid_fraction * share;
      s.phi[c] = share > 0.0 ? colour_of(*scene.bed, box) : 0.0;
    }
    // Of what the grains leave: a level within the bed's last row does not fill their room.
    s.alpha[c] = share_of(scene.liquid_boxes, box);
    if (s.f_s[c] > 0.0 && s.alpha[c] > 0.0)
      s.alpha[c] = std::clamp(
          (s.alpha[c] - scene.bed->solid_fraction * shared_by(*scene.bed, scene.liquid_boxes, box)) /
              (1.0 - s.f_s[c]),
          0.0, 1.0);
  });
  boundary.fill_solid_fraction(s.f_s);
  boundary.fill_liquid_share(s.alpha);
  set_hydrostatic_pressure(grid, scene, boundary, s);
  if (scene.model.carries_packing()) settle(grid, scene, s);
  s.fill_ghosts(boundary);
  s.energy = EnergyBudget(grid, scene, boundary).stored(s);
  return s;
}

}  // namespace granvof
