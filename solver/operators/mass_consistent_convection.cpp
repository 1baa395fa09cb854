#include "solver/operators/mass_consistent_convection.hpp"

#include <algorithm>
#include <cmath>

#include "solver/closures/slope_limiter/van_leer.hpp"
#include "solver/grid/reduce.hpp"

namespace granvof {
namespace {

using closures::LimiterVanLeer;

// Share of a face's mass that may pass a side of its control volume in a step without harm to a limited value
// there; beyond it an explicit one makes new extrema, and at twice as much it is upwind. Without a jump: what
// rounding decides would grow.
constexpr double largest_courant = 0.25;
// Share of the mass of the heaviest face around below which a face holds nothing: a velocity of no mass is
// not solved for.
constexpr double share_that_counts = 1e-6;

// Velocities along a line of faces, from two before the middle one to two beyond it: what slopes are made of.
using Line = InnerWalls::Line;

// The two neighbours of a face along it: their mass, and the mass that comes from their side, negative what
// leaves, per volume and time.
struct Neighbours {
  double mass_before, mass_after;
  double from_before, from_after;
  double jump_before, jump_after;  // their velocity less the face's
};

// What passes the sides of the control volume of one face.
struct Passed {
  double net = 0.0, in = 0.0;  // mass
  double brought = 0.0;        // momentum beside that of the face's own velocity, upwind
  double beyond = 0.0;         // what limited values add to it
  double central = 0.0;        // what central differences of the same fluxes would take
  double heaviest = 0.0;       // of the faces around
};

// One face. Without branches: a loop over faces is vectorised.
template <bool limited>
struct Face {
  double least, dt;

