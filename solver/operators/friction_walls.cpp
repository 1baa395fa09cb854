// What the solid stress meets at the sides of the tank: Coulomb walls and bumps.
#include <algorithm>
#include <cmath>

#include "solver/closures/bumpy_wall.hpp"
#include "solver/operators/friction.hpp"

namespace granvof {
namespace {

constexpr double slowest_sliding =
    1e-7;  // of the scene's velocity: below it a Coulomb wall holds like a viscous one
// Of the fastest slip on Coulomb walls: a smaller change of it within a step passes for none. What drives
// beyond the friction by less than that share begins to slide after a number of steps and not after a time.
constexpr double settled_slip = 0.005;

// Edges of plane (d, e) on a side of the tank across direction d, within the box.
Range edges_on_side(const Grid& grid, const Range& box, int d, int e, bool upper) {
  Range wall = grid.edges(d, e);
  wall.lower[d] = upper ? grid.cells.n[d] : 0;
  wall.upper[d] = wall.lower[d] + (grid.has_side(d, upper) ? 1 : 0);
  return common(wall, Grid::edges(box, d, e));
}

}  // namespace

// visit(d, upper, e, edges) on each side that `chosen(d, upper)` for each tangential direction e.
template <typename Chosen, typename Visit>
void Friction::for_each_wall(Chosen&& chosen, Visit&& visit) const {
  for (int d = 0; d < grid_.dim; ++d)
    for (const bool upper : {false, true})
      for (int e = 0; e < grid_.dim; ++e)
        if (e != d && chosen(d, upper)) visit(d, upper, e, edges_on_side(grid_, box_, d, e, upper));
}
template <typename Visit>
void Friction::for_each_coulomb_wall(Visit&& visit) const {
  for_each_wall([this](int d, bool upper) { return holds_by_friction(d, upper); }, visit);
}

void Friction::keep_normal_stress(const FaceField& u) {
  for (int d = 0; d < grid_.dim; ++d) {
    for (const bool upper : {false, true}) {
      if (!holds_by_friction(d, upper)) continue;
      const std::ptrdiff_t s = grid_.stride(d);
      const double two_by_h = 2.0 / grid_.h[d];
      const double *mu = normal_viscosity(d), *kinetic = shear_of_collisions().data(), *v = u[d].data();
      double* stress = normal_stress_[d].data();
      for_each(grid_.cells, common(grid_.side_cells(d, upper), box_),
               [=](std::ptrdiff_t c) { stress[c] = (mu[c] - kinetic[c]) * (v[c + s] - v[c]) * two_by_h; });
      boundary_.exchange(normal_stress_[d]);
    }
  }
}

bool Friction::holds_by_friction(int d, bool upper) const {
  const double mu_w = grid_.tank_side(d, upper).friction;  // every process asks, whoever has the side
  return mu_w > 0.0 && !std::isinf(mu_w);
}

bool Friction::has_coulomb_walls() const {
  for (int d = 0; d < grid_.dim; ++d)
    if (holds_by_friction(d, false) || holds_by_friction(d, true)) return true;
  return false;
}

// Edges on closed sides: none for slip, at most mu_w times the normal traction P_s^E - tau_nn of contacts for
// Coulomb (through a viscosity of the old speed), and the bed's own for no-slip. The operator takes the
// wall's shear as 2 u_t / h. (By P_s^E alone: friction carries normal load too, and a slab whose P_s was 2.3
// times its weight stuck to a floor that it should slide down.)
void Friction::set_wall_friction(const Rheology& rheology, const FaceField& u_strain) {
  const double* p = rheology.enduring_pressure.data();
  const double slowest = slowest_sliding * velocity_;
  const auto limits_shear = [this](int d, bool upper) {
    return !grid_.cells.seam(d, upper) && !std::isinf(boundary_.side(d, upper).friction);
  };
  for_each_wall(limits_shear, [&](int d, bool upper, int e, const Range& wall) {
    const SideRule& side = boundary_.side(d, upper);
    const std::ptrdiff_t s = grid_.stride(d), inside = upper ? -s : 0, t = grid_.stride(e);
    const double mu_w = side.friction, h = grid_.h[d], u_wall = side.velocity[e];
    const int g =
        3 - d - e;  // in 3D the other tangential direction: the wall limits the vector, not a component
    const bool three = grid_.dim == 3;
    const double w_wall = three ? side.velocity[g] : 0.0;
    const std::ptrdiff_t r = three ? grid_.stride(g) : 0;
    const double *v = u_strain[e].data(), *w = three ? u_strain[g].data() : v,
                 *stress = holds_by_friction(d, upper) ? normal_stress_[d].data() : nullptr;
    double* edge = mu_edge_[plane_index(d, e)].data();
    for_each(grid_.cells, wall, [=](std::ptrdiff_t c) {
      const double pressure = 0.25 * (p[c] + p[c - s] + p[c - t] + p[c - s - t]);
      const std::ptrdiff_t i = c + inside;
      const double traction = stress ? pressure - 0.5 * (stress[i] + stress[i - t]) : pressure;
      const double along = v[i] - u_wall;
      const double across = three ? 0.25 * (w[i] + w[i - t] + w[i + r] + w[i + r - t]) - w_wall : 0.0;
      const double speed = std::sqrt(along * along + across * across);
      edge[c] = std::min(edge[c], mu_w * std::max(traction, 0.0) * 0.5 * h / std::max(speed, slowest));
    });
  });
}

bool Friction::slips_otherwise(const State& next) const {
  double fastest = slowest_sliding * velocity_, changed = 0.0;
  for_each_coulomb_wall([&](int d, bool upper, int e, const Range& wall) {
    const std::ptrdiff_t inside = upper ? -grid_.stride(d) : 0;
    const double u_wall = grid_.tank_side(d, upper).velocity[e];
    const double *was = next.u_strain[e].data(), *is = next.u_s[e].data(), *m = marked_[e].data();
    fastest = max_over(grid_.cells, wall, fastest,
                       [=](std::ptrdiff_t c) { return m[c + inside] * std::fabs(is[c + inside] - u_wall); });
    changed = max_over(grid_.cells, wall, changed, [=](std::ptrdiff_t c) {
      return m[c + inside] * std::fabs(is[c + inside] - was[c + inside]);
    });
  });
  return changed > settled_slip * fastest;
}

// The kinetic part of every edge's viscosity. None on Coulomb walls: grains that slide along one do not
// shear, and what that dissipates is friction. (Taken for shear it made a Theta whose pressure bore half of a
// slab's weight, on which the wall then had no friction.)
void Friction::set_kinetic_edges(const Rheology& rheology) {
  if (kinetic_edge_[0].empty()) return;
  const double* kinetic = shear_of_collisions(rheology).data();
  for (int d = 0; d < grid_.dim; ++d) {
    for (int e = d + 1; e < grid_.dim; ++e) {
      const std::ptrdiff_t s = grid_.stride(d), t = grid_.stride(e);
      double* own = kinetic_edge_[plane_index(d, e)].data();
      for_each(grid_.cells, Grid::edges(box_, d, e), [=](std::ptrdiff_t c) {
        own[c] = 0.25 * (kinetic[c] + kinetic[c - s] + kinetic[c - t] + kinetic[c - s - t]);
      });
    }
  }
  for_each_coulomb_wall([&](int d, bool, int e, const Range& wall) {
    double* own = kinetic_edge_[plane_index(std::min(d, e), std::max(d, e))].data();
    for_each(grid_.cells, wall, [=](std::ptrdiff_t c) { own[c] = 0.0; });
  });
}

// Collisions with the bumps of a wall: stress and slip of bumpy_wall.hpp, in a row with the kinetic viscosity
// over the half cell beside it. Enduring contacts stick to the bumps.
void Friction::slip_on_bumps(const Rheology& rheology) {
  if (rheology.bump_pressure.empty()) return;
  const double* pressure = rheology.bump_pressure.data();
  const auto has_bumps = [this](int d, bool upper) { return boundary_.side(d, upper).bumps.has_value(); };
  for_each_wall(has_bumps, [&](int d, bool upper, int e, const Range& wall) {
    const double slip = closures::bumpy_wall_slip(boundary_.side(d, upper).bumps->angle);
    const int plane = plane_index(std::min(d, e), std::max(d, e));
    const std::ptrdiff_t s = grid_.stride(d), t = grid_.stride(e);
    const double half = 0.5 * grid_.h[d];
    double *own = kinetic_edge_[plane].data(), *edge = mu_edge_[plane].data();
    for_each(grid_.cells, wall, [=](std::ptrdiff_t c) {
      const double before = own[c];
      const double hold = 0.25 * half / slip *
                          (pressure[c] + pressure[c - s] + pressure[c - t] + pressure[c - s - t]);  // [Pa s]
      own[c] = before > 0.0 ? before * hold / (before + hold) : 0.0;
      edge[c] += own[c] - before;
    });
  });
}

}  // namespace granvof
