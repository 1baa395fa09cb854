#include "solver/run/energy_budget.hpp"

#include "solver/closures/collisions.hpp"
#include "solver/closures/contact_pressure.hpp"
#include "solver/closures/kinetic_theory.hpp"
#include "solver/grid/for_each_row.hpp"
#include "solver/scene/gravity.hpp"

namespace granvof {
// Sums over faces [J]. u, v: velocity of solid and fluid; m: inertia of the old level; 0 and 1: levels.
struct EnergyBudget::FaceWork {
  double force = 0.0;          // m (u1 - u0) u1
  double moved = 0.0;          // 1/2 (m1 - m0) u1^2: mass that crossed faces
  double kinetic = 0.0;        // 1/2 m1 u1^2
  double step = 0.0;           // 1/2 m |u1 - u0|^2
  double explicit_work = 0.0;  // convection, viscosity and gravity
  double gravity = 0.0;        // of which gravity
  double slip = 0.0;           // beta |u - v|^2 dt
  double fluid_pressure = 0.0;
  double flux_pressure = 0.0;  // the same by the fluxes: zero where continuity is solved
  double solid_pressure = 0.0;
  // Through the sides, outwards.
  double potential_out = 0.0, kinetic_out = 0.0, granular_out = 0.0;
  double side_pressure = 0.0;  // by the pressure on the sides, given
  double driving = 0.0;        // of gravity, along periodic directions, which have no potential
};

EnergyBudget::FaceWork EnergyBudget::work_on_faces(double dt, const State& now, const State& next,
                                                   const StepTrace& trace) const {
  FaceWork work;
  for (int d = 0; d < grid_.dim; ++d) {
    add_solid(dt, d, now, next, trace, work);
    add_fluid(dt, d, grid_.inner_faces(d), 1.0, now, next, trace, work);
  }
  grid_.for_each_open_side([&](int d, bool upper) {
    // half a cell of fluid; the velocity of grains is given there
    if (grid_.side(d, upper).passes_fluid)
      add_fluid(dt, d, grid_.side_faces(d, upper), 0.5, now, next, trace, work);
    add_side(dt, d, upper, trace, now, next, work);
  });
  return work;
}

void EnergyBudget::add_solid(double dt, int d, const State& now, const State& next, const StepTrace& trace,
                             FaceWork& work) const {
  const std::ptrdiff_t s = grid_.stride(d);
  const double *m = trace.inertia.solid[d].data(), *f = trace.inertia.f_s[d].data(),
               *beta = trace.beta[d].data(), *star = trace.predicted_s[d].data();
  const double *f1 = next.f_s.data(), *pc = next.p_c.data(), *ps = next.p_s.data();
  const double *u0 = now.u_s[d].data(), *u1 = next.u_s[d].data(), *v1 = next.u_c[d].data();
  double force = 0.0, step = 0.0, before = 0.0, after = 0.0, predicted = 0.0, momentum = 0.0, slip = 0.0;
  double fluid_pressure = 0.0, solid_pressure = 0.0;
  for_each_row(grid_.cells, grid_.inner_faces(d), [&](std::ptrdiff_t start, int n) {
#pragma omp simd reduction(+ : force, step, before, after, predicted, momentum, slip, fluid_pressure, solid_pressure)
    for (int i = 0; i < n; ++i) {
      const std::ptrdiff_t c = start + i;
      const double u = u1[c], du = u - u0[c], mu = m[c] * u, w = u - v1[c];
      force += mu * du;
      step += m[c] * du * du;
      before += mu * u;
      after += (f1[c] + f1[c - s]) * u * u;
      predicted += mu * (star[c] - u0[c]);
      momentum += mu;
      slip += beta[c] * w * w;
      fluid_pressure += f[c] * u * (pc[c] - pc[c - s]);
      solid_pressure += u * (ps[c] - ps[c - s]);
    }
  });
  const double volume = grid_.cell_volume, dt_h = dt / grid_.h[d];
  const double kinetic = 0.25 * scene_.solid.density * after;
  work.force += volume * force;
  work.step += 0.5 * volume * step;
  work.kinetic += volume * kinetic;
  work.moved += volume * (kinetic - 0.5 * before);
  work.explicit_work += volume * predicted;
  add_gravity(dt, d, volume, momentum, work);
  work.slip += volume * dt * slip;
  work.fluid_pressure -= volume * dt_h * fluid_pressure;
  work.solid_pressure -= volume * dt_h * solid_pressure;
}

void EnergyBudget::add_fluid(double dt, int d, const Range& faces, double weight, const State& now,
                             const State& next, const StepTrace& trace, FaceWork& work) const {
  const std::ptrdiff_t s = grid_.stride(d);
  const double *m = trace.inertia.fluid[d].data(), *f = trace.inertia.f_s[d].data(),
               *star = trace.predicted_c[d].data();
  const double *f1 = next.f_s.data(), *a1 = next.alpha.data(), *p0 = now.p_c.data(), *p1 = next.p_c.data();
  const double *v0 = now.u_c[d].data(), *v1 = next.u_c[d].data();
  const double *qs = trace.flux_s[d].data(), *qc = trace.flux_c_solved[d].data();
  const double rho_l = scene_.liquid.density, rho_g = scene_.gas.density, dt_h = dt / grid_.h[d];
  double force = 0.0, step = 0.0, before = 0.0, after = 0.0, predicted = 0.0, momentum = 0.0;
  double fluid_pressure = 0.0, flux_pressure = 0.0;
  for_each_row(grid_.cells, faces, [&](std::ptrdiff_t start, int n) {
#pragma omp simd reduction(+ : force, step, before, after, predicted, momentum, fluid_pressure, flux_pressure)
    for (int i = 0; i < n; ++i) {
      const std::ptrdiff_t c = start + i;
      const double v = v1[c], dv = v - v0[c], mv = m[c] * v, gradient = p1[c] - p1[c - s];
      force += mv * dv;
      step += m[c] * dv * dv;
      before += mv * v;
      after += ((1.0 - f1[c]) * mixture(a1[c], rho_l, rho_g) +
                (1.0 - f1[c - s]) * mixture(a1[c - s], rho_l, rho_g)) *
               v * v;
      predicted += mv * (star[c] - v0[c]) + v * (1.0 - f[c]) * dt_h * (p0[c] - p0[c - s]);
      momentum += mv;
      fluid_pressure += (1.0 - f[c]) * v * gradient;
      flux_pressure += (qs[c] + qc[c]) * gradient;
    }
  });
  const double volume = weight * grid_.cell_volume;
  work.force += volume * force;
  work.step += 0.5 * volume * step;
  work.kinetic += 0.25 * volume * after;
  work.moved += volume * (0.25 * after - 0.5 * before);
  work.explicit_work += volume * predicted;
  add_gravity(dt, d, volume, momentum, work);
  work.fluid_pressure -= volume * dt_h * fluid_pressure;
  work.flux_pressure -= volume * dt_h * flux_pressure;
}

// What passes a side takes its energy along, and the pressure on the side works on it.
void EnergyBudget::add_side(double dt, int d, bool upper, const StepTrace& trace, const State& now,
                            const State& next, FaceWork& work) const {
  const SideRule& side = grid_.side(d, upper);
  const Range faces = grid_.side_faces(d, upper);
  const std::ptrdiff_t s = grid_.stride(d), inside = upper ? -s : 0;
  const double *q = trace.flux_c[d].data(), *v = next.u_c[d].data(), *m = trace.inertia.fluid[d].data(),
               *f = trace.inertia.f_s[d].data(), *liquid = trace.passed.through[d].data();
  const double *qs = trace.flux_s[d].data(), *us = now.u_s[d].data(), *theta = now.theta.data();
  const double rho_l = scene_.liquid.density, rho_g = scene_.gas.density, rho_s = scene_.solid.density;
  const double sign = upper ? 1.0 : -1.0, area = grid_.cell_volume / grid_.h[d];
  const auto total = [&](auto&& term) { return sum_over(grid_.cells, faces, term); };
  const double left = trace.passed.left[2 * d + (upper ? 1 : 0)];
  const double volume =
      sign * dt * grid_.cell_volume / grid_.h[d] * total([=](std::ptrdiff_t c) { return q[c]; });
  const double solid = sign * dt * area * rho_s * total([=](std::ptrdiff_t c) { return qs[c]; });
  const double mass = rho_l * left + rho_g * (volume - left) + solid;
  const auto mass_of_face = [=](std::ptrdiff_t c) {  // per area, along the axis [kg/m2]
    return rho_l * liquid[c] + rho_g * (dt * q[c] - liquid[c]) + dt * rho_s * qs[c];
  };
  const Vec3 g = confined_gravity(scene_);
  if (g[d] != 0.0) work.potential_out += mass * -g[d] * (upper ? scene_.tank[d] : 0.0);
  for (int e = 0; e < grid_.dim; ++e) {  // where gravity acts along the side
    if (e == d || g[e] == 0.0) continue;
    double moment = 0.0;
    for (int j = 0; j < grid_.cells.n[e]; ++j) {
      Range row = faces;
      row.lower[e] = j;
      row.upper[e] = j + 1;
      moment += (j + 0.5) * grid_.h[e] * sum_over(grid_.cells, row, mass_of_face);
    }
    work.potential_out -= sign * area * g[e] * moment;
  }
  if (side.passes_fluid) {
    work.kinetic_out += sign * dt * grid_.cell_volume / grid_.h[d] * total([=](std::ptrdiff_t c) {
                          return 0.5 * m[c] / (1.0 - f[c]) * v[c] * v[c] * q[c];
                        });
    if (const double* given = side_pressure_; given && side.pressure) {
      const std::ptrdiff_t beyond = upper ? 0 : -s;
      const double* solved = trace.flux_c_solved[d].data();
      work.side_pressure -=
          sign * dt * area * total([=](std::ptrdiff_t c) { return given[c + beyond] * (qs[c] + solved[c]); });
    }
  } else {  // as much as comes in, at the pressure that it meets
    const double* p = next.p_c.data();
    work.kinetic_out += sign * area * total([=](std::ptrdiff_t c) {
                          const double of_fluid = rho_l * liquid[c] + rho_g * (dt * q[c] - liquid[c]);
                          return 0.5 * of_fluid * v[c] * v[c];
                        });
    work.side_pressure -=
        sign * dt * area * total([=](std::ptrdiff_t c) { return p[c + inside] * (qs[c] + q[c]); });
  }
  work.kinetic_out +=
      sign * dt * area * total([=](std::ptrdiff_t c) { return 0.5 * rho_s * qs[c] * us[c] * us[c]; });
  work.granular_out +=
      sign * dt * area * total([=](std::ptrdiff_t c) { return 1.5 * rho_s * qs[c] * theta[c + inside]; });
}

void EnergyBudget::add_gravity(double dt, int d, double volume, double momentum, FaceWork& work) const {
  const double g = gravity_of(scene_)[d];
  work.gravity += volume * g * dt * momentum;
  if (grid_.side(d, false).joined) work.driving += volume * g * dt * momentum;
}

double EnergyBudget::potential_energy(const State& s) const {
  const double rho_s = scene_.solid.density, rho_l = scene_.liquid.density, rho_g = scene_.gas.density;
  const double *f = s.f_s.data(), *a = s.alpha.data();
  const Vec3 g = confined_gravity(scene_);
  double energy = 0.0;
  for (const int d : {1, 0}) {
    if (g[d] == 0.0) continue;
    double sum = 0.0;
    for (int j = 0; j < grid_.cells.n[d]; ++j) {
      Range row = grid_.all_cells();
      row.lower[d] = j;
      row.upper[d] = j + 1;
      sum += (j + 0.5) * sum_over(grid_.cells, row, [=](std::ptrdiff_t c) {
               return f[c] * rho_s + (1.0 - f[c]) * mixture(a[c], rho_l, rho_g);
             });
    }
    if (const char* solid = grid_.obstacles.solid()) {  // they hold no gas
      for (int j = 0; j < grid_.cells.n[d]; ++j) {
        Range row = grid_.all_cells();
        row.lower[d] = j;
        row.upper[d] = j + 1;
        sum -= (j + 0.5) * rho_g *
               sum_over(grid_.cells, row, [=](std::ptrdiff_t c) { return solid[c] != 0 ? 1.0 : 0.0; });
      }
    }
    energy -= g[d] * grid_.h[d] * grid_.cell_volume * sum;
  }
  return energy;
}

EnergyTerms EnergyBudget::in_cells(const State& s) const {
  EnergyTerms terms;
  terms.potential = potential_energy(s);
  const double rho_s = scene_.solid.density;
  const double *f = s.f_s.data(), *t = s.theta.data();
  terms.granular = grid_.cell_volume * sum_over(grid_.cells, grid_.all_cells(),
                                                [=](std::ptrdiff_t c) { return 1.5 * rho_s * f[c] * t[c]; });
  terms.elastic = elastic(s.f_s, s.packing);
  return terms;
}

double EnergyBudget::elastic(const Field& f_s, const Field& packing) const {
  const double *f = f_s.data(), *p = packing.data();
  const auto& energy = elastic_energy_;
  return grid_.cell_volume * sum_over(grid_.cells, grid_.all_cells(),
                                      [=, &energy](std::ptrdiff_t c) { return energy(f[c], p[c]); });
}

EnergyTerms EnergyBudget::stored(const State& s) const {
  EnergyTerms terms = in_cells(s);
  FaceInertia inertia(grid_);
  inertia.update(grid_, scene_, s.f_s, s.alpha);
  for (int d = 0; d < grid_.dim; ++d) {
    const double *ms = inertia.solid[d].data(), *mc = inertia.fluid[d].data(), *u = s.u_s[d].data(),
                 *v = s.u_c[d].data();
    terms.kinetic += 0.5 * grid_.cell_volume *
                     sum_over(grid_.cells, grid_.inner_faces(d),
                              [=](std::ptrdiff_t c) { return ms[c] * u[c] * u[c] + mc[c] * v[c] * v[c]; });
    for (const bool upper : {false, true}) {
      if (!grid_.side(d, upper).passes_fluid) continue;
      terms.kinetic += 0.25 * grid_.cell_volume *
                       sum_over(grid_.cells, grid_.side_faces(d, upper),
                                [=](std::ptrdiff_t c) { return mc[c] * v[c] * v[c]; });
    }
  }
  return terms;
}

// P_s of the step is the law's at the new f_s and the old Theta.
EnergyBudget::PressureWork EnergyBudget::pressure_work(double dt, const State& now, const State& next,
                                                       const StepTrace& trace) const {
  const double *f = next.f_s.data(), *theta = now.theta.data(), *packing = now.packing.data();
  const double *e = trace.rheology.restitution.data(), *div = trace.strain.divergence.data();
  const double rho_s = scene_.solid.density;
  const Contact& contact = scene_.contact;
  const closures::Collisions collisions(scene_);
  const auto sum = [&](auto&& term) {
    return dt * grid_.cell_volume * sum_over(grid_.cells, grid_.all_cells(), term);
  };
  return {sum([=, &contact](std::ptrdiff_t c) {
            return f[c] > packing[c] ? closures::elastic_pressure(f[c], contact, packing[c]).value * div[c]
                                     : 0.0;
          }),
          sum([=, &collisions](std::ptrdiff_t c) {
            return closures::kinetic_pressure(f[c], theta[c], e[c], collisions.g0(f[c]), rho_s) * div[c];
          })};
}

EnergyTerms EnergyBudget::of_step(double dt, const State& now, const State& next,
                                  const StepTrace& trace) const {
  const FaceWork w = work_on_faces(dt, now, next, trace);
  const PressureWork pressure = pressure_work(dt, now, next, trace);
  const EnergyTerms& before = now.energy;
  EnergyTerms t = in_cells(next);
  t.kinetic = w.kinetic;
  const double on_grains = dt * trace.stress.on_grains, dissipated = dt * trace.viscous.dissipation;
  const double friction = dt * trace.stress.friction, production = dt * trace.stress.kinetic;

  t.drag = w.slip + trace.granular.drag;
  t.friction = friction;
  t.viscosity = dissipated;
  t.collisions = trace.granular.collisions;
  t.outflow = w.potential_out + w.kinetic_out + w.granular_out - w.side_pressure - w.driving;
  t.walls = dt * (trace.viscous.walls + trace.stress.walls);
  const double of_flow = w.solid_pressure - pressure.elastic;  // kinetic and dense pressure
  t.dilatancy = of_flow - pressure.kinetic;
  t.shear_dilatancy = trace.dilated;
  t.theta_bounds = trace.granular.bounds;

  t.numerical_time = w.step;
  t.numerical_volume = -(t.potential - before.potential + w.potential_out + w.gravity - w.driving +
                         w.fluid_pressure - w.flux_pressure);
  t.numerical_momentum =
      -(w.explicit_work - w.gravity + dissipated - dt * trace.viscous.walls + w.moved + w.kinetic_out);
  t.numerical_stress = -(on_grains + friction + production - dt * trace.stress.walls) -
                       (pressure.elastic + t.elastic - before.elastic - trace.dilated);
  t.numerical_granular = -(pressure.kinetic - production + t.granular - before.granular + w.granular_out +
                           trace.granular.collisions + trace.granular.drag);
  t.residual = w.force - w.explicit_work - on_grains + w.slip - w.fluid_pressure - w.solid_pressure +
               w.flux_pressure - w.side_pressure;
  return t;
}

}  // namespace granvof
