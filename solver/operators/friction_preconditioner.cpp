// What the friction solve is preconditioned and judged by.
#include <algorithm>
#include <cmath>

#include "solver/operators/friction.hpp"

namespace granvof {
namespace {

// Of the coupling to the neighbours, in the velocity that a residual is worth. The coupling of a bed at rest
// is a million times its mass. With this share a dry heap takes up to 70 iterations a step while it locks and
// 22 at rest; 1e-3 took 50 and 14, and showed in restated scenes (1.9e-6 of the velocities, bound 1e-6).
constexpr double share_of_the_hold = 1e-6;

}  // namespace

FrictionForm Friction::form(const FaceField& mass) const {
  const double* tilt = tilting(0, vertical);
  return {{normal_viscosity(0), normal_viscosity(vertical)},
          lambda_.data(),
          mu_edge_[plane_index(0, vertical)].data(),
          tilt,
          {marked_[0].data(), marked_[1].data()},
          {mass[0].data(), mass[1].data()}};
}

// Own diffusion of every component; couplings to faces that are known go to the diagonal.
void Friction::set_own_diffusion(const FaceField& mass) {
  for (int d = 0; d < grid_.dim; ++d) {
    const Layout& layout = faces_[d];
    const double *m = marked_[d].data(), *own = mass[d].data(), *mu = normal_viscosity(d),
                 *lambda = lambda_.data();
    double* diagonal = component_mass_[d].data();
    for_each(layout, [=](std::ptrdiff_t c) { diagonal[c] = m[c] * own[c]; });
    for (int e = 0; e < grid_.dim; ++e) {
      const std::ptrdiff_t s = grid_.stride(e);
      const double inv_h2 = 1.0 / (grid_.h[e] * grid_.h[e]);
      const double* edge = e == d ? nullptr : mu_edge_[plane_index(d, e)].data();
      const double* tilt = e == d || d != vertical ? nullptr : tilting(std::min(d, e), std::max(d, e));
      double* a = coefficient_[d][e].data();
      const auto couple_across = [&](auto viscosity) {
        for_each(layout, [=](std::ptrdiff_t c) {
          a[c] = viscosity(c) * inv_h2 * m[c] * m[c - s];
          diagonal[c] +=
              m[c] * inv_h2 * (viscosity(c) * (1.0 - m[c - s]) + viscosity(c + s) * (1.0 - m[c + s]));
        });
      };
      const auto tilted = [=](std::ptrdiff_t c) { return tilt[c] * edge[c]; };
      const auto whole = [=](std::ptrdiff_t c) { return edge[c]; };
      if (e == d) {
        for_each(layout, [=](std::ptrdiff_t c) {
          const double behind = (2.0 * mu[c - s] + lambda[c - s]) * inv_h2,
                       ahead = (2.0 * mu[c] + lambda[c]) * inv_h2;
          a[c] = behind * m[c] * m[c - s];
          diagonal[c] += m[c] * (behind * (1.0 - m[c - s]) + ahead * (1.0 - m[c + s]));
        });
      } else {
        if (tilt != nullptr)
          couple_across(tilted);
        else
          couple_across(whole);
        // a wall is half a cell away: its edge counts twice (once above, through the unmarked ghost)
        for (const bool upper : {false, true}) {
          if (grid_.cells.seam(e, upper)) continue;
          if (upper ? box_.upper[e] < grid_.cells.n[e] : box_.lower[e] > 0) continue;
          Range wall = Range::all(layout);
          wall.lower[e] = upper ? layout.n[e] - 1 : 0;
          wall.upper[e] = wall.lower[e] + 1;
          const std::ptrdiff_t at = upper ? s : 0;
          for_each(layout, wall, [=](std::ptrdiff_t c) {
            diagonal[c] += m[c] * inv_h2 * (tilt != nullptr ? tilted(c + at) : whole(c + at));
          });
        }
      }
      boundary_.exchange(coefficient_[d][e]);
    }
  }
}

void Friction::set_multigrids() {
  if (multigrid_.empty())
    for (int d = 0; d < grid_.dim; ++d) multigrid_.emplace_back(faces_[d], grid_.h);
  for (int d = 0; d < grid_.dim; ++d) {
    linear::Faces faces{};
    for (int e = 0; e < grid_.dim; ++e) faces.lower[e] = coefficient_[d][e].data();
    multigrid_[d].set(faces, component_mass_[d].data());
  }
}

// What velocity a residual is worth: over the mass of its face and, where contacts hold it to others, a share
// of that hold. A bed at rest does not move by what the loose measure of its mass alone would call a speed.
void Friction::set_weights(const FaceField& mass) {
  for (int d = 0; d < grid_.dim; ++d) {
    const double *m = marked_[d].data(), *own = mass[d].data(), *held = component_mass_[d].data();
    double* w = weight_[d].data();
    for_each(faces_[d], [=](std::ptrdiff_t c) { w[c] = held[c] - own[c]; });
    for (int e = 0; e < grid_.dim; ++e) {
      const std::ptrdiff_t s = grid_.stride(e);
      const double* a = coefficient_[d][e].data();
      for_each(faces_[d], [=](std::ptrdiff_t c) { w[c] += a[c] + a[c + s]; });
    }
    for_each(faces_[d],
             [=](std::ptrdiff_t c) { w[c] = m[c] != 0.0 ? 1.0 / (own[c] + share_of_the_hold * w[c]) : 0.0; });
  }
}

}  // namespace granvof
