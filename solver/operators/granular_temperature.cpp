#include "solver/operators/granular_temperature.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/closures/kinetic_theory.hpp"
#include "solver/closures/radial_distribution.hpp"
#include "solver/operators/flux_balance.hpp"
#include "solver/operators/mixture.hpp"

namespace granvof {
namespace {

// Below this solid fraction a grain crosses many cells between two collisions: there is no granular gas to
// speak of, and nothing to dissipate what the smeared edge of a bed gains when the flow compresses it.
// Without this bound Theta ran to 1e8 m2/s2 at f_s = 1e-4 above a bed that hits the water.
constexpr double least_collisional_fraction = 1e-3;

// The fluctuation energy 3/2 Theta of a grain cannot exceed what gravity and moving walls can give it: a fall
// through the whole tank. P_s^EF pushes grains apart without being charged to Theta in (7), and P_s takes the
// old Theta for a whole step; in packed beds that hit water the two together created energy without end
// (Theta 1e10). Without gravity there is no bound: a start may hold any Theta.
double largest_granular_temperature(const Scene& scene) {
  if (scene.gravity <= 0.0) return std::numeric_limits<double>::infinity();
  double wall_speed_squared = 0.0;
  for (const Side& side : scene.sides) {
    double square = 0.0;
    for (const double v : side.velocity) square += v * v;
    wall_speed_squared = std::max(wall_speed_squared, square);
  }
  return 2.0 / 3.0 * (scene.gravity * scene.tank[1] + 0.5 * wall_speed_squared);
}

}  // namespace

GranularTemperature::GranularTemperature(const Grid& grid, const Scene& scene, const Boundary& boundary,
                                         const Communicator& communicator)
    : grid_(grid),
      scene_(scene),
      boundary_(boundary),
      solver_(grid.cells, communicator, grid.h),
      conductivity_(grid),
      kappa_(grid),
      mass_(grid),
      rhs_(grid),
      collisions_(grid),
      drag_(grid),
      excess_(grid) {}

// (f_s Theta) carried by the solid flux, upwind: a convex combination of old values, so Theta stays positive.
void GranularTemperature::convect(double dt, const Field& theta, const Field& f_s, const Field& f_s_new,
                                  const FaceField& flux_s, Field& theta_new) const {
  const double *f = f_s.data(), *f_new = f_s_new.data(), *t = theta.data();
  double* out = theta_new.data();
  for_each(grid_.cells, [=](std::ptrdiff_t c) { out[c] = f[c] * t[c]; });
  subtract_upwind_divergence(grid_, dt, flux_s, theta, theta_new);
  for_each(grid_.cells, [=](std::ptrdiff_t c) {
    out[c] = f_new[c] >= least_solid_fraction ? std::fmax(out[c] / f_new[c], 0.0) : 0.0;
  });
}

// Implicit conduction, kappa of the old level: 3/2 f_s rho_s dTheta/dt = div(f_s kappa grad Theta).
void GranularTemperature::conduct(double dt, const Field& f_s_new, const Rheology& rheology,
                                  Field& theta_new) {
  const double rho_s = scene_.solid.density;
  const double *f = f_s_new.data(), *mu = rheology.kinetic_viscosity.data();
  double *kappa = kappa_.data(), *mass = mass_.data(), *rhs = rhs_.data(), *t = theta_new.data();
  for_each(grid_.cells, [=](std::ptrdiff_t c) {
    const bool grains = f[c] >= least_solid_fraction;
    kappa[c] = grains ? closures::conductivity_to_viscosity * mu[c] : 0.0;
    mass[c] = grains ? 1.5 * f[c] * rho_s / dt : 0.0;
    rhs[c] = mass[c] * t[c];
  });
  boundary_.fill_scalar(kappa_);
  linear::Faces faces{};
  for (int d = 0; d < grid_.dim; ++d) {
    const std::ptrdiff_t s = grid_.stride(d);
    const double inv_h2 = 1.0 / (grid_.h[d] * grid_.h[d]);
    double* k = conductivity_[d].data();
    for_each(grid_.cells, grid_.inner_faces(d), [=](std::ptrdiff_t c) {
      // no conduction into cells without grains
      k[c] = mass[c] > 0.0 && mass[c - s] > 0.0 ? 0.5 * (kappa[c] + kappa[c - s]) * inv_h2 : 0.0;
    });
    faces.lower[d] = k;
  }
  const double scale =
      max_over(grid_.cells, grid_.all_cells(), 0.0, [=](std::ptrdiff_t c) { return rhs[c]; });
  if (scale == 0.0) return;
  solver_.solve(faces, mass, rhs, t, {1e-6 * scale, 1e-4, 50});
  for_each(grid_.cells, [=](std::ptrdiff_t c) { t[c] = std::fmax(t[c], 0.0); });
}

// Local balance of (7), divided by w = sqrt(Theta): 3 f rho dw/dt = A S^2 - G w^2 - (3 beta + B) w, implicit
// in w. Quadratic with one positive root: stays positive, needs no seed. The algebraic form drops the time
// term.
GranularLosses GranularTemperature::balance(double dt, const Field& f_s_new, const FaceField& beta,
                                            const Rheology& rheology, const StrainRate& strain,
                                            Field& theta_new) {
  const double rho_s = scene_.solid.density, d_s = scene_.solid.diameter,
               f_max = scene_.contact.solid_fraction_max;
  const bool steady = scene_.model.granular_temperature == TemperatureModel::algebraic;
  const bool work = scene_.model.pressure_work;
  const double bound = largest_granular_temperature(scene_);
  const double *f_s = f_s_new.data(), *e_cell = rheology.restitution.data();
  const double *sq = strain.squared.data(), *div = strain.divergence.data();
  double *t = theta_new.data(), *collided = collisions_.data(), *dragged = drag_.data(),
         *excess = excess_.data();
  std::array<const double*, 3> b{};
  for (int d = 0; d < grid_.dim; ++d) b[d] = beta[d].data();
  const int dim = grid_.dim;
  const auto stride = grid_.cells.stride;
  for_each(grid_.cells, [=](std::ptrdiff_t c) {
    const double f = f_s[c];
    collided[c] = dragged[c] = 0.0;
    if (f < least_collisional_fraction) {
      excess[c] = 1.5 * f * rho_s * t[c];
      t[c] = 0.0;
      return;
    }
    const double e = e_cell[c], g0 = closures::radial_distribution(f, f_max);
    // mean over the faces that grains pass (closed ones hold no drag coefficient)
    double drag = 0.0;
    int passing = 0;
    for (int d = 0; d < dim; ++d) {
      for (const double beta_face : {b[d][c], b[d][c + stride[d]]}) {
        drag += beta_face;
        passing += beta_face > 0.0 ? 1 : 0;
      }
    }
    if (passing > 0) drag /= passing;
    const double mu = closures::kinetic_viscosity(f, 1.0, e, g0, rho_s, d_s);  // mu_s^K / sqrt(Theta)
    // tau^K : S of (16), without the printed factor 2 (model correction 2)
    const double production =
        f * mu * (2.0 * sq[c] + (closures::bulk_to_shear_viscosity - 2.0 / 3.0) * div[c] * div[c]);
    const double collisions = closures::collisional_dissipation_rate(f, e, g0, rho_s, d_s);
    const double of_collisions = -3.0 * (1.0 - e * e) * f * f * rho_s * g0 * div[c];
    double expansion = of_collisions;
    if (work) expansion += closures::kinetic_pressure(f, 1.0, e, g0, rho_s) * div[c];
    // A growing term (grains under compression) is taken explicitly, as the work of the old Theta's pressure,
    // which is the pressure the momentum felt: implicit in w it has a pole near div u_s dt = -3 and creates
    // energy.
    const double inertia = steady ? 0.0 : 3.0 * f * rho_s / dt;
    const double growth = std::fmax(-expansion, 0.0), decay = 3.0 * drag + std::fmax(expansion, 0.0);
    const double w_start = steady ? 0.0 : std::sqrt(t[c] * (1.0 + 2.0 * growth / inertia));
    const double w = closures::positive_root(collisions, inertia + decay, production + inertia * w_start);
    t[c] = std::fmin(w * w, bound);
    excess[c] = 1.5 * f * rho_s * (w * w - t[c]);
    collided[c] = dt * (collisions * w + of_collisions) * w * w;
    dragged[c] = dt * 3.0 * drag * w * w;
  });
  const auto total = [&](const Field& loss) {
    const double* l = loss.data();
    return grid_.cell_volume *
           sum_over(grid_.cells, grid_.all_cells(), [=](std::ptrdiff_t c) { return l[c]; });
  };
  return {total(collisions_), total(drag_), total(excess_)};
}

GranularLosses GranularTemperature::advance(double dt, const Field& theta, const Field& f_s,
                                            const Field& f_s_new, const FaceField& flux_s,
                                            const FaceField& beta, const Rheology& rheology,
                                            const StrainRate& strain, Field& theta_new) {
  switch (scene_.model.granular_temperature) {
    case TemperatureModel::off:
      return {};  // Theta stays zero
    case TemperatureModel::transported:
      convect(dt, theta, f_s, f_s_new, flux_s, theta_new);
      conduct(dt, f_s_new, rheology, theta_new);
      break;
    case TemperatureModel::algebraic:
      break;
  }
  return balance(dt, f_s_new, beta, rheology, strain, theta_new);
}

}  // namespace granvof
