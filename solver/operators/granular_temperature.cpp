#include "solver/operators/granular_temperature.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/closures/bumpy_wall.hpp"
#include "solver/closures/granular_temperature/laws.hpp"
#include "solver/closures/kinetic_theory.hpp"
#include "solver/operators/box_of_grains.hpp"
#include "solver/operators/flux_balance.hpp"
#include "solver/operators/mixture.hpp"
#include "solver/scene/gravity.hpp"

namespace granvof {
namespace {

// Below this solid fraction a grain crosses many cells between two collisions: there is no granular gas to
// speak of, and nothing to dissipate what the smeared edge of a bed gains when the flow compresses it.
// Without this bound Theta ran to 1e8 m2/s2 at f_s = 1e-4 above a bed that hits the water.
constexpr double least_collisional_fraction = 1e-3;

// Share of the Theta that a shear makes in one step which grains at rest are stirred with: with none their
// stress would stay zero for ever. Small, so that what conduction takes from a flow is not given back; a
// start from rest needs two or three steps more than with the whole.
constexpr double seed = 0.01;

// The fluctuation energy 3/2 Theta of a grain cannot exceed what gravity and moving walls can give it: a fall
// through the whole tank. P_s^EF pushes grains apart without being charged to Theta in (7), so that (7) alone
// has no such bound. Without gravity there is none: a start may hold any Theta. Nor is there where gravity
// acts along a periodic direction: such a fall has no end.
double largest_granular_temperature(const Scene& scene) {
  const Vec3 g = confined_gravity(scene);
  if (scene.gravity <= 0.0 || g != gravity_of(scene)) return std::numeric_limits<double>::infinity();
  double wall_speed_squared = 0.0;
  for (const Side& side : scene.sides) {
    double square = 0.0;
    for (const double v : side.velocity) square += v * v;
    wall_speed_squared = std::max({wall_speed_squared, square, side.inflow.speed * side.inflow.speed});
  }
  return 2.0 / 3.0 *
         (std::fabs(g[1]) * scene.tank[1] + std::fabs(g[0]) * scene.tank[0] + 0.5 * wall_speed_squared);
}

// Bumps take from the cells beside them.
Field loss_to_bumps(const Grid& grid, const Boundary& boundary) {
  Field loss;
  for (int d = 0; d < grid.dim; ++d) {
    for (const bool upper : {false, true}) {
      const auto& bumps = boundary.side(d, upper).bumps;
      if (!bumps) continue;
      if (loss.empty()) loss = Field(grid);
      double* out = loss.data();
      const double taken = closures::bumpy_wall_loss(bumps->restitution) / grid.h[d];
      for_each(grid.cells, grid.side_cells(d, upper), [=](std::ptrdiff_t c) { out[c] += taken; });
    }
  }
  return loss;
}

}  // namespace

GranularTemperature::GranularTemperature(const Grid& grid, const Scene& scene, const Boundary& boundary,
                                         const closures::Collisions& laws)
    : grid_(grid),
      scene_(scene),
      boundary_(boundary),
      laws_(laws),
      wall_loss_(loss_to_bumps(grid, boundary)),
      conductivity_(grid),
      kappa_(grid),
      mass_(grid),
      rhs_(grid) {}

// (f_s Theta) carried by the solid flux, upwind: a convex combination of old values, so Theta stays positive.
double GranularTemperature::convect(double dt, const State& now, const FaceField& flux_s, State& next) const {
  const double *f = now.f_s.data(), *f_new = next.f_s.data(), *t = now.theta.data();
  double* out = next.theta.data();
  for_each(grid_.cells, cells_, [=](std::ptrdiff_t c) { out[c] = f[c] * t[c]; });
  subtract_upwind_divergence(grid_, dt, flux_s, now.theta, cells_, next.theta);
  const double held = sum_over(grid_.cells, cells_, [=](std::ptrdiff_t c) {
    const bool grains = f_new[c] >= least_solid_fraction;
    const double of_cell = out[c];
    out[c] = grains ? std::max(of_cell / f_new[c], 0.0) : 0.0;
    return grains ? 0.0 : of_cell;
  });
  return 1.5 * scene_.solid.density * grid_.cell_volume * held;
}

// Implicit conduction, kappa of the old level: 3/2 f_s rho_s dTheta/dt = div(f_s kappa grad Theta).
void GranularTemperature::conduct(double dt, const Rheology& rheology, State& next) {
  const double rho_s = scene_.solid.density;
  const double *f = next.f_s.data(), *mu = rheology.kinetic_viscosity.data(),
               *e = rheology.restitution.data();
  double *kappa = kappa_.data(), *mass = mass_.data(), *rhs = rhs_.data(), *t = next.theta.data();
  for_each(grid_.cells, cells_, [=, laws = laws_](std::ptrdiff_t c) {
    const bool grains = f[c] >= least_solid_fraction;
    kappa[c] = grains ? laws.conductivity_to_viscosity(f[c], e[c]) * mu[c] : 0.0;
    mass[c] = grains ? 1.5 * f[c] * rho_s / dt : 0.0;
    rhs[c] = mass[c] * t[c];
  });
  boundary_.fill_scalar(kappa_);
  boundary_.exchange(mass_);
  linear::Faces faces{};
  for (int d = 0; d < grid_.dim; ++d) {
    const std::ptrdiff_t s = grid_.stride(d);
    const double inv_h2 = 1.0 / (grid_.h[d] * grid_.h[d]);
    double* k = conductivity_[d].data();
    for_each(grid_.cells, common(faces_of(cells_, d), grid_.inner_faces(d)), [=](std::ptrdiff_t c) {
      // no conduction into cells without grains
      k[c] = mass[c] > 0.0 && mass[c - s] > 0.0 ? 0.5 * (kappa[c] + kappa[c - s]) * inv_h2 : 0.0;
    });
    for (const InnerWalls::Place& face : boundary_.walls().closed_faces(d)) k[face.at] = 0.0;
    boundary_.exchange(conductivity_[d]);
    faces.lower[d] = k;
  }
  const double scale = max_over(grid_.cells, cells_, 0.0, [=](std::ptrdiff_t c) { return rhs[c]; });
  if (scale == 0.0) return;
  if (!solver_) solver_.emplace(part_of(grid_.cells, cells_), grid_.h);
  solver_->solve(faces, mass, rhs, t, {1e-8 * scale, 1e-6, 50});
  for_each(grid_.cells, cells_, [=](std::ptrdiff_t c) { t[c] = std::max(t[c], 0.0); });
}

namespace {

// Coefficients of the local balance of (7) in a cell, w = sqrt(Theta):
//   3/2 f rho d(w^2)/dt = production - work w^2 - collisions w^3 - expansion w^2 - 3 drag w^2
struct LocalBalance {
  double collisions;  // bumps of walls included [kg/m4]
  double expansion;   // the part of (23) that follows div u_s, of either sign [kg/m3 s]
  double work;        // P_s^K div u_s / Theta, of either sign; 0 without pressure work [kg/m3 s]
  double drag;        // beta of the cell [kg/m3 s]
};

class LocalBalances {
 public:
  LocalBalances(const Scene& scene, const closures::Collisions& laws, const Field& wall_loss,
                const Field& f_s, const Field& beta, const Field& restitution, const StrainRate& strain)
      : rho_s_(scene.solid.density),
        d_s_(scene.solid.diameter),
        work_(scene.model.pressure_work),
        laws_(laws),
        wall_loss_(wall_loss.empty() ? nullptr : wall_loss.data()),
        f_s_(f_s.data()),
        e_(restitution.data()),
        div_(strain.divergence.data()),
        beta_(beta.data()) {}

