#include "solver/operators/rheology.hpp"

#include "solver/closures/agitation_drag.hpp"
#include "solver/closures/drag.hpp"
#include "solver/closures/restitution.hpp"
#include "solver/closures/shear_dilatancy.hpp"
#include "solver/closures/solid_pressure.hpp"
#include "solver/operators/mixture.hpp"
#include "solver/operators/thin_layer.hpp"

namespace granvof {

void Rheology::update(const Grid& grid, const Scene& scene, const Boundary& boundary, const Field& f_s,
                      const Field& theta, const Field& alpha, const Field& p_s, const Field& packing) {
  const bool in_part = scene.numerics.bed_surface == BedSurface::part_cells;
  if (in_part) part_cells.update(grid, scene, f_s, alpha, p_s);
  const Solid& solid = scene.solid;
  const Contact& contact = scene.contact;
  const double mu_l = scene.liquid.viscosity, mu_g = scene.gas.viscosity;
  const bool dilatancy = scene.model.dilatancy_pressure;
  const double *f = f_s.data(), *t = theta.data(), *a = alpha.data(), *weight = part_cells.resting.data(),
               *touching = packing.data();
  double *e = restitution.data(), *p = enduring_pressure.data(), *tan_psi = dilatancy_tangent.data();
  const bool sheared = scene.model.shear_dilatancy;
  const double e0 = scene.model.frictional_restitution
                        ? closures::frictional_restitution(solid.restitution, solid.friction)
                        : solid.restitution;
  for_each(grid.cells, [=, &solid, &contact](std::ptrdiff_t c) {
    e[c] = p[c] = 0.0;
    if (f[c] < least_solid_fraction) return;
    e[c] =
        closures::effective_restitution(e0, t[c], solid.density, solid.diameter, mixture(a[c], mu_l, mu_g));
    p[c] = closures::enduring_pressure(f[c], t[c], e[c], solid.density, contact, dilatancy, weight[c],
                                       touching[c]);
    if (sheared) tan_psi[c] = closures::dilatancy_tangent(touching[c], contact);
  });
  boundary.fill_scalar(restitution);
  boundary.fill_scalar(enduring_pressure);
  if (scene.model.thin_layer_arrest) {
    arrest_thin_layers(grid, scene, f_s, arrest_friction);
    boundary.fill_scalar(arrest_friction);
  }
  if (sheared) boundary.fill_scalar(dilatancy_tangent);
  if (scene.model.agitation_drag) {
    double* beta = agitated_drag.data();
    closures::with_drag_law(scene.model.drag_law, [&](auto law) {
      for_each(grid.cells, [=, &scene](std::ptrdiff_t c) {
        beta[c] = 0.0;
        if (p[c] <= 0.0) return;
        const double drag =
            closures::drag_coefficient(law, f[c], a[c], 0.0, scene.gas, scene.liquid, scene.solid.diameter);
        beta[c] = closures::agitated_drag(drag, f[c], p[c], scene.solid.density, scene.solid.diameter);
      });
    });
    boundary.fill_scalar(agitated_drag);
  }
  if (in_part) {
    const double rho_l = scene.liquid.density, rho_g = scene.gas.density;
    double* side = free_side.data();
    for_each(grid.cells, [=, &solid, &contact](std::ptrdiff_t c) {
      const double without =
          closures::enduring_pressure(f[c], t[c], e[c], solid.density, contact, dilatancy, 0.0, touching[c]);
      const bool part = weight[c] > 0.0 && f[c] < touching[c] && without < p[c];
      side[c] = !part ? 0.0 : solid.density > mixture(a[c], rho_l, rho_g) ? 1.0 : -1.0;
    });
    boundary.exchange(free_side);
    extend_to_walls(grid, scene, f_s, alpha, enduring_pressure);
  }
}

void Rheology::update_kinetic_viscosity(const Grid& grid, const Scene& scene, const Boundary& boundary,
                                        const Field& f_s, const Field& theta) {
  if (!scene.model.kinetic_viscosity) return;  // stays zero
  const Solid& solid = scene.solid;
  const double f_max = scene.contact.solid_fraction_max;
  const double *f = f_s.data(), *t = theta.data(), *e = restitution.data();
  double* mu = kinetic_viscosity.data();
  for_each(grid.cells, [=, &solid](std::ptrdiff_t c) {
    mu[c] =
        f[c] < least_solid_fraction
            ? 0.0
            : f[c] * closures::kinetic_viscosity(f[c], t[c], e[c], closures::radial_distribution(f[c], f_max),
                                                 solid.density, solid.diameter);
  });
  boundary.fill_scalar(kinetic_viscosity);
}

}  // namespace granvof
