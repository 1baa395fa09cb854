#include "solver/run/snapshot.hpp"

#include <cmath>

namespace granvof {
namespace {

// value(index) of every cell in C order (z, y, x).
template <typename Value>
std::vector<double> collect(const Grid& grid, Value&& value) {
  const Layout& l = grid.cells;
  std::vector<double> out;
  out.reserve(l.count());
  for (int k = 0; k < l.n[2]; ++k)
    for (int j = 0; j < l.n[1]; ++j)
      for (int i = 0; i < l.n[0]; ++i) out.push_back(value(l.index(i, j, k)));
  return out;
}

// std::lerp is exact at both ends and never leaves the interval between its values by rounding.
double share_of_later(const State& earlier, const State& later, double time) {
  return (time - earlier.time) / (later.time - earlier.time);
}

// Share of the later value in a mean that is weighted by how much of the carrier there is, too.
double carried_share(double share, double earlier, double later) {
  const double sum = std::lerp(earlier, later, share);
  return sum > 0.0 ? share * later / sum : share;
}

}  // namespace

CellFields cell_fields(const Grid& grid, const State& s) {
  return cell_fields(grid, s, s, s.time);
}

CellFields cell_fields(const Grid& grid, const State& earlier, const State& later, double time) {
  const State &a = earlier, &b = later;
  const double share = time == b.time ? 1.0 : share_of_later(a, b, time);
  CellFields out;
  out.time = time;
  out.cells = grid.cells.n;
  out.spacing = grid.h;
  const auto cells = [&](const Field& x, const Field& y) {
    return collect(grid, [&](std::ptrdiff_t c) { return std::lerp(x[c], y[c], share); });
  };
  const auto of_grains = [&](const Field& x, const Field& y) {
    return collect(grid, [&](std::ptrdiff_t c) {
      return std::lerp(x[c], y[c], carried_share(share, a.f_s[c], b.f_s[c]));
    });
  };
  out.f_s = cells(a.f_s, b.f_s);
  out.alpha = collect(grid, [&](std::ptrdiff_t c) {
    return std::lerp(a.alpha[c], b.alpha[c], carried_share(share, 1.0 - a.f_s[c], 1.0 - b.f_s[c]));
  });
  out.p_c = cells(a.p_c, b.p_c);
  out.p_s = cells(a.p_s, b.p_s);
  out.theta = of_grains(a.theta, b.theta);
  out.phi = of_grains(a.phi, b.phi);
  for (int d = 0; d < grid.dim; ++d) {
    const std::ptrdiff_t stride = grid.stride(d);
    const auto centres = [&](const Field& x, const Field& y) {
      return collect(grid, [&](std::ptrdiff_t c) {
        return std::lerp(0.5 * (x[c] + x[c + stride]), 0.5 * (y[c] + y[c + stride]), share);
      });
    };
    out.u_s[d] = centres(a.u_s[d], b.u_s[d]);
    out.u_c[d] = centres(a.u_c[d], b.u_c[d]);
  }
  return out;
}

EnergyTerms energy_terms_at(const State& earlier, const State& later, double time) {
  if (time == later.time) return later.energy;
  const double share = share_of_later(earlier, later, time);
  EnergyTerms at;
  for (const EnergyTerm& term : energy_terms)
    at.*term.value = std::lerp(earlier.energy.*term.value, later.energy.*term.value, share);
  return at;
}

}  // namespace granvof