  // jump: to the velocity of the neighbour there; of slopes: the rise to it, that before the face, that
  // beyond the neighbour
  void side(Passed& sum, double old, double there, double arriving, double jump, double rise, double before,
            double further) const {
    const double inflow = std::max(arriving, 0.0), amount = std::fabs(arriving);
    sum.net += arriving;
    sum.in += inflow;
    sum.brought += inflow * jump;
    sum.central += 0.5 * arriving * jump;
    sum.heaviest = std::max(sum.heaviest, there);
    if constexpr (limited) {
      // limited values differ from the upwind ones by half a slope of the face that they come from
      const double held = std::min(old, there), passes = amount * dt, harmless = largest_courant * held;
      const double share = std::min(2.0 - passes / harmless, 1.0);
      const double half = 0.5 * amount * LimiterVanLeer::slope(rise, arriving > 0.0 ? further : before);
      sum.beyond -= held > least && passes < 2.0 * harmless ? share * half : 0.0;
    }
  }
  void pass(Passed& sum, double old, const Neighbours& n, const Line& v) const {
    const double back = v[1] - v[2], ahead = v[3] - v[2];
    side(sum, old, n.mass_before, n.from_before, n.jump_before, back, -ahead, v[0] - v[1]);
    side(sum, old, n.mass_after, n.from_after, n.jump_after, ahead, -back, v[4] - v[3]);
  }
  // Its acceleration; `taken` gets what it loses beside central differences.
  double acceleration(const Passed& sum, double old, double v, double& taken) const {
    const double next = std::max(old + dt * sum.net, dt * sum.in);
    const bool holds = next > share_that_counts * sum.heaviest;
    // of a face that is drained within the step little is left for what its sides carry beyond the upwind
    const double a = (sum.brought + std::min(1.0, 1.5 * next / old) * sum.beyond) / next;
    taken -= holds ? v * (old * a - sum.central) : 0.0;
    return holds ? a : 0.0;
  }
};

template <int dim, bool limited>
double convect(const Field& mass, double least, const Grid& grid, const InnerWalls& walls, const FaceField& u,
               int d, const Range& faces, double dt, Field& acceleration) {
  const Face<limited> face{least, dt};
  const double *v = u[d].data(), *m = mass.data();
  double* out = acceleration.data();
  const std::ptrdiff_t s = grid.stride(d);
  const auto of_face = [=](std::ptrdiff_t at) { return 0.5 * (m[at] + m[at - s]); };
  // Through the sides of the control volume: the means of the upwind fluxes of the two cells that it halves.
  const auto neighbours = [=](std::ptrdiff_t c, const double* w, std::ptrdiff_t t, double per_h) {
    const auto flux = [=](std::ptrdiff_t at) {
      return std::max(w[at], 0.0) * m[at - t] + std::min(w[at], 0.0) * m[at];
    };
    return Neighbours{of_face(c - t),
                      of_face(c + t),
                      0.5 * (flux(c) + flux(c - s)) * per_h,
                      -0.5 * (flux(c + t) + flux(c + t - s)) * per_h,
                      v[c - t] - v[c],
                      v[c + t] - v[c]};
  };
  // Every direction has its own names: from an array of them a loop that writes is not vectorised.
  const double *w0 = u[0].data(), *w1 = u[1].data(), *w2 = u[dim - 1].data();
  const std::ptrdiff_t t0 = grid.stride(0), t1 = grid.stride(1), t2 = grid.stride(dim - 1);
  const double per_h0 = 1.0 / grid.h[0], per_h1 = 1.0 / grid.h[1], per_h2 = 1.0 / grid.h[dim - 1];
  const auto convect_face = [=](std::ptrdiff_t c, auto&& line_along, double& taken) {
    const double old = of_face(c);
    Passed sum;
    face.pass(sum, old, neighbours(c, w0, t0, per_h0), line_along(c, t0, 0));
    face.pass(sum, old, neighbours(c, w1, t1, per_h1), line_along(c, t1, 1));
    if constexpr (dim == 3) face.pass(sum, old, neighbours(c, w2, t2, per_h2), line_along(c, t2, 2));
    return face.acceleration(sum, old, v[c], taken);
  };
  const auto plain = [=](std::ptrdiff_t c, std::ptrdiff_t t, int) {
    return Line{v[c - 2 * t], v[c - t], v[c], v[c + t], v[c + 2 * t]};
  };
  const Sums<1> sums = sum_rows(grid.cells, faces, [=](std::ptrdiff_t start, int n) {
    double taken = 0.0;
#pragma omp simd reduction(+ : taken)
    for (int i = 0; i < n; ++i) out[start + i] = convect_face(start + i, plain, taken);
    return Sums<1>{{taken}};
  });
  if (walls.none()) return sums.values[0];
  // Again where a wall inside the tank is in sight, with what is seen of it in the place of values beyond it:
  // slopes are made of that, and what crosses a side is as it was.
  double before = 0.0, seen = 0.0;
  for (const InnerWalls::Place& place : walls.faces(d)) {
    if (!faces.contains(place.place)) continue;
    convect_face(place.at, plain, before);
    out[place.at] = convect_face(
        place.at, [&](std::ptrdiff_t c, std::ptrdiff_t, int e) { return walls.faces_along(v, c, d, e); },
        seen);
  }
  return sums.values[0] + of_all(grid.cells, seen - before);
}

}  // namespace

double convect_with_mass(const Field& m, bool limited, double least, const Grid& grid,
                         const InnerWalls& walls, const FaceField& u, int d, const Range& faces, double dt,
                         Field& acceleration) {
  const auto convected = [&](auto dim, auto with_slopes) {
    return convect<dim(), with_slopes()>(m, least, grid, walls, u, d, faces, dt, acceleration);
  };
  using std::bool_constant, std::integral_constant;
  if (grid.dim == 3)
    return limited ? convected(integral_constant<int, 3>{}, bool_constant<true>{})
                   : convected(integral_constant<int, 3>{}, bool_constant<false>{});
  return limited ? convected(integral_constant<int, 2>{}, bool_constant<true>{})
                 : convected(integral_constant<int, 2>{}, bool_constant<false>{});
}

}  // namespace granvof
