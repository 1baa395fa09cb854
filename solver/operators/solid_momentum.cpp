#include "solver/operators/solid_momentum.hpp"

#include "solver/scene/parts.hpp"

namespace granvof {
namespace {

// Of the friction solve within a step. From rest slip and shear grow by the ratio of what drives to what
// holds in each.
constexpr int most_passes = 40;
constexpr double missed_friction = 0.05;  // of what friction dissipates: less passes for none
// What friction takes in a step beyond its law, over the energy of the grains' motion: a bed that is only
// just beyond its yield misses little of the friction, and yet all of what drives it.
constexpr double missed_motion = 0.05;

// What a pass changes by less than a share is taken as many times as far, by its double at most.
FaceField ahead(FaceField u, const FaceField& before) {
  for (int d = 0; d < 3; ++d) {
    const double* was = before[d].data();
    for (double& value : u[d].span()) value += (value - *was++) / missed_friction;
  }
  return u;
}

}  // namespace

SolidMomentum::SolidMomentum(const Grid& grid, const Scene& scene, const Boundary& boundary)
    : grid_(grid),
      boundary_(boundary),
      friction_(grid, scene, boundary),
      balance_(grid),
      relaxation_(scene.solid.density * scene.solid.diameter * scene.solid.diameter /
                  (18.0 * (has_liquid(scene) ? scene.liquid : scene.gas).viscosity)) {}

linear::Report SolidMomentum::solve(double dt, const State& now, const MomentumPredictor& predicted,
                                    const FaceInertia& inertia, const InterphaseDrag& drag,
                                    const Rheology& rheology, const Aperture& aperture, State& next) {
  set_balance(dt, now, predicted, inertia, drag, aperture, next);
  linear::Report report = friction_.solve(balance_, inertia, aperture, rheology, now, next);
  bool creeps = false;
  double share_before = 0.0;
  const auto settled = [&](int pass) {
    const Friction::Missed missed = friction_.yields_otherwise(rheology, next);
    // it misses as much in every pass
    creeps = dt < relaxation_ && missed.share <= missed_friction && missed.share > 0.5 * share_before &&
             missed.held > 0.0 && missed.held * dt > missed_motion * kinetic_energy(inertia, next);
    share_before = missed.share;
    if (creeps || missed.share > missed_friction) return false;
    return !friction_.has_coulomb_walls() || (pass > 1 && !friction_.slips_otherwise(next));
  };
  for (int pass = 1; pass < most_passes && !settled(pass); ++pass) {
    next.u_strain = creeps && pass > 1 ? ahead(next.u_s, next.u_strain) : next.u_s;
    boundary_.fill_velocity(next.u_strain, Phase::solid);
    const int before = report.iterations;
    report = friction_.solve_again(balance_, inertia, aperture, rheology, next);
    report.iterations += before;
  }
  recover_fluid(dt, predicted, inertia, drag, next);
  next.u_strain = next.u_s;
  return report;
}

double SolidMomentum::kinetic_energy(const FaceInertia& inertia, const State& next) const {
  double sum = 0.0;
  for (int d = 0; d < grid_.dim; ++d) {
    const double *m = inertia.solid[d].data(), *u = next.u_s[d].data();
    sum += sum_over(grid_.cells, grid_.inner_faces(d), [=](std::ptrdiff_t c) { return m[c] * u[c] * u[c]; });
  }
  return 0.5 * grid_.cell_volume * sum;
}

void SolidMomentum::set_balance(double dt, const State& now, const MomentumPredictor& predicted,
                                const FaceInertia& inertia, const InterphaseDrag& drag,
                                const Aperture& aperture, State& next) {
  for (int d = 0; d < grid_.dim; ++d) {
    const std::ptrdiff_t s = grid_.stride(d);
    const double inv_h = 1.0 / grid_.h[d], inv_dt = 1.0 / dt;
    const double *f = inertia.f_s[d].data(), *solid = inertia.solid[d].data(),
                 *fluid = inertia.fluid[d].data();
    const double *beta = drag.beta()[d].data(), *open = aperture[d].data();
    const double *p_c = now.p_c.data(), *p_s = now.p_s.data(), *us = now.u_s[d].data();
    const double *c_star = predicted.fluid()[d].data(), *s_star = predicted.solid()[d].data();
    double *mass = balance_.mass[d].data(), *rhs = balance_.rhs[d].data(), *guess = next.u_s[d].data();
    if (!inertia.holds_grains) {  // nothing is solved for
      for_each(grid_.cells, grid_.inner_faces(d), [=](std::ptrdiff_t c) { guess[c] = open[c] * c_star[c]; });
      boundary_.exchange(next.u_s[d]);
      continue;
    }
    for_each(grid_.cells, grid_.inner_faces(d), [=](std::ptrdiff_t c) {
      const double m_s = solid[c] * inv_dt, m_c = fluid[c] * inv_dt;
      const double beta_eff = beta[c] * m_c / (m_c + beta[c]);
      mass[c] = m_s + beta_eff;
      rhs[c] = m_s * s_star[c] + beta_eff * c_star[c] - f[c] * (p_c[c] - p_c[c - s]) * inv_h -
               (p_s[c] - p_s[c - s]) * inv_h;
      guess[c] = open[c] * (f[c] >= least_solid_fraction ? us[c] : c_star[c]);
    });
    boundary_.exchange(next.u_s[d]);
  }
}

void SolidMomentum::recover_fluid(double dt, const MomentumPredictor& predicted, const FaceInertia& inertia,
                                  const InterphaseDrag& drag, State& next) const {
  for (int d = 0; d < grid_.dim; ++d) {
    const double inv_dt = 1.0 / dt;
    const double *fluid = inertia.fluid[d].data(), *beta = drag.beta()[d].data();
    const double *c_star = predicted.fluid()[d].data(), *us = next.u_s[d].data();
    double* uc = next.u_c[d].data();
    for_each(grid_.cells, grid_.fluid_faces(d), [=](std::ptrdiff_t c) {
      const double m_c = fluid[c] * inv_dt;
      uc[c] = (m_c * c_star[c] + beta[c] * us[c]) / (m_c + beta[c]);
    });
    boundary_.exchange(next.u_c[d]);
  }
}

}  // namespace granvof
