#include "solver/operators/rheology.hpp"

#include <cmath>

#include "solver/closures/agitation_drag.hpp"
#include "solver/closures/drag/drag.hpp"
#include "solver/closures/restitution.hpp"
#include "solver/closures/shear_dilatancy.hpp"
#include "solver/operators/mixture.hpp"
#include "solver/operators/thin_layer.hpp"

namespace granvof {

// Of grains that the fluid between them stops: the rate of their shear is that of the old level, as for
// friction.
void Rheology::update_viscous_contacts(const Grid& grid, const Scene& scene, const Boundary& boundary,
                                       const State& now, const StrainRate& strain) {
  if (!scene.model.has_viscous_contacts()) return;
  if (pore_viscosity.empty()) pore_viscosity = Field(grid);
  const double mu_l = scene.liquid.viscosity, mu_g = scene.gas.viscosity;
  const double* a = now.alpha.data();
  double* mu = pore_viscosity.data();
  for_each(grid.cells, [=](std::ptrdiff_t c) { mu[c] = mixture(a[c], mu_l, mu_g); });
  boundary.fill_scalar(pore_viscosity);
  if (!scene.model.viscous_contact_pressure) return;
  if (viscous_stress.empty()) viscous_stress = Field(grid);
  const double *f = now.f_s.data(), *sq = strain.squared.data(), *div = strain.divergence.data();
  double* stress = viscous_stress.data();
  for_each(grid.cells, [=](std::ptrdiff_t c) {
    stress[c] = f[c] < least_solid_fraction ? 0.0 : mu[c] * deviatoric_shear_rate(sq[c], div[c]);
  });
}

void Rheology::update(const Grid& grid, const Scene& scene, const closures::SolidLaw& law,
                      const Boundary& boundary, const State& now, const StrainRate& strain) {
  const bool in_part = scene.numerics.has_part_cells();
  if (in_part) part_cells.update(grid, scene, now.f_s, now.alpha, now.p_s);
  const Solid solid = scene.solid;
  const Contact contact = scene.contact;
  const double mu_l = scene.liquid.viscosity, mu_g = scene.gas.viscosity;
  update_viscous_contacts(grid, scene, boundary, now, strain);
  const double* viscous = viscous_stress.empty() ? nullptr : viscous_stress.data();
  const double *f = now.f_s.data(), *t = now.theta.data(), *a = now.alpha.data(),
               *weight = part_cells.resting.data(), *touching = now.packing.data();
  double *e = restitution.data(), *p = enduring_pressure.data(), *tan_psi = dilatancy_tangent.data();
  const bool sheared = scene.model.shear_dilatancy && scene.model.dilatancy_friction;
  const auto borne = [=](std::ptrdiff_t c, double resting) {
    return closures::enduring_pressure(f[c], {t[c], e[c], resting, touching[c], viscous ? viscous[c] : 0.0},
                                       law);
  };
  const double e0 = scene.model.frictional_restitution
                        ? closures::frictional_restitution(solid.restitution, solid.friction)
                        : solid.restitution;
  for_each(grid.cells, [=](std::ptrdiff_t c) {
    e[c] = p[c] = 0.0;
    if (f[c] < least_solid_fraction) return;
    e[c] =
        closures::effective_restitution(e0, t[c], solid.density, solid.diameter, mixture(a[c], mu_l, mu_g));
    p[c] = borne(c, weight[c]);
    if (sheared) tan_psi[c] = closures::dilatancy_tangent(touching[c], contact);
  });
  boundary.fill_scalar(restitution);
  boundary.fill_scalar(enduring_pressure);
  if (scene.model.thin_layer_arrest) {
    arrest_thin_layers(grid, scene, now.f_s, arrest_friction);
    boundary.fill_scalar(arrest_friction);
  }
  if (sheared) boundary.fill_scalar(dilatancy_tangent);
  if (scene.model.agitation_drag) {
    double* beta = agitated_drag.data();
    scene.model.drag_law.with([&](auto drag_law) {
      const Fluid gas = scene.gas, liquid = scene.liquid;
      for_each(grid.cells, [=](std::ptrdiff_t c) {
        beta[c] = 0.0;
        if (p[c] <= 0.0) return;
        const double drag =
            closures::drag_coefficient(drag_law, f[c], a[c], 0.0, gas, liquid, solid.diameter);
        beta[c] = closures::agitated_drag(drag, f[c], p[c], solid.density, solid.diameter);
      });
    });
    boundary.fill_scalar(agitated_drag);
  }
  if (in_part) {
    const double rho_l = scene.liquid.density, rho_g = scene.gas.density;
    double* side = free_side.data();
    for_each(grid.cells, [=](std::ptrdiff_t c) {
      const bool part = weight[c] > 0.0 && f[c] < touching[c] && borne(c, 0.0) < p[c];
      side[c] = !part ? 0.0 : solid.density > mixture(a[c], rho_l, rho_g) ? 1.0 : -1.0;
    });
    boundary.exchange(free_side);
    if (half_weight.empty()) half_weight = Field(grid);
    set_half_weights(grid, scene, now.f_s, now.alpha, half_weight);
    extend_to_walls(grid, half_weight, enduring_pressure);
  }
}

void Rheology::update_kinetic_viscosity(const Grid& grid, const Scene& scene, const closures::SolidLaw& law,
                                        const Boundary& boundary, const Field& f_s, const Field& theta) {
  if (!scene.model.kinetic_viscosity) return;  // stays zero
  const closures::Collisions& laws = law.collisions;
  const double rho_s = scene.solid.density, d_s = scene.solid.diameter;
  const double *f = f_s.data(), *t = theta.data(), *e = restitution.data();
  double* mu = kinetic_viscosity.data();
  for_each(grid.cells, [=](std::ptrdiff_t c) {
    mu[c] = f[c] < least_solid_fraction ? 0.0 : laws.viscosity(f[c], t[c], e[c], rho_s, d_s);
  });
  boundary.fill_scalar(kinetic_viscosity);
  if (scene.model.bounds_collisions()) {
    if (kinetic_pressure.empty()) kinetic_pressure = Field(grid);
    double* p = kinetic_pressure.data();
    for_each(grid.cells, [=](std::ptrdiff_t c) {
      p[c] = f[c] < least_solid_fraction ? 0.0 : laws.pressure(f[c], e[c], rho_s) * t[c];
    });
    boundary.fill_scalar(kinetic_pressure);
  }
  if (!grid.has_bumps()) return;
  if (bump_pressure.empty()) bump_pressure = Field(grid);
  double* bump = bump_pressure.data();
  for_each(grid.cells, [=](std::ptrdiff_t c) {
    bump[c] = f[c] < least_solid_fraction ? 0.0 : laws.pressure(f[c], e[c], rho_s) * std::sqrt(t[c]);
  });
  boundary.fill_scalar(bump_pressure);
}

}  // namespace granvof
