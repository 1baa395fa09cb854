#include "solver/grid/boundary.hpp"

namespace granvof {
namespace {

// The slab of one side: all indices of the other directions, ghosts included.
template <typename Body>
void for_side(const Layout& l, int d, Body&& body) {
  const int e = (d + 1) % 3, f = (d + 2) % 3;
  for (int b = -l.ghost[f]; b < l.n[f] + l.ghost[f]; ++b)
    for (int a = -l.ghost[e]; a < l.n[e] + l.ghost[e]; ++a)
      body(l.origin + a * l.stride[e] + b * l.stride[f]);
}

}  // namespace

// rule(value of the nearest cell, true at an open top) is the ghost value.
template <typename Rule>
void Boundary::fill_cells(Field& f, Rule&& rule) const {
  const Layout& l = grid_.cells;
  communicator_.exchange(l, f.data());
  for (int d = 0; d < grid_.dim; ++d) {
    if (l.periodic[d]) continue;
    const std::ptrdiff_t s = l.stride[d], last = (l.n[d] - 1) * s;
    const bool open = d == 1 && grid_.open_top;
    for_side(l, d, [&](std::ptrdiff_t line) {
      for (int g = 1; g <= l.ghost[d]; ++g) {
        f[line - g * s] = f[line];
        f[line + last + g * s] = rule(f[line + last], open);
      }
    });
  }
}

void Boundary::fill_scalar(Field& f) const {
  fill_cells(f, [](double inside, bool) { return inside; });
}

void Boundary::fill_scalar(Field& f, double beyond_open_top) const {
  fill_cells(f, [=](double inside, bool open) { return open ? beyond_open_top : inside; });
}

void Boundary::fill_pressure(Field& p) const {
  fill_cells(p, [](double inside, bool open) { return open ? -inside : inside; });
}

void Boundary::fill_velocity(FaceField& u, Phase phase) const {
  const Layout& l = grid_.cells;
  for (int c = 0; c < grid_.dim; ++c) communicator_.exchange(l, u[c].data());
  for (int d = 0; d < grid_.dim; ++d) {
    if (l.periodic[d]) continue;
    const std::ptrdiff_t s = l.stride[d];
    const auto is_open = [&](int upper) {
      return sides_[2 * d + upper].kind == SideKind::open && phase == Phase::fluid;
    };
    // Both closed faces first, then the upper ghosts: with one cell between the sides the lower ones mirror
    // those.
    for (int upper = 0; upper < 2; ++upper) {
      if (is_open(upper)) continue;
      const std::ptrdiff_t face = upper ? l.n[d] * s : 0;
      for_side(l, d, [&](std::ptrdiff_t line) { u[d][line + face] = 0.0; });
    }
    for (int upper = 1; upper >= 0; --upper) {
      const Side& side = sides_[2 * d + upper];
      const PhaseWall& wall = phase == Phase::fluid ? side.fluid : side.solid;
      const bool open = is_open(upper);
      for (int c = 0; c < grid_.dim; ++c) {
        Field& v = u[c];
        if (c == d) {
          // the faces beyond the side
          const std::ptrdiff_t face = upper ? l.n[d] * s : 0, out = upper ? s : -s;
          for_side(l, d, [&](std::ptrdiff_t line) {
            v[line + face + out] = open ? v[line + face] : -v[line + face - out];
            if (!upper) v[line + face + 2 * out] = -v[line + face - 2 * out];
          });
          continue;
        }
        const std::ptrdiff_t inside = upper ? (l.n[d] - 1) * s : 0, out = upper ? s : -s;
        const double sign = side.kind == SideKind::wall && wall.kind == WallKind::no_slip ? -1.0 : 1.0;
        const double shift = sign < 0.0 ? 2.0 * side.velocity[c] : 0.0;
        for_side(l, d, [&](std::ptrdiff_t line) {
          for (int g = 1; g <= l.ghost[d]; ++g) v[line + inside + g * out] = shift + sign * v[line + inside];
        });
      }
    }
  }
}

}  // namespace granvof
