#include "solver/operators/convection.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "solver/closures/slope_limiter/van_leer.hpp"

namespace granvof {
namespace {

using closures::LimiterVanLeer;

constexpr double largest_courant = 0.5;  // of an explicit limited difference

// Upwind difference of v along stride s at c, of face `face`, times its carrier w; limited: flux differences
// of van Leer's reconstruction, so that a smooth v is differenced to second order and no new extremum
// appears. Function objects: a pointer to a function would be called for every value. Both sides are worked
// out and one of them is times zero: loads behind a choice keep a loop from being vectorised.
constexpr auto upwind_difference = [](const double* v, std::ptrdiff_t c, std::ptrdiff_t s, double w,
                                      std::ptrdiff_t /*face*/) {
  return std::max(w, 0.0) * (v[c] - v[c - s]) + std::min(w, 0.0) * (v[c + s] - v[c]);
};

constexpr auto limited_difference = [](const double* v, std::ptrdiff_t c, std::ptrdiff_t s, double w,
                                       std::ptrdiff_t /*face*/) {
  const double back = v[c] - v[c - s], ahead = v[c + s] - v[c];
  const double before = v[c - s] - v[c - 2 * s], beyond = v[c + 2 * s] - v[c + s];
  const double middle = 0.5 * LimiterVanLeer::slope(back, ahead);
  return std::max(w, 0.0) * (back + middle - 0.5 * LimiterVanLeer::slope(before, back)) +
         std::min(w, 0.0) * (ahead + middle - 0.5 * LimiterVanLeer::slope(ahead, beyond));
};

// A component and its carrier along one direction.
struct Along {
  const double* carrier;
  std::ptrdiff_t stride;
  double per_h;
};

// Those of component d: its own first.
struct Directions {
  Along own, first, second;
};
template <int dim>
Directions directions_of(const Grid& grid, const FaceField& u, int d) {
  const auto along = [&](int e) { return Along{u[e].data(), grid.stride(e), 1.0 / grid.h[e]}; };
  return {along(d), along(d == 0 ? 1 : 0), dim == 3 ? along(d == 2 ? 1 : 2) : Along{}};
}

// The acceleration on the faces of a range, in one pass over the directions; along d itself, the first of
// them, the differences are `along`, across it `across`. Returns the sum that convection.hpp speaks of. Every
// direction has its own names: from an array of them a loop that writes is not vectorised.
template <int dim, typename DifferenceAlong, typename DifferenceAcross>
double convect_in(const Field& mass, const Grid& grid, const FaceField& u, int d, const Range& faces,
                  DifferenceAlong along, DifferenceAcross across, Field& acceleration) {
  const auto [own, first, second] = directions_of<dim>(grid, u, d);
  const double *v = u[d].data(), *m = mass.data();
  const double *w0 = own.carrier, *w1 = first.carrier, *w2 = second.carrier;
  const std::ptrdiff_t s = own.stride, s1 = first.stride, s2 = second.stride;
  const double per_h = own.per_h, per_h1 = first.per_h, per_h2 = second.per_h;
  double* out = acceleration.data();
  const Sums<1> sums = sum_rows(grid.cells, faces, [=](std::ptrdiff_t start, int n) {
    double taken = 0.0;
#pragma omp simd reduction(+ : taken)
    for (int i = 0; i < n; ++i) {
      const std::ptrdiff_t c = start + i;
      const double rate = w0[c] * per_h, by_own = along(v, c, s, rate, c);
      // the other carriers, averaged to the face of d
      const double rate1 = 0.25 * (w1[c] + w1[c - s] + w1[c + s1] + w1[c + s1 - s]) * per_h1;
      const double by_first = across(v, c, s1, rate1, c);
      double change = by_own + by_first;
      double central = rate * (v[c + s] - v[c - s]) + rate1 * (v[c + s1] - v[c - s1]);
      if constexpr (dim == 3) {
        const double rate2 = 0.25 * (w2[c] + w2[c - s] + w2[c + s2] + w2[c + s2 - s]) * per_h2;
        change += across(v, c, s2, rate2, c);
        central += rate2 * (v[c + s2] - v[c - s2]);
      }
      out[c] = -change;
      taken += m[c] * v[c] * (change - 0.5 * central);
    }
    return Sums<1>{{taken}};
  });
  return sums.values[0];
}

// The same on faces from which a wall inside the tank is in sight, in the place of what convect_in() made of
// the values beyond it. Returns what this process's part of the sum changes by.
template <int dim, typename DifferenceAlong, typename DifferenceAcross>
double convect_beside_walls(const Field& mass, const Grid& grid, const InnerWalls& walls, const FaceField& u,
                            int d, const Range& faces, DifferenceAlong along, DifferenceAcross across,
                            Field& acceleration) {
  const double* v = u[d].data();
  const std::ptrdiff_t s = grid.stride(d);
  double gained = 0.0;
  for (const InnerWalls::Place& face : walls.faces(d)) {
    if (!faces.contains(face.place)) continue;
    const std::ptrdiff_t c = face.at;
    double change = 0.0, central = 0.0, seen = 0.0, seen_central = 0.0;  // with what is beyond, with walls
    for (int e = 0; e < dim; ++e) {
      const double* w = u[e].data();
      const std::ptrdiff_t t = grid.stride(e);
      const double carrier = e == d ? w[c] : 0.25 * (w[c] + w[c - s] + w[c + t] + w[c + t - s]);
      const double rate = carrier / grid.h[e];
      const auto add = [&](const double* values, std::ptrdiff_t at, std::ptrdiff_t step, double& sum,
                           double& sum_central) {
        sum += e == d ? along(values, at, step, rate, c) : across(values, at, step, rate, c);
        sum_central += rate * (values[at + step] - values[at - step]);
      };
      add(v, c, t, change, central);
      const InnerWalls::Line line = walls.faces_along(v, c, d, e);
      add(line.data(), 2, 1, seen, seen_central);
    }
    acceleration[c] = -seen;
    gained += mass[c] * v[c] * (seen - change - 0.5 * (seen_central - central));
  }
  return gained;
}

template <int dim, typename Difference>
double convect(const Field& mass, const Grid& grid, const InnerWalls& walls, const FaceField& u, int d,
               const Range& faces, Difference difference, Field& acceleration) {
  // on sides that the phase passes the ghosts end one face beyond
  Range inside = common(faces, grid.inner_faces(d)), first = faces, last = faces;
  first.upper[d] = inside.lower[d];
  last.lower[d] = inside.upper[d];
  double beside = 0.0;
  const auto part = [&](const Range& r, auto along) {
    const double taken = convect_in<dim>(mass, grid, u, d, r, along, difference, acceleration);
    if (!walls.none())
      beside += convect_beside_walls<dim>(mass, grid, walls, u, d, r, along, difference, acceleration);
    return taken;
  };
  const double taken =
      part(inside, difference) + part(first, upwind_difference) + part(last, upwind_difference);
  return walls.none() ? taken : taken + of_all(grid.cells, beside);
}

template <typename Difference>
double convect(const Field& mass, const Grid& grid, const InnerWalls& walls, const FaceField& u, int d,
               const Range& faces, Difference difference, Field& acceleration) {
  return grid.dim == 3 ? convect<3>(mass, grid, walls, u, d, faces, difference, acceleration)
                       : convect<2>(mass, grid, walls, u, d, faces, difference, acceleration);
}

template <int dim>
void bound(const Grid& grid, const FaceField& u, int d, const Range& faces, double dt, const Field& fraction,
           double least, Field& acceleration) {
  const Directions along = directions_of<dim>(grid, u, d);
  const double *f = fraction.data(), *w0 = along.own.carrier, *w1 = along.first.carrier,
               *w2 = along.second.carrier;
  const std::ptrdiff_t s = along.own.stride, s1 = along.first.stride, s2 = along.second.stride;
  const double dt_h = dt * along.own.per_h, dt_h1 = dt * along.first.per_h, dt_h2 = dt * along.second.per_h;
  double* a = acceleration.data();
  for_each(grid.cells, faces, [=](std::ptrdiff_t c) {
    double courant = std::fabs(w0[c]) * dt_h;
    courant += 0.25 * std::fabs(w1[c] + w1[c - s] + w1[c + s1] + w1[c + s1 - s]) * dt_h1;
    if constexpr (dim == 3)
      courant += 0.25 * std::fabs(w2[c] + w2[c - s] + w2[c + s2] + w2[c + s2 - s]) * dt_h2;
    const double share = largest_courant / std::max(courant, largest_courant);
    a[c] *= f[c] < least ? share : 1.0;
  });
}

}  // namespace

// What these give back is upwind_momentum of the ledger.
double convective_acceleration(const Field& mass, const Grid& grid, const InnerWalls& walls,
                               const FaceField& u, int d, const Range& faces, bool limited,
                               Field& acceleration) {
  return limited ? convect(mass, grid, walls, u, d, faces, limited_difference, acceleration)
                 : convect(mass, grid, walls, u, d, faces, upwind_difference, acceleration);
}

double convective_acceleration_limited_in(const Field& mass, double least, const Grid& grid,
                                          const InnerWalls& walls, const FaceField& u, int d,
                                          const Range& faces, Field& acceleration) {
  const double* m = mass.data();
  const auto limited_inside = [=](const double* v, std::ptrdiff_t c, std::ptrdiff_t s, double w,
                                  std::ptrdiff_t face) {
    const double limited = limited_difference(v, c, s, w, face),
                 one_sided = upwind_difference(v, c, s, w, face);
    return m[face] > least ? limited : one_sided;
  };
  return convect(mass, grid, walls, u, d, faces, limited_inside, acceleration);
}

void bound_convection(const Grid& grid, const FaceField& u, int d, const Range& faces, double dt,
                      const Field& fraction, double least, Field& acceleration) {
  if (grid.dim == 3)
    bound<3>(grid, u, d, faces, dt, fraction, least, acceleration);
  else
    bound<2>(grid, u, d, faces, dt, fraction, least, acceleration);
}

}  // namespace granvof
