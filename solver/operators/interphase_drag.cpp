#include "solver/operators/interphase_drag.hpp"

#include <algorithm>
#include <cmath>

#include "solver/closures/drag/drag.hpp"
#include "solver/closures/granular_temperature/laws.hpp"

namespace granvof {
namespace {

// Share of a face's grains that the fluid moves at least. What rests is balanced by its contact pressure but
// for the difference between the densities of fluid that cell and face see: at a water level next to nothing
// would meet no drag at all.
constexpr double least_moving = 0.05;

}  // namespace

void InterphaseDrag::clear() {
  for (int d = 0; d < grid_.dim; ++d) beta_[d].fill(0.0);
  of_cells_.fill(0.0);
}

void InterphaseDrag::update(const Boundary& boundary, const State& now, const FaceInertia& inertia,
                            const Rheology& rheology) {
  if (!scene_.model.drag) return;  // beta_ stays zero
  for (int d = 0; d < grid_.dim; ++d) {
    const double* us = now.u_s[d].data();
    const double* uc = now.u_c[d].data();
    double* w = slip_[d].data();
    for_each(grid_.cells, grid_.cells_and_ghosts(1), [=](std::ptrdiff_t c) { w[c] = uc[c] - us[c]; });
  }
  scene_.model.drag_law.with([&](auto law) { fill(law, boundary, now, inertia, rheology); });
}

template <typename Law>
void InterphaseDrag::fill(Law law, const Boundary& boundary, const State& now, const FaceInertia& inertia,
                          const Rheology& rheology) {
  const Fluid gas = scene_.gas, liquid = scene_.liquid;
  const double d_s = scene_.solid.diameter;
  const double* a = now.alpha.data();
  for (int d = 0; d < grid_.dim; ++d) {
    const std::ptrdiff_t s = grid_.stride(d);
    const double* own = slip_[d].data();
    const double* f = inertia.f_s[d].data();
    const bool hindered_by_receiver = closures::is_of_second_order(scene_.numerics.transport_scheme);
    if (hindered_by_receiver)
      fraction_.face_values(grid_, boundary.walls(), now.f_s, slip_[d], d, 0.0, grid_.inner_faces(d),
                            hindering_);
    const double *receiver = hindering_.data(), *rest = rheology.part_cells.at_rest.data(),
                 *held = rheology.part_cells.held.data(), *side = rheology.free_side.data();
    double* beta = beta_[d].data();
    const int e = (d + 1) % grid_.dim, g = (d + 2) % grid_.dim;
    const bool three = grid_.dim == 3;
    const double* side1 = slip_[e].data();
    const double* side2 = three ? slip_[g].data() : side1;
    const std::ptrdiff_t s1 = grid_.stride(e), s2 = three ? grid_.stride(g) : 0;
    for_each(grid_.cells, grid_.inner_faces(d), [=](std::ptrdiff_t c) {
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
      double moving = f[c];
      if (d == vertical && (side[c - s] > 0.0 || side[c] < 0.0)) {  // a free face
        const double falls = 1.0 - (side[c - s] > 0.0 ? held[c - s] : held[c]);
        const double resting = falls * 0.5 * (rest[c - s] - rest[c]);
        moving = std::clamp(f[c] - resting, least_moving * f[c], f[c]);
      }
      const double hindering = std::max(hindered_by_receiver ? receiver[c] : moving, closures::lone_grain);
      const double share = moving * (1.0 - f[c]) / (hindering * (1.0 - hindering));
      beta[c] = share * closures::drag_coefficient(law, hindering, 0.5 * (a[c] + a[c - s]), std::sqrt(square),
                                                   gas, liquid, d_s);
    });
    for (const std::ptrdiff_t face : grid_.obstacles.faces(d)) beta[face] = 0.0;  // no grains pass
    boundary.exchange(beta_[d]);
  }
  if (!closures::agitates(scene_.model.granular_temperature)) return;
  const std::array<const double*, 3> slip{slip_[0].data(), slip_[1].data(),
                                          grid_.dim == 3 ? slip_[2].data() : nullptr};
  const auto stride = grid_.cells.stride;
  const int dim = grid_.dim;
  const double* f = now.f_s.data();
  double* beta = of_cells_.data();
  for_each(grid_.cells, [=](std::ptrdiff_t c) {
    beta[c] = 0.0;
    if (f[c] < least_solid_fraction) return;
    double square = 0.0;
    for (int d = 0; d < dim; ++d) {
      const double w = 0.5 * (slip[d][c] + slip[d][c + stride[d]]);
      square += w * w;
    }
    beta[c] = closures::drag_coefficient(law, f[c], a[c], std::sqrt(square), gas, liquid, d_s);
  });
}

}  // namespace granvof