  LocalBalance operator()(std::ptrdiff_t c) const {
    const double f = f_s_[c], e = e_[c];
    double collisions = laws_.dissipation_rate(f, e, rho_s_, d_s_);
    if (wall_loss_) collisions += wall_loss_[c] * f / laws_.of_g0.f_max * rho_s_ * laws_.g0(f);
    const double expansion = closures::expansion_dissipation_rate(f, e, laws_.g0(f), rho_s_, div_[c]);
    return {collisions, expansion, work_ ? laws_.pressure(f, e, rho_s_) * div_[c] : 0.0, beta_[c]};
  }

  // mu_s^K f_s / sqrt(Theta) [kg/m2]
  double viscosity(std::ptrdiff_t c) const { return laws_.viscosity(f_s_[c], 1.0, e_[c], rho_s_, d_s_); }

 private:
  double rho_s_, d_s_;
  bool work_;
  closures::Collisions laws_;
  const double *wall_loss_, *f_s_, *e_, *div_, *beta_;
};

}  // namespace

// The production A S^2 w is proportional to w: divided by w the balance, 3 f rho dw/dt = A S^2 - collisions
// w^2 - decay w, is a quadratic with one positive root, above zero for grains at rest too.
void GranularTemperature::predict(double dt, const State& now, const Field& beta, const Field& restitution,
                                  const StrainRate& strain, Field& predicted) const {
  const bool steady = !closures::is_transported(scene_.model.granular_temperature);
  const double bound = largest_granular_temperature(scene_), rho_s = scene_.solid.density;
  const LocalBalances at(scene_, laws_, wall_loss_, now.f_s, beta, restitution, strain);
  const double *f = now.f_s.data(), *t = now.theta.data(), *sq = strain.squared.data(),
               *div = strain.divergence.data();
  double* out = predicted.data();
  for_each(grid_.cells, [=](std::ptrdiff_t c) {
    out[c] = 0.0;
    if (f[c] < least_collisional_fraction) return;
    const LocalBalance b = at(c);
    // tau^K : S of (16), without the printed factor 2 (corrections of (7))
    const double production =
        at.viscosity(c) * (2.0 * sq[c] + (closures::bulk_to_shear_viscosity - 2.0 / 3.0) * div[c] * div[c]);
    const double inertia = steady ? 0.0 : 3.0 * f[c] * rho_s / dt;
    const double decay = 3.0 * b.drag + std::max(b.expansion + b.work, 0.0);
    const double start = steady ? 0.0 : std::sqrt(t[c]);
    const double w = closures::positive_root(b.collisions, inertia + decay, production + inertia * start);
    out[c] = steady ? std::min(w * w, bound) : std::max(t[c], std::min(seed * w * w, bound));
  });
}

// The local balance with its production known: one positive root w, so Theta stays positive. Pressure work is
// that of the old Theta, which is what the momentum felt; where the grains expand by more than they hold, the
// rest of it came from nowhere (`spared` of GranularLosses). The algebraic form drops the time
// term, and takes the work of the new Theta where it is a loss. `excess` is theta_bounds of the ledger, and
// with `spared` and what runs out numerical_granular.
GranularLosses GranularTemperature::balance(double dt, const State& now, const Field& beta,
                                            const Field& restitution, const StrainRate& strain,
                                            const Field& production, State& next) {
  const bool steady = !closures::is_transported(scene_.model.granular_temperature);
  const double bound = largest_granular_temperature(scene_), rho_s = scene_.solid.density;
  const LocalBalances at(scene_, laws_, wall_loss_, next.f_s, beta, restitution, strain);
  const double *f0 = now.f_s.data(), *f = next.f_s.data(), *produced = production.data(),
               *old = now.theta.data();
  double* t = next.theta.data();
  const Sums<5> sums = sum_rows(grid_.cells, cells_, [=](std::ptrdiff_t start, int n) {
    double collided = 0.0, dragged = 0.0, pressed = 0.0, excess = 0.0, spared = 0.0;
    for (std::ptrdiff_t c = start; c < start + n; ++c) {
      if (f[c] < least_collisional_fraction) {
        excess += 1.5 * (steady ? f0[c] : f[c]) * rho_s * t[c] + dt * produced[c];
        t[c] = 0.0;
        continue;
      }
      const LocalBalance b = at(c);
      // Implicit where it is a loss; a gain taken so has a pole near div u_s dt = -3.
      const double loss = std::max(b.expansion, 0.0), gain = std::max(-b.expansion, 0.0) * t[c];
      double inertia = 0.0, held = produced[c], decay = 3.0 * b.drag + loss;
      if (steady) {
        decay += std::max(b.work, 0.0);
      } else {
        inertia = 1.5 * f[c] * rho_s / dt;
        held += inertia * t[c] + gain - b.work * old[c];
      }
      const double w = closures::cubic_root(b.collisions, inertia + decay, std::max(held, 0.0));
      pressed += dt * (steady ? std::max(b.work, 0.0) * w * w : b.work * old[c]);
      spared += steady ? 1.5 * rho_s * (f[c] * w * w - f0[c] * old[c]) : dt * std::max(-held, 0.0);
      t[c] = std::min(w * w, bound);
      excess += 1.5 * f[c] * rho_s * (w * w - t[c]);
      collided += dt * ((b.collisions * w + loss) * w * w - (steady ? 0.0 : gain));
      dragged += dt * 3.0 * b.drag * w * w;
    }
    return Sums<5>{{collided, dragged, pressed, excess, spared}};
  });
  const auto [collided, dragged, pressed, excess, spared] = sums.values;
  const double volume = grid_.cell_volume;
  return {volume * collided, volume * dragged, volume * pressed, volume * excess, 0.0, volume * spared};
}

GranularLosses GranularTemperature::advance(double dt, const State& now, const FaceField& flux_s,
                                            const Field& beta, const Rheology& rheology,
                                            const StrainRate& strain, const Field& production, State& next) {
  const TemperatureModel model = scene_.model.granular_temperature;
  if (!closures::agitates(model)) return {};  // Theta stays zero
  const Range cells = box_of_grains(grid_, now.f_s, next.f_s);
  if (cells != cells_) solver_.reset();
  cells_ = cells;
  double* t = next.theta.data();
  for_each_part_outside(grid_.all_cells(), cells_, [&](const Range& outside) {
    for_each(grid_.cells, outside, [=](std::ptrdiff_t c) { t[c] = 0.0; });
  });
  double run_out = 0.0;
  if (closures::is_transported(model)) {
    run_out = convect(dt, now, flux_s, next);
    conduct(dt, rheology, next);
  }
  GranularLosses losses = balance(dt, now, beta, rheology.restitution, strain, production, next);
  losses.run_out = run_out;
  return losses;
}

}  // namespace granvof
