#include "solver/run/energy_budget.hpp"

#include "solver/run/energy_faces.hpp"
#include "solver/scene/gravity.hpp"

namespace granvof {

EnergyBudget::EnergyBudget(const Grid& grid, const Scene& scene, const Boundary& boundary)
    : grid_(grid), scene_(scene), boundary_(boundary), elastic_energy_(scene.contact) {}

double EnergyBudget::potential_energy(const State& s) const {
  const double rho_s = scene_.solid.density, rho_l = scene_.liquid.density, rho_g = scene_.gas.density;
  const double *f = s.f_s.data(), *a = s.alpha.data();
  const Vec3 g = confined_gravity(scene_);
  double energy = 0.0;
  for (const int d : {1, 0}) {
    if (g[d] == 0.0) continue;
    double sum = moment_over(grid_.cells, grid_.all_cells(), d, [=](std::ptrdiff_t c) {
      return f[c] * rho_s + (1.0 - f[c]) * mixture(a[c], rho_l, rho_g);
    });
    if (const char* solid = grid_.obstacles.solid())  // they hold no gas
      sum -= rho_g * moment_over(grid_.cells, grid_.all_cells(), d,
                                 [=](std::ptrdiff_t c) { return solid[c] != 0 ? 1.0 : 0.0; });
    energy -= g[d] * grid_.h[d] * grid_.cell_volume * sum;
  }
  return energy;
}

double EnergyBudget::granular_energy(const State& s) const {
  const double rho_s = scene_.solid.density;
  const double *f = s.f_s.data(), *t = s.theta.data();
  return grid_.cell_volume * sum_over(grid_.cells, grid_.all_cells(),
                                      [=](std::ptrdiff_t c) { return 1.5 * rho_s * f[c] * t[c]; });
}

EnergyTerms EnergyBudget::stored(const State& s) const {
  EnergyTerms terms;
  terms.potential = potential_energy(s);
  terms.granular = granular_energy(s);
  terms.elastic = elastic(s.f_s, s.packing);
  FaceInertia inertia(grid_);
  inertia.update(grid_, scene_, s.f_s, s.alpha);
  for (int d = 0; d < grid_.dim; ++d) {
    const double *ms = inertia.solid[d].data(), *mc = inertia.fluid[d].data(), *u = s.u_s[d].data(),
                 *v = s.u_c[d].data();
    terms.kinetic += 0.5 * grid_.cell_volume *
                     sum_over(grid_.cells, grid_.inner_faces(d),
                              [=](std::ptrdiff_t c) { return ms[c] * u[c] * u[c] + mc[c] * v[c] * v[c]; });
  }
  grid_.for_each_passing_side([&](int d, bool upper) {
    const double *mc = inertia.fluid[d].data(), *v = s.u_c[d].data();
    terms.kinetic += 0.25 * grid_.cell_volume *
                     sum_over(grid_.cells, grid_.side_faces(d, upper),
                              [=](std::ptrdiff_t c) { return mc[c] * v[c] * v[c]; });
  });
  return terms;
}

// A bed that shear loosens gets it at the pressure which the step has solved for: its grains follow within
// the step, and what they would hold if they did not is never held. One that shear packs loses what it holds
// before its grains move.
double EnergyBudget::given_by_shear(const State& now, const State& next, const StepTrace& trace) const {
  if (!scene_.model.shear_dilatancy) return 0.0;
  const double *f0 = now.f_s.data(), *f = fraction_of_law(now, next).data(), *p0 = now.packing.data(),
               *p = trace.packing.data();
  const auto* energy = &elastic_energy_;
  return grid_.cell_volume * sum_over(grid_.cells, grid_.all_cells(), [=](std::ptrdiff_t c) {
           return p[c] < p0[c] ? (p0[c] - p[c]) * energy->by_packing(f[c], p[c])
                               : (*energy)(f0[c], p[c]) - (*energy)(f0[c], p0[c]);
         });
}

EnergyTerms EnergyBudget::of_step(double dt, const State& now, const State& next,
                                  const StepTrace& trace) const {
  const bool grains = trace.inertia.holds_grains;
  const double given = grains ? given_by_shear(now, next, trace) : 0.0;
  const FaceWork w = work_on_faces(grid_, scene_, boundary_.side_pressure(), dt, now, next, trace);
  const Friction::Power& stress = trace.stress;
  const GranularLosses& granular = trace.granular;
  EnergyTerms t;
  t.kinetic = w.kinetic;
  t.potential = potential_energy(next);
  t.granular = grains ? granular_energy(next) : 0.0;
  t.elastic = trace.carried;

  t.drag = w.slip + granular.drag;
  t.friction = dt * stress.friction;
  t.viscosity = dt * trace.viscous.dissipation;
  t.collisions = granular.collisions;
  t.outflow = w.potential_out + w.kinetic_out + w.granular_out - w.side_pressure - w.driving -
              dt * (trace.viscous.sides + stress.sides);
  t.walls = dt * (trace.viscous.walls + stress.walls);
  t.dense_excess = (grains ? work_of_flow_pressure(dt, now, next, trace) : 0.0) - granular.pressure;
  t.shear_dilatancy = given;

  t.numerical_time = w.step;
  t.numerical_momentum = -(w.convected + w.moved + w.kinetic_out);
  t.numerical_solid = w.solid_transport;
  t.numerical_fluid = w.fluid_transport;
  t.numerical_viscosity = dt * trace.viscous_power - w.viscous;
  t.numerical_stress = dt * (stress.solved_for - stress.on_grains);
  t.numerical_elastic =
      -(grains ? work_of_contacts(dt, now, next, trace) : 0.0) - (trace.carried - now.energy.elastic - given);
  t.numerical_granular = granular.bounds + granular.run_out - granular.spared;
  t.upwind_momentum = dt * trace.predictor.upwind_power();
  t.theta_bounds = granular.bounds;
  t.residual = t.left_by(now.energy);
  return t;
}

}  // namespace granvof
