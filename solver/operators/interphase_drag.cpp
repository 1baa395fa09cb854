#include "solver/operators/interphase_drag.hpp"

#include <algorithm>
#include <cmath>

#include "solver/closures/drag.hpp"

namespace granvof {

void InterphaseDrag::update(const Boundary& boundary, const FaceField& u_s, const FaceField& u_c,
                            const Field& f_s, const Field& alpha, const FaceInertia& inertia) {
  if (!scene_.model.drag) return;  // beta_ stays zero
  for (int d = 0; d < grid_.dim; ++d) {
    const double* us = u_s[d].data();
    const double* uc = u_c[d].data();
    double* w = slip_[d].data();
    for_each(grid_.cells, grid_.cells_and_ghosts(1), [=](std::ptrdiff_t c) { w[c] = uc[c] - us[c]; });
  }
  closures::with_drag_law(scene_.model.drag_law, [&](auto law) { fill(law, boundary, f_s, alpha, inertia); });
}

template <typename Law>
void InterphaseDrag::fill(Law law, const Boundary& boundary, const Field& f_s, const Field& alpha,
                          const FaceInertia& inertia) {
  const Fluid &gas = scene_.gas, &liquid = scene_.liquid;
  const double d_s = scene_.solid.diameter;
  const double* a = alpha.data();
  for (int d = 0; d < grid_.dim; ++d) {
    const std::ptrdiff_t s = grid_.stride(d);
    const double* own = slip_[d].data();
    const double* f = inertia.f_s[d].data();
    const double* h = f;
    if (scene_.numerics.solid_flux != SolidFlux::upwind) {
      fraction_.face_values(grid_, f_s, slip_[d], d, 0.0, grid_.inner_faces(d), hindering_);
      h = hindering_.data();
    }
    double* beta = beta_[d].data();
    const int e = (d + 1) % grid_.dim, g = (d + 2) % grid_.dim;
    const bool three = grid_.dim == 3;
    const double* side1 = slip_[e].data();
    const double* side2 = three ? slip_[g].data() : side1;
    const std::ptrdiff_t s1 = grid_.stride(e), s2 = three ? grid_.stride(g) : 0;
    for_each(grid_.cells, grid_.inner_faces(d), [=, &gas, &liquid](std::ptrdiff_t c) {
      if (f[c] < least_solid_fraction) {
        beta[c] = 0.0;
        return;
      }
      const double w1 = 0.25 * (side1[c] + side1[c - s] + side1[c + s1] + side1[c + s1 - s]);
      double square = own[c] * own[c] + w1 * w1;
      if (three) {
        const double w2 = 0.25 * (side2[c] + side2[c - s] + side2[c + s2] + side2[c + s2 - s]);
        square += w2 * w2;
      }
      const double hindering = std::max(h[c], closures::lone_grain);
      const double share = f[c] * (1.0 - f[c]) / (hindering * (1.0 - hindering));
      beta[c] = share * closures::drag_coefficient(law, hindering, 0.5 * (a[c] + a[c - s]), std::sqrt(square),
                                                   gas, liquid, d_s);
    });
    for (const std::ptrdiff_t face : grid_.obstacles.faces(d)) beta[face] = 0.0;  // no grains pass
    boundary.exchange(beta_[d]);
  }
}

}  // namespace granvof
