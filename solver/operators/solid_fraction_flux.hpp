// Solid fraction that a face's volume flux carries: first-order upwind (the paper), bounded second order, or
// the steepest bounded one (superbee), which keeps the surface of a bed sharper.
#pragma once

#include <algorithm>
#include <cmath>

#include "solver/closures/slope_limiter/laws.hpp"
#include "solver/grid/field.hpp"
#include "solver/grid/inner_walls.hpp"

namespace granvof {

class SolidFractionFlux {
 public:
  explicit SolidFractionFlux(closures::SlopeLimiter limiter) : limiter_(limiter) {}

  // Fraction carried through the faces of direction d by velocity u over dt; two ghost layers of f must be
  // filled. At u = 0 the mean of both sides, so that a mirrored scene stays mirrored.
  void face_values(const Grid& grid, const InnerWalls& walls, const Field& f_s, const Field& u, int d,
                   double dt, const Range& faces, Field& face) const {
    limiter_.with([&](auto limiter) {
      if constexpr (limiter.second_order)
        limited(grid, walls, f_s, u, d, dt, faces, limiter, face);
      else
        upwind(grid, f_s, u, d, faces, face);
    });
  }

 private:
  // 1 for a flow from the lower side, 0 from the upper one, 1/2 at rest; one choice in another is none that a
  // loop over cells is vectorised with.
  static double share_of_lower(double u) { return 0.5 + (u > 0.0 ? 0.5 : 0.0) - (u < 0.0 ? 0.5 : 0.0); }

  static void upwind(const Grid& grid, const Field& f_s, const Field& u, int d, const Range& faces,
                     Field& face) {
    const double *f = f_s.data(), *v = u.data();
    double* out = face.data();
    const std::ptrdiff_t s = grid.stride(d);
    for_each(grid.cells, faces, [=](std::ptrdiff_t c) {
      const double of_lower = share_of_lower(v[c]);
      out[c] = of_lower * f[c - s] + (1.0 - of_lower) * f[c];
    });
  }

  template <typename Limiter>
  static void limited(const Grid& grid, const InnerWalls& walls, const Field& f_s, const Field& u, int d,
                      double dt, const Range& faces, Limiter limiter, Field& face) {
    const double *f = f_s.data(), *v = u.data();
    double* out = face.data();
    const std::ptrdiff_t s = grid.stride(d);
    const double courant_per_speed = dt / grid.h[d];
    // by values along a stride, `c` the upper side of the face
    const auto carried = [=](const double* values, std::ptrdiff_t c, std::ptrdiff_t t, double w) {
      const double middle = values[c] - values[c - t];
      // the slope, shortened by the Courant number: second order in time too, and bounded up to 1
      const double reach = 0.5 * std::max(1.0 - std::fabs(w) * courant_per_speed, 0.0);
      const double from_lower =
          values[c - t] + reach * limiter.slope(values[c - t] - values[c - 2 * t], middle);
      const double from_upper = values[c] - reach * limiter.slope(values[c + t] - values[c], middle);
      const double of_lower = share_of_lower(w);
      const double upwind = of_lower * from_lower + (1.0 - of_lower) * from_upper;
      return w == 0.0 ? 0.5 * (values[c] + values[c - t]) : upwind;
    };
    for_each(grid.cells, faces, [=](std::ptrdiff_t c) { out[c] = carried(f, c, s, v[c]); });
    for (const InnerWalls::Place& beside : walls.faces(d)) {
      if (!faces.contains(beside.place)) continue;
      const auto line = walls.cells_across(f, beside.at, d);
      out[beside.at] = carried(line.data(), 2, 1, v[beside.at]);
    }
  }

  closures::SlopeLimiter limiter_;
};

}  // namespace granvof
