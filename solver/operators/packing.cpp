#include "solver/operators/packing.hpp"

#include <algorithm>
#include <cmath>

#include "solver/closures/shear_dilatancy.hpp"

namespace granvof {

void shear_packing(const Grid& grid, const Contact& contact, double dt, const Field& f_s,
                   const StrainRate& strain, Field& packing) {
  const double *f = f_s.data(), *squared = strain.squared.data(), *divergence = strain.divergence.data();
  double* p = packing.data();
  for_each(grid.cells, [=, &contact](std::ptrdiff_t c) {
    const double loosest = contact.solid_fraction_min;
    if (f[c] < loosest) {
      p[c] = loosest;
      return;
    }
    const double deviator = std::max(squared[c] - divergence[c] * divergence[c] / 3.0, 0.0);
    const double sheared = closures::sheared_packing(p[c], dt * std::sqrt(2.0 * deviator), contact);
    p[c] = std::clamp(sheared, loosest, contact.solid_fraction_max);
  });
}

}  // namespace granvof
