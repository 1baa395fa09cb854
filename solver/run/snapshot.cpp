#include "solver/run/snapshot.hpp"

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

}  // namespace

CellFields cell_fields(const Grid& grid, const State& s) {
  CellFields out;
  out.time = s.time;
  out.cells = grid.cells.n;
  out.spacing = grid.h;
  const auto cells = [&](const Field& f) { return collect(grid, [&](std::ptrdiff_t c) { return f[c]; }); };
  out.f_s = cells(s.f_s);
  out.alpha = cells(s.alpha);
  out.p_c = cells(s.p_c);
  out.p_s = cells(s.p_s);
  out.theta = cells(s.theta);
  out.phi = cells(s.phi);
  for (int d = 0; d < grid.dim; ++d) {
    const std::ptrdiff_t stride = grid.stride(d);
    out.u_s[d] = collect(grid, [&](std::ptrdiff_t c) { return 0.5 * (s.u_s[d][c] + s.u_s[d][c + stride]); });
    out.u_c[d] = collect(grid, [&](std::ptrdiff_t c) { return 0.5 * (s.u_c[d][c] + s.u_c[d][c + stride]); });
  }
  return out;
}

}  // namespace granvof
