#include "solver/operators/viscosity.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "solver/closures/smagorinsky.hpp"
#include "solver/closures/suspension.hpp"
#include "solver/operators/edge_mean.hpp"
#include "solver/operators/stress_power.hpp"

namespace granvof {

namespace {

constexpr double explicit_viscous_number =
    0.4;  // nu dt sum(1/h^2); explicit diffusion is unstable from 0.5 on

}  // namespace

void FluidViscosity::update(const Boundary& boundary, const State& now) {
  set_strain(boundary, now.u_c);
  const double delta =
      grid_.dim == 2 ? std::sqrt(grid_.h[0] * grid_.h[1]) : std::cbrt(grid_.h[0] * grid_.h[1] * grid_.h[2]);
  const Fluid &gas = scene_.gas, &liquid = scene_.liquid;
  const double rho_l = liquid.density, rho_g = gas.density, mu_l = liquid.viscosity, mu_g = gas.viscosity;
  const bool les = scene_.model.les, suspension = scene_.model.suspension_viscosity;
  const double f_max = scene_.contact.solid_fraction_max;
  const double* f = now.f_s.data();
  const double* a = now.alpha.data();
  const double* sq = strain_.squared.data();
  double* mu = viscosity_.data();
  for_each(grid_.cells, [=](std::ptrdiff_t c) {
    const double rho = mixture(a[c], rho_l, rho_g);
    const double eddy = les ? closures::eddy_viscosity(rho, delta, sq[c]) : 0.0;
    const double molecular = mixture(a[c], mu_l, mu_g);
    const double crowded = suspension ? closures::suspension_viscosity(f[c], f_max) : 1.0;
    mu[c] = (1.0 - f[c]) * (molecular * crowded + eddy);
  });
  boundary.fill_scalar(viscosity_);
  largest_kinematic_ = max_over(grid_.cells, grid_.all_cells(), 0.0, [=](std::ptrdiff_t c) {
    return mu[c] / ((1.0 - f[c]) * mixture(a[c], rho_l, rho_g));
  });
  if (!grid_.obstacles.none()) {
    grid_.obstacles.extend(mu);
    boundary.fill_scalar(viscosity_);
  }
}

bool FluidViscosity::bears(double dt) const {
  double inverse_squares = 0.0;
  for (int d = 0; d < grid_.dim; ++d)
    if (grid_.cells.n[d] > 1) inverse_squares += 1.0 / (grid_.h[d] * grid_.h[d]);
  return largest_kinematic_ * dt * inverse_squares <= explicit_viscous_number;
}

void FluidViscosity::add_acceleration(const FaceField& u_c, const FaceInertia& inertia, int d,
                                      const Range& faces, Field& acceleration) const {
  const double* mu = viscosity_.data();
  const double* v = u_c[d].data();
  const double* m = inertia.fluid[d].data();
  double* out = acceleration.data();
  const std::ptrdiff_t s = grid_.stride(d);
  const double inv_h = 1.0 / grid_.h[d];
  for_each(grid_.cells, faces, [=](std::ptrdiff_t c) {
    const double ahead = mu[c] * (v[c + s] - v[c]), behind = mu[c - s] * (v[c] - v[c - s]);
    out[c] += 2.0 * (ahead - behind) * inv_h * inv_h / m[c];
  });
  for (int e = 0; e < grid_.dim; ++e) {
    if (e == d) continue;
    const double* g = strain_.shear[plane_index(d, e)].data();
    const std::ptrdiff_t t = grid_.stride(e);
    const double inv_he = 1.0 / grid_.h[e];
    for_each(grid_.cells, faces, [=](std::ptrdiff_t c) {
      const double ahead = edge_mean(mu, c + t, s, t) * g[c + t], behind = edge_mean(mu, c, s, t) * g[c];
      out[c] += (ahead - behind) * inv_he / m[c];
    });
    for (const Obstacles::Edge& edge : grid_.obstacles.edges(plane_index(d, e))) {
      if (!edge.flat || edge.across != e) continue;
      std::array<int, 3> place = edge.place;
      if (!edge.above) place[e] -= 1;
      if (!faces.contains(place)) continue;
      const double missing = edge_mean(mu, edge) - edge_mean(mu, edge.at, s, t);
      const std::ptrdiff_t c = edge.face[0].second;
      out[c] += (edge.above ? -1.0 : 1.0) * missing * g[edge.at] * inv_he / m[c];
    }
  }
}

double FluidViscosity::power_on(const FaceField& u_c, const FaceInertia& inertia, int d, const Field& without,
                                const Field& with) const {
  const double *v = u_c[d].data(), *m = inertia.fluid[d].data(), *a = without.data(), *b = with.data();
  const auto power = [=](std::ptrdiff_t c) { return m[c] * v[c] * (b[c] - a[c]); };
  double total = sum_over(grid_.cells, grid_.inner_faces(d), power);
  for (const bool upper : {false, true})
    if (grid_.tank_side(d, upper).passes_fluid)
      total += 0.5 * sum_over(grid_.cells, grid_.side_faces(d, upper), power);
  return total * grid_.cell_volume;
}

// Stress on a side times the velocity there. Where that velocity is given, no momentum is solved of the half
// cell behind it: the side gives what its shear takes, too.
double FluidViscosity::power_on_side(const FaceField& u_c, int d, bool upper) const {
  const bool solved = grid_.tank_side(d, upper).passes_fluid;
  const std::ptrdiff_t s = grid_.stride(d), inside = upper ? -s : 0, outside = upper ? 0 : -s;
  const Range faces = grid_.side_faces(d, upper);
  const double *mu = viscosity_.data(), *v = u_c[d].data();
  const double sign = upper ? 1.0 : -1.0, inv_h = 1.0 / grid_.h[d];
  double power =
      sign * inv_h * sum_over(grid_.cells, faces, [=](std::ptrdiff_t c) {
        const auto normal = [=](std::ptrdiff_t cell) {
          return 2.0 * mu[cell] * (v[cell + s] - v[cell]) * inv_h;
        };
        return v[c] * (solved ? 0.5 * (normal(c + inside) + normal(c + outside)) : normal(c + inside));
      });
  for (int e = 0; e < grid_.dim; ++e) {
    if (e == d) continue;
    const std::ptrdiff_t t = grid_.stride(e);
    const double *w = u_c[e].data(), *g = strain_.shear[plane_index(std::min(d, e), std::max(d, e))].data();
    const auto stress = [=](std::ptrdiff_t edge) { return edge_mean(mu, edge, s, t) * g[edge]; };
    Range edges = grid_.inner_faces(e);
    edges.lower[d] = faces.lower[d];
    edges.upper[d] = faces.upper[d];
    power += sign * inv_h * sum_over(grid_.cells, edges, [=](std::ptrdiff_t c) {
               return 0.5 * (w[c] + w[c - s]) * stress(c);
             });
    if (solved) continue;
    // In a corner of two sides that pass nothing else no stress works, see sum_over_edges().
    Range above = faces, below = faces;
    if (ends_closed(grid_, e, true)) above.upper[e] -= 1;
    if (ends_closed(grid_, e, false)) below.lower[e] += 1;
    power -= 0.5 / grid_.h[e] *
             (sum_over(grid_.cells, above, [=](std::ptrdiff_t c) { return v[c] * stress(c + t); }) -
              sum_over(grid_.cells, below, [=](std::ptrdiff_t c) { return v[c] * stress(c); }));
  }
  return power * grid_.cell_volume;
}

FluidViscosity::Power FluidViscosity::power(const Boundary& boundary, const FaceField& u_c) const {
  const double *mu = viscosity_.data(), *normal = strain_.normal_squared.data();
  Power power;
  power.dissipation =
      sum_over(grid_.cells, grid_.all_cells(), [=](std::ptrdiff_t c) { return 2.0 * mu[c] * normal[c]; });
  const auto stress = [&](int d, int e) {
    const double* g = strain_.shear[plane_index(d, e)].data();
    const std::ptrdiff_t s = grid_.stride(d), t = grid_.stride(e);
    return [=](std::ptrdiff_t c) { return edge_mean(mu, c, s, t) * g[c]; };
  };
  for (int d = 0; d < grid_.dim; ++d) {
    for (int e = d + 1; e < grid_.dim; ++e) {
      const double* g = strain_.shear[plane_index(d, e)].data();
      const std::ptrdiff_t s = grid_.stride(d), t = grid_.stride(e);
      power.dissipation +=
          sum_over_edges(grid_, d, e, [=](std::ptrdiff_t c) { return edge_mean(mu, c, s, t) * g[c] * g[c]; });
      power.dissipation -=  // half of it is fluid
          sum_of(grid_.cells, grid_.obstacles.edges(plane_index(d, e)), [=](const Obstacles::Edge& edge) {
            if (!edge.flat || edge.copy) return 0.0;
            const double all = edge_mean(mu, edge.at, s, t), mine = 0.5 * edge_mean(mu, edge);
            return (edge.on_side ? 0.5 : 1.0) * (all - mine) * g[edge.at] * g[edge.at];
          });
    }
  }
  power.dissipation *= grid_.cell_volume;
  power.walls = wall_power(grid_, boundary, stress);
  grid_.for_each_open_side([&](int d, bool upper) { power.sides += power_on_side(u_c, d, upper); });
  return power;
}

}  // namespace granvof
