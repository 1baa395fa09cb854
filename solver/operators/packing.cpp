#include "solver/operators/packing.hpp"

#include <algorithm>

#include "solver/closures/critical_packing/laws.hpp"
#include "solver/closures/shear_dilatancy.hpp"

namespace granvof {

void shear_packing(const Grid& grid, const Scene& scene, double dt, const Field& f_s,
                   const Rheology& rheology, const StrainRate& strain, Field& packing) {
  const Contact contact = scene.contact;
  const CriticalPacking law = scene.model.critical_packing;
  const bool by_rate = closures::depends_on_rate(law);
  const double rho_s = scene.solid.density, d_s = scene.solid.diameter;
  const double *f = f_s.data(), *pressure = rheology.enduring_pressure.data(), *sq = strain.squared.data(),
               *div = strain.divergence.data();
  const double* mu = by_rate ? rheology.pore_viscosity.data() : nullptr;
  double* p = packing.data();
  for_each(grid.cells, [=](std::ptrdiff_t c) {
    const double loosest = contact.solid_fraction_min;
    if (f[c] < loosest) {
      p[c] = loosest;
      return;
    }
    const double rate = deviatoric_shear_rate(sq[c], div[c]);
    double critical = contact.critical_solid_fraction;
    if (by_rate && pressure[c] > 0.0)
      critical = closures::bounded_critical_packing(law.with([&](auto of) {
        return of.packing(closures::mixed_inertial_number(rate, pressure[c], rho_s, d_s, mu[c]), contact);
      }),
                                                    p[c], contact);
    p[c] = std::clamp(closures::sheared_packing(p[c], dt * rate, critical, contact), loosest,
                      contact.solid_fraction_max);
  });
}

}  // namespace granvof
