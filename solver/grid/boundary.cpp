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

Boundary::Boundary(const Grid& grid) : grid_(grid), walls_(grid) {
  grid.for_each_open_side([&](int d, bool upper) {
    if (!grid.has_side(d, upper)) return;
    const SideRule& rule = grid.side(d, upper);
    if (rule.pressure) set_beyond(side_pressure_, d, upper, rule.pressure);
    if (rule.liquid_that_flows_back)
      set_beyond(flows_back_, d, upper,
                 [&](const Vec3& place) { return rule.liquid_that_flows_back(place, grid.h[vertical]); });
  });
}

template <typename Value>
void Boundary::set_beyond(Field& f, int d, bool upper, Value&& value) const {
  if (f.empty()) f = Field(grid_);
  const Layout& l = grid_.cells;
  std::array<int, 3> at{};
  const int e = (d + 1) % 3, g = (d + 2) % 3;
  at[d] = upper ? l.n[d] : -1;
  for (at[g] = -l.ghost[g]; at[g] < l.n[g] + l.ghost[g]; ++at[g])
    for (at[e] = -l.ghost[e]; at[e] < l.n[e] + l.ghost[e]; ++at[e]) {
      Vec3 place{};
      for (int c = 0; c < 3; ++c) place[c] = (l.first[c] + at[c] + 0.5) * grid_.h[c];
      place[d] = upper ? l.whole[d] * grid_.h[d] : 0.0;
      f[l.index(at)] = value(place);
    }
}

// rule(the side's, value of the nearest cell, index of the first cell beyond) is the ghost value.
template <typename Rule>
void Boundary::fill_cells(Field& f, Rule&& rule) const {
  const Layout& l = grid_.cells;
  exchange(f);
  for (int d = 0; d < grid_.dim; ++d) {
    const std::ptrdiff_t s = l.stride[d], last = (l.n[d] - 1) * s;
    const SideRule &lower = side(d, false), &upper = side(d, true);
    const bool below = !lower.joined, above = !upper.joined;
    if (!below && !above) continue;
    for_side(l, d, [&](std::ptrdiff_t line) {
      for (int g = 1; g <= l.ghost[d]; ++g) {
        if (below) f[line - g * s] = rule(lower, f[line], line - s);
        if (above) f[line + last + g * s] = rule(upper, f[line + last], line + last + s);
      }
    });
  }
}

void Boundary::fill_scalar(Field& f) const {
  fill_cells(f, [](const SideRule&, double inside, std::ptrdiff_t) { return inside; });
}

void Boundary::fill_scalar(Field& f, double beyond) const {
  fill_cells(f, [=](const SideRule& side, double inside, std::ptrdiff_t) {
    return side.passes_fluid ? beyond : inside;
  });
}

void Boundary::fill_solid_fraction(Field& f_s) const {
  fill_cells(f_s, [](const SideRule& side, double inside, std::ptrdiff_t) {
    return side.solid_fraction.value_or(inside);
  });
}

void Boundary::fill_liquid_share(Field& alpha) const {
  fill_cells(alpha, [](const SideRule& side, double inside, std::ptrdiff_t) {
    return side.liquid_share.value_or(inside);
  });
}

void Boundary::fill_liquid_share(Field& alpha, const FaceField& flux_c) const {
  fill_liquid_share(alpha);
  grid_.for_each_open_side([&](int d, bool upper) {
    if (!grid_.has_side(d, upper) || !side(d, upper).liquid_that_flows_back) return;
    const Layout& l = grid_.cells;
    const std::ptrdiff_t s = l.stride[d], face = upper ? l.n[d] * s : 0, beyond = upper ? face : face - s,
                         out = upper ? s : -s;
    const double inward = upper ? -1.0 : 1.0;
    for_side(l, d, [&](std::ptrdiff_t line) {
      if (!(flux_c[d][line + face] * inward > 0.0)) return;
      for (int g = 0; g < l.ghost[d]; ++g) alpha[line + beyond + g * out] = flows_back_[line + beyond];
    });
  });
}

void Boundary::fill_pressure(Field& p) const {
  const double* given = side_pressure();
  fill_cells(p, [=](const SideRule& side, double inside, std::ptrdiff_t beyond) {
    if (!side.passes_fluid) return inside;
    return given && side.pressure ? 2.0 * given[beyond] - inside : -inside;
  });
}

void Boundary::fill_pressure_increment(Field& p) const {
  fill_cells(p, [](const SideRule& side, double inside, std::ptrdiff_t) {
    return side.passes_fluid ? -inside : inside;
  });
}

// The faces on both sides of direction d.
void Boundary::fill_sides(FaceField& u, int d, Phase phase) const {
  const Layout& l = grid_.cells;
  const std::ptrdiff_t s = l.stride[d];
  for (const bool upper : {false, true}) {
    const SideRule& rule = side(d, upper);
    if (rule.joined) continue;
    const std::ptrdiff_t face = upper ? l.n[d] * s : 0, inward = upper ? -s : s;
    const double outward = upper ? 1.0 : -1.0;
    if (phase == Phase::solid && rule.passes_grains) {
      for_side(l, d, [&](std::ptrdiff_t line) {
        const double arriving = u[d][line + face + inward];
        u[d][line + face] = arriving * outward > 0.0 ? arriving : 0.0;
      });
    } else if (!rule.passes(phase)) {
      const double given = rule.inflow(phase) == 0.0 ? 0.0 : -outward * rule.inflow(phase);
      for_side(l, d, [&](std::ptrdiff_t line) { u[d][line + face] = given; });
    }
  }
}

void Boundary::fill_beyond(FaceField& u, int d, bool upper, Phase phase) const {
  const Layout& l = grid_.cells;
  const std::ptrdiff_t s = l.stride[d], out = upper ? s : -s;
  const SideRule& rule = side(d, upper);
  const bool flows = rule.passes(phase) || rule.inflow(phase) != 0.0;
  for (int c = 0; c < grid_.dim; ++c) {
    Field& v = u[c];
    if (c == d) {
      // the faces beyond the side
      const std::ptrdiff_t face = upper ? l.n[d] * s : 0;
      for_side(l, d, [&](std::ptrdiff_t line) {
        v[line + face + out] = flows ? v[line + face] : -v[line + face - out];
        if (!upper) v[line + face + 2 * out] = flows ? v[line + face] : -v[line + face - 2 * out];
      });
      continue;
    }
    const std::ptrdiff_t inside = upper ? (l.n[d] - 1) * s : 0;
    const double share = rule.tangent(phase).share, shift = rule.tangent(phase).shift[c];
    for_side(l, d, [&](std::ptrdiff_t line) {
      for (int g = 1; g <= l.ghost[d]; ++g) v[line + inside + g * out] = shift + share * v[line + inside];
    });
  }
}

void Boundary::fill_velocity(FaceField& u, Phase phase) const {
  for (int c = 0; c < grid_.dim; ++c) exchange(u[c]);
  // The faces on all sides first, then the ghosts: the rows of ghosts along a side then follow the side that
  // they lie beyond, whichever direction comes first. Upper ghosts before lower ones: with one cell between
  // the sides these mirror those.
  for (int d = 0; d < grid_.dim; ++d) fill_sides(u, d, phase);
  for (int d = 0; d < grid_.dim; ++d)
    for (const bool upper : {true, false})
      if (!side(d, upper).joined) fill_beyond(u, d, upper, phase);
}

}  // namespace granvof
