#include "solver/operators/rheology.hpp"

#include "solver/closures/restitution.hpp"
#include "solver/closures/shear_dilatancy.hpp"
#include "solver/closures/solid_pressure.hpp"
#include "solver/operators/bed_surface.hpp"
#include "solver/operators/mixture.hpp"
#include "solver/operators/thin_layer.hpp"

namespace granvof {

void Rheology::update(const Grid& grid, const Scene& scene, const Boundary& boundary, const Field& f_s,
                      const Field& theta, const Field& alpha, const Field& p_s, const Field& packing) {
  const bool part_cells = scene.numerics.bed_surface == BedSurface::part_cells;
  if (part_cells) rest_on_the_bed(grid, scene, f_s, alpha, p_s, support_, resting);
  const Solid& solid = scene.solid;
  const Contact& contact = scene.contact;
  const double mu_l = scene.liquid.viscosity, mu_g = scene.gas.viscosity;
  const bool viscous = scene.model.kinetic_viscosity, dilatancy = scene.model.dilatancy_pressure;
  const double *f = f_s.data(), *t = theta.data(), *a = alpha.data(), *weight = resting.data(),
               *touching = packing.data();
  double *e = restitution.data(), *mu = kinetic_viscosity.data(), *p = enduring_pressure.data(),
         *tan_psi = dilatancy_tangent.data();
  const bool sheared = scene.model.shear_dilatancy;
  for_each(grid.cells, [=, &solid, &contact](std::ptrdiff_t c) {
    e[c] = mu[c] = p[c] = 0.0;
    if (f[c] < least_solid_fraction) return;
    e[c] = closures::effective_restitution(solid.restitution, t[c], solid.density, solid.diameter,
                                           mixture(a[c], mu_l, mu_g));
    p[c] = closures::enduring_pressure(f[c], t[c], e[c], solid.density, contact, dilatancy, weight[c],
                                       touching[c]);
    if (sheared) tan_psi[c] = closures::dilatancy_tangent(touching[c], contact);
    if (!viscous) return;
    const double g0 = closures::radial_distribution(f[c], contact.solid_fraction_max);
    mu[c] = f[c] * closures::kinetic_viscosity(f[c], t[c], e[c], g0, solid.density, solid.diameter);
  });
  boundary.fill_scalar(restitution);
  boundary.fill_scalar(kinetic_viscosity);
  boundary.fill_scalar(enduring_pressure);
  if (scene.model.thin_layer_arrest) {
    arrest_thin_layers(grid, scene, f_s, arrest_friction);
    boundary.fill_scalar(arrest_friction);
  }
  if (sheared) boundary.fill_scalar(dilatancy_tangent);
  if (part_cells) extend_to_walls(grid, scene, f_s, alpha, enduring_pressure);
}

}  // namespace granvof
