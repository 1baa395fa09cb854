// A liquid shape carried by prescribed volume fluxes, and what became of it.
#pragma once

#include <omp.h>

#include "solver/operators/interface_transport.hpp"
#include "solver/tests/operators/tank.hpp"

namespace granvof::test {

inline Scene interface_scene(int n, InterfaceScheme scheme, bool periodic) {
  Scene scene = unit_scene(2, n);
  scene.numerics.interface_scheme = scheme;
  if (periodic)
    for (int d : {0, 1}) make_periodic(scene, d);
  return scene;
}

// Share of every cell inside a shape, from 20 x 20 points.
template <typename Inside>
Field shares(const Tank& s, Inside&& inside) {
  constexpr int points = 20;
  return s.cells([&](const Vec3& x) {
    int count = 0;
    for (int b = 0; b < points; ++b)
      for (int a = 0; a < points; ++a)
        count += inside(x[0] + ((a + 0.5) / points - 0.5) * s.grid.h[0],
                        x[1] + ((b + 0.5) / points - 0.5) * s.grid.h[1])
                     ? 1
                     : 0;
    return static_cast<double>(count) / (points * points);
  });
}

// Volume fluxes per area of a stream function: their divergence vanishes to rounding.
template <typename Stream>
FaceField stream_fluxes(const Tank& s, Stream&& psi) {
  const double hx = s.grid.h[0], hy = s.grid.h[1];
  FaceField q(s.grid);
  s.each(s.grid.cells_and_ghosts(ghost_layers), [&](int i, int j, int, std::ptrdiff_t c) {
    const double x = i * hx, y = j * hy;
    q[0][c] = (psi(x, y + hy) - psi(x, y)) / hy;
    q[1][c] = -(psi(x + hx, y) - psi(x, y)) / hx;
  });
  return q;
}

struct Carried {
  double shape_error = 0.0;   // sum |alpha - start| f_c / sum start f_c [-]
  double volume_error = 0.0;  // relative change of the liquid volume [-]
  double least = 1.0, most = 0.0;
};

inline Carried carry(const Tank& s, const Field& start, const Field& f_s, const FaceField& flux, double dt,
                     int steps) {
  omp_set_num_threads(1);  // small grids: threads that wait for each other cost more than they do
  InterfaceTransport transport(s.grid, s.scene, s.boundary);
  State now(s.grid), next(s.grid);
  Field& alpha = now.alpha;
  alpha = start;
  now.f_s = f_s;
  Carried result;
  for (int step = 0; step < steps; ++step) {
    transport.advance(dt, now, flux, next);
    std::swap(alpha, next.alpha);
    s.boundary.fill_scalar(alpha, 0.0);
    result.least = std::fmin(result.least, s.smallest(alpha));
    result.most = std::fmax(result.most, s.largest(alpha));
  }
  double before = 0.0, after = 0.0, moved = 0.0;
  s.each_cell([&](int, int, int, std::ptrdiff_t c) {
    before += start[c] * (1.0 - f_s[c]);
    after += alpha[c] * (1.0 - f_s[c]);
    moved += std::fabs(alpha[c] - start[c]) * (1.0 - f_s[c]);
  });
  result.shape_error = moved / before;
  result.volume_error = std::fabs(after - before) / before;
  return result;
}

}  // namespace granvof::test
