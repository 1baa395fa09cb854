#include "solver/operators/mass_consistent_convection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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

// Values along a line of faces, from two before the middle one to two beyond it.
struct Plain {
  const double* middle;
  std::ptrdiff_t stride;
  double operator()(std::ptrdiff_t k) const { return middle[k * stride]; }
};
struct Seen {  // with walls inside the tank
  InnerWalls::Line line;
  double operator()(std::ptrdiff_t k) const { return line[static_cast<std::size_t>(2 + k)]; }
};

// What one face loses beside what central differences of the same fluxes would take; its acceleration with
// it.
template <int dim>
struct ConvectFace {
  std::array<std::ptrdiff_t, 3> stride;
  std::array<const double*, 3> carrier;
  std::array<double, 3> per_h;
  const double *m, *v;
  std::ptrdiff_t s;  // along the component
  double least, dt;
  double* a;

  double of_face(std::ptrdiff_t at) const { return 0.5 * (m[at] + m[at - s]); }
  double flux(int e, std::ptrdiff_t at) const {  // upwind, through a face of a cell
    const double w = carrier[e][at];
    return std::max(w, 0.0) * m[at - stride[e]] + std::min(w, 0.0) * m[at];
  }

  // line(c, e): the values of which slopes are made
  template <typename Line>
  double operator()(std::ptrdiff_t c, Line&& line) const {
    const double old = of_face(c);
    double in = 0.0, net = 0.0, brought = 0.0, beyond = 0.0, central = 0.0, heaviest = 0.0;
    for (int e = 0; e < dim; ++e) {
      const std::ptrdiff_t t = stride[e];
      const auto along = line(c, e);
      // Through the sides of the control volume: the means of those of the two cells that it halves. Limited
      // values differ from the upwind ones on either side of a face by half a slope.
      const auto pass = [&](double arriving, int to) {
        const double jump = v[c + to * t] - v[c];
        net += arriving;
        in += std::max(arriving, 0.0);
        brought += std::max(arriving, 0.0) * jump;
        central += 0.5 * arriving * jump;
        const double there = of_face(c + to * t), held = std::min(old, there);
        heaviest = std::max(heaviest, there);
        const double passes = std::fabs(arriving) * dt, harmless = largest_courant * held;
        if (held <= least || passes >= 2.0 * harmless) return;  // where nothing passes nothing too
        const double share = std::min(2.0 - passes / harmless, 1.0);
        const double before = along(0) - along(-to), rise = along(to) - along(0),
                     further = along(2 * to) - along(to);
        beyond -= 0.5 * share *
                  (arriving > 0.0 ? arriving * LimiterVanLeer::slope(rise, further)
                                  : -arriving * LimiterVanLeer::slope(before, rise));
      };
      pass(0.5 * (flux(e, c) + flux(e, c - s)) * per_h[e], -1);
      pass(-0.5 * (flux(e, c + t) + flux(e, c + t - s)) * per_h[e], 1);
    }
    const double next = std::max(old + dt * net, dt * in);
    if (next <= share_that_counts * heaviest) {
      a[c] = 0.0;
      return 0.0;
    }
    // of a face that is drained within the step little is left for what its sides carry beyond the upwind
    a[c] = (brought + std::min(1.0, 1.5 * next / old) * beyond) / next;
    return -v[c] * (old * a[c] - central);
  }
};

template <int dim>
double convect(const Field& mass, double least, const Grid& grid, const InnerWalls& walls, const FaceField& u,
               int d, const Range& faces, double dt, Field& acceleration) {
  const double* v = u[d].data();
  const auto of = [&](auto&& what) { return std::array{what(0), what(1), what(dim == 3 ? 2 : 0)}; };
  const std::array<std::ptrdiff_t, 3> stride = of([&](int e) { return grid.stride(e); });
  const ConvectFace<dim> convect_face{stride,
                                      of([&](int e) { return u[e].data(); }),
                                      of([&](int e) { return 1.0 / grid.h[e]; }),
                                      mass.data(),
                                      v,
                                      grid.stride(d),
                                      least,
                                      dt,
                                      acceleration.data()};
  const Sums<1> sums = sum_rows(grid.cells, faces, [=](std::ptrdiff_t start, int n) {
    const auto plain = [=](std::ptrdiff_t c, int e) { return Plain{v + c, stride[e]}; };
    double taken = 0.0;
    for (int i = 0; i < n; ++i) taken += convect_face(start + i, plain);
    return Sums<1>{{taken}};
  });
  if (walls.none()) return sums.values[0];
  // Again where a wall inside the tank is in sight, with what is seen of it in the place of values beyond it.
  double changed = 0.0;
  for (const InnerWalls::Place& face : walls.faces(d)) {
    if (!faces.contains(face.place)) continue;
    const std::ptrdiff_t c = face.at;
    changed -= convect_face(c, [&](std::ptrdiff_t, int e) { return Plain{v + c, stride[e]}; });
    changed += convect_face(c, [&](std::ptrdiff_t, int e) { return Seen{walls.faces_along(v, c, d, e)}; });
  }
  return sums.values[0] + of_all(grid.cells, changed);
}

}  // namespace

double convect_with_mass(const Field& m, bool limited, double least, const Grid& grid,
                         const InnerWalls& walls, const FaceField& u, int d, const Range& faces, double dt,
                         Field& acceleration) {
  const double from = limited ? least : std::numeric_limits<double>::infinity();
  return grid.dim == 3 ? convect<3>(m, from, grid, walls, u, d, faces, dt, acceleration)
                       : convect<2>(m, from, grid, walls, u, d, faces, dt, acceleration);
}

}  // namespace granvof
