#include "solver/operators/mass_consistent_convection.hpp"

#include <algorithm>
#include <array>

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

// Where nothing is limited.
constexpr double nowhere = 1e300;

template <int dim>
double convect(const Field& mass, double least, const Grid& grid, const FaceField& u, int d,
               const Range& faces, double dt, Field& acceleration) {
  const std::ptrdiff_t s = grid.stride(d);
  const std::array<std::ptrdiff_t, 3> stride{grid.stride(0), grid.stride(1), dim == 3 ? grid.stride(2) : 0};
  const std::array<const double*, 3> carrier{u[0].data(), u[1].data(), dim == 3 ? u[2].data() : nullptr};
  const std::array<double, 3> per_h{1.0 / grid.h[0], 1.0 / grid.h[1], 1.0 / grid.h[2]};
  const double *m = mass.data(), *v = u[d].data();
  double* a = acceleration.data();
  // Returns what its face loses beside what central differences of the same fluxes would take.
  const auto convect_face = [=](std::ptrdiff_t c) {
    const auto of_face = [=](std::ptrdiff_t at) { return 0.5 * (m[at] + m[at - s]); };
    const double old = of_face(c);
    double in = 0.0, net = 0.0, brought = 0.0, beyond = 0.0, central = 0.0, heaviest = 0.0;
    for (int e = 0; e < dim; ++e) {
      const std::ptrdiff_t t = stride[e];
      const auto flux = [=](std::ptrdiff_t at) {  // upwind, through a face of a cell
        const double w = carrier[e][at];
        return std::max(w, 0.0) * m[at - t] + std::min(w, 0.0) * m[at];
      };
      // Through the sides of the control volume: the means of those of the two cells that it halves. Limited
      // values differ from the upwind ones on either side of a face by half a slope.
      const auto pass = [&](double arriving, std::ptrdiff_t to) {
        const double jump = v[c + to] - v[c];
        net += arriving;
        in += std::max(arriving, 0.0);
        brought += std::max(arriving, 0.0) * jump;
        central += 0.5 * arriving * jump;
        const double there = of_face(c + to);
        heaviest = std::max(heaviest, there);
        const double held = std::min(old, there);
        if (held <= least) return;
        const double share = std::clamp(2.0 - std::fabs(arriving) * dt / (largest_courant * held), 0.0, 1.0);
        const double opposite = v[c] - v[c - to], further = v[c + 2 * to] - v[c + to];
        beyond -= 0.5 * share *
                  (arriving > 0.0 ? arriving * LimiterVanLeer::slope(jump, further)
                                  : -arriving * LimiterVanLeer::slope(opposite, jump));
      };
      pass(0.5 * (flux(c) + flux(c - s)) * per_h[e], -t);
      pass(-0.5 * (flux(c + t) + flux(c + t - s)) * per_h[e], t);
    }
    const double next = std::max(old + dt * net, dt * in);
    if (next <= share_that_counts * heaviest) {
      a[c] = 0.0;
      return 0.0;
    }
    // of a face that is drained within the step little is left for what its sides carry beyond the upwind
    a[c] = (brought + std::min(1.0, 1.5 * next / old) * beyond) / next;
    return -v[c] * (old * a[c] - central);
  };
  const Sums<1> sums = sum_rows(grid.cells, faces, [=](std::ptrdiff_t start, int n) {
    double taken = 0.0;
    for (int i = 0; i < n; ++i) taken += convect_face(start + i);
    return Sums<1>{{taken}};
  });
  return sums.values[0];
}

}  // namespace

double convect_with_mass(const Field& m, bool limited, double least, const Grid& grid, const FaceField& u,
                         int d, const Range& faces, double dt, Field& acceleration) {
  const double from = limited ? least : nowhere;
  return grid.dim == 3 ? convect<3>(m, from, grid, u, d, faces, dt, acceleration)
                       : convect<2>(m, from, grid, u, d, faces, dt, acceleration);
}

}  // namespace granvof
