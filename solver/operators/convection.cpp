#include "solver/operators/convection.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "solver/operators/limiter.hpp"

namespace granvof {
namespace {

constexpr double largest_courant = 0.5;  // of an explicit limited difference

// Upwind difference of v along stride s at c for a carrier of sign w; limited: flux differences of van Leer's
// reconstruction, so that a smooth v is differenced to second order and no new extremum appears. Function
// objects: a pointer to a function would be called for every value.
constexpr auto upwind_difference = [](const double* v, std::ptrdiff_t c, std::ptrdiff_t s, double w) {
  return w > 0.0 ? v[c] - v[c - s] : v[c + s] - v[c];
};

constexpr auto limited_difference = [](const double* v, std::ptrdiff_t c, std::ptrdiff_t s, double w) {
  const double back = v[c] - v[c - s], ahead = v[c + s] - v[c];
  if (w > 0.0) {
    const double further = v[c - s] - v[c - 2 * s];
    return back + 0.5 * van_leer(back, ahead) - 0.5 * van_leer(further, back);
  }
  const double further = v[c + 2 * s] - v[c + s];
  return ahead + 0.5 * van_leer(back, ahead) - 0.5 * van_leer(ahead, further);
};

template <typename Difference>
double convect(const Field& mass, const Grid& grid, const FaceField& u, int d, const Range& faces,
               Difference difference, Field& acceleration) {
  const double *v = u[d].data(), *m = mass.data();
  double* out = acceleration.data();
  for_each(grid.cells, faces, [=](std::ptrdiff_t c) { out[c] = 0.0; });
  const std::ptrdiff_t sd = grid.stride(d);
  double taken = 0.0;
  for (int e = 0; e < grid.dim; ++e) {
    const std::ptrdiff_t s = grid.stride(e);
    const double inv_h = 1.0 / grid.h[e];
    const double* carrier = u[e].data();
    const auto add = [=](std::ptrdiff_t c, double w, double slope) {
      out[c] -= w * inv_h * slope;
      return m[c] * v[c] * w * inv_h * (slope - 0.5 * (v[c + s] - v[c - s]));
    };
    if (e == d) {
      const auto along = [&](const Range& r, auto difference_along) {
        taken += sum_over(grid.cells, r, [=](std::ptrdiff_t c) {
          const double w = carrier[c];
          return add(c, w, difference_along(v, c, s, w));
        });
      };
      // on sides that the phase passes the ghosts end one face beyond
      Range inside = common(faces, grid.inner_faces(d)), first = faces, last = faces;
      first.upper[d] = inside.lower[d];
      last.lower[d] = inside.upper[d];
      along(first, upwind_difference);
      along(inside, difference);
      along(last, upwind_difference);
    } else {
      // the carrier component, averaged to the face of d
      taken += sum_over(grid.cells, faces, [=](std::ptrdiff_t c) {
        const double w = 0.25 * (carrier[c] + carrier[c - sd] + carrier[c + s] + carrier[c + s - sd]);
        return add(c, w, difference(v, c, s, w));
      });
    }
  }
  return taken;
}

}  // namespace

double convective_acceleration(const Field& mass, const Grid& grid, const FaceField& u, int d,
                               const Range& faces, bool limited, Field& acceleration) {
  return limited ? convect(mass, grid, u, d, faces, limited_difference, acceleration)
                 : convect(mass, grid, u, d, faces, upwind_difference, acceleration);
}

double convective_acceleration_limited_in(const Field& mass, double least, const Grid& grid,
                                          const FaceField& u, int d, const Range& faces,
                                          Field& acceleration) {
  const double* m = mass.data();
  const auto limited_inside = [=](const double* v, std::ptrdiff_t c, std::ptrdiff_t s, double w) {
    return m[c] > least ? limited_difference(v, c, s, w) : upwind_difference(v, c, s, w);
  };
  return convect(mass, grid, u, d, faces, limited_inside, acceleration);
}

void bound_convection(const Grid& grid, const FaceField& u, int d, const Range& faces, double dt,
                      const Field& fraction, double least, Field& acceleration) {
  const double* f = fraction.data();
  double* a = acceleration.data();
  const std::ptrdiff_t sd = grid.stride(d);
  const int dim = grid.dim;
  std::array<const double*, 3> carrier{};
  std::array<double, 3> per_h{};
  for (int e = 0; e < dim; ++e) {
    carrier[e] = u[e].data();
    per_h[e] = dt / grid.h[e];
  }
  const std::array<std::ptrdiff_t, 3> stride = grid.cells.stride;
  for_each(grid.cells, faces, [=](std::ptrdiff_t c) {
    if (f[c] >= least) return;
    double courant = std::fabs(carrier[d][c]) * per_h[d];
    for (int e = 0; e < dim; ++e) {
      if (e == d) continue;
      const double* w = carrier[e];
      const std::ptrdiff_t s = stride[e];
      courant += 0.25 * std::fabs(w[c] + w[c - sd] + w[c + s] + w[c + s - sd]) * per_h[e];
    }
    a[c] *= largest_courant / std::max(courant, largest_courant);
  });
}

}  // namespace granvof
