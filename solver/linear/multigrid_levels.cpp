// The levels of a multigrid: their sizes, and their coefficients from those of the finest.
#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/grid/reduce.hpp"
#include "solver/linear/multigrid.hpp"
#include "solver/linear/with_directions.hpp"

namespace granvof::linear {
namespace {

// Of a box that is cut among processes: below it a sweep takes less time than its messages.
constexpr double least_cells_of_a_cut_level = 4096.0;

// Faces and masses of the caller's arrays.
class GivenCoefficients final : public Coefficients {
 public:
  GivenCoefficients(const Layout& l, const Faces& faces, const double* mass)
      : layout_(l), faces_(faces), mass_(mass) {}
  bool coupled(int d) const override { return faces_.lower[d] != nullptr; }
  void faces(int d, int j, int k, float* out) const override { copy(faces_.lower[d], j, k, out); }
  void masses(int j, int k, float* out) const override { copy(mass_, j, k, out); }

 private:
  void copy(const double* values, int j, int k, float* out) const {
    const double* row = values + layout_.index(0, j, k);
    const int n = layout_.n[0];
#pragma omp simd
    for (int i = 0; i < n; ++i) out[i] = static_cast<float>(row[i]);
  }

  const Layout& layout_;
  const Faces& faces_;
  const double* mass_;
};

}  // namespace

// No pair of cells lies across a seam, and there is enough to do on every slab.
bool Multigrid::stays_cut(const Layout& l, const std::array<bool, 3>& coarsened) const {
  bool pairs = true;
  for (int d = 0; d < 3; ++d)
    if (l.is_split(d) && coarsened[d]) pairs = pairs && l.first[d] % 2 == 0;
  const double cells = static_cast<double>(l.whole[0]) * l.whole[1] * l.whole[2];
  return everywhere(l, pairs) && cells >= least_cells_of_a_cut_level;
}

void Multigrid::build(const std::array<bool, 3>& coupled) {
  levels_.clear();
  Layout at = user_;
  std::array<double, 3> spacing = spacing_;
  for (;;) {
    Level l;
    double shortest = 0.0;
    bool last = true;
    for (int d = 0; d < 3; ++d) {
      l.coupled[d] = coupled[d] && at.whole[d] > 1;
      if (l.coupled[d] && (last || spacing[d] < shortest)) shortest = spacing[d];
      last = last && !l.coupled[d];
    }
    // Ghosts do not depend on what is coupled, so that the layout never changes.
    l.layout = padded_layout(at);
    const std::size_t size = l.layout.size;
    for (int d = 0; d < 3; ++d)
      if (l.coupled[d]) l.face[d] = Buffer<float>(size);
    for (auto* b : {&l.mass, &l.scale, &l.root, &l.weight, &l.rhs}) *b = Buffer<float>(size);
    for (auto& x : l.x) x = Buffer<float>(size);
    for (int d = 0; d < 3; ++d) l.coarsened[d] = l.coupled[d] && spacing[d] < 1.99 * shortest;
    const bool cut = at.is_split(0) || at.is_split(1) || at.is_split(2);
    if (cut && !stays_cut(at, l.coarsened)) {
      at.n = at.whole;
      at.first = {0, 0, 0};
      at.communicator = nullptr;
      l.gathered.emplace(l.layout, padded_layout(at), WholeBox::Values::box);
      levels_.push_back(std::move(l));
      continue;
    }
    for (int d = 0; d < 3; ++d) {
      if (!l.coarsened[d]) continue;
      at.n[d] = (at.n[d] + 1) / 2;
      at.first[d] = (at.first[d] + 1) / 2;
      at.whole[d] = (at.whole[d] + 1) / 2;
      spacing[d] *= 2.0;
    }
    levels_.push_back(std::move(l));
    if (last) return;
  }
}

void Multigrid::set(const Faces& faces, const double* mass) {
  set(GivenCoefficients(user_, faces, mass));
}

void Multigrid::set(const Coefficients& coefficients) {
  std::array<bool, 3> coupled{};
  for (int d = 0; d < 3; ++d) coupled[d] = coefficients.coupled(d) && user_.whole[d] > 1;
  if (coupled != levels_.front().coupled) build(coupled);

  Level& finest = levels_.front();
  for_each_row(finest.layout, [&](int j, int k) {
    const std::ptrdiff_t row = finest.layout.index(0, j, k);
    coefficients.masses(j, k, finest.mass.data() + row);
    const std::array<int, 3> position{0, j, k};
    for (int d = 0; d < 3; ++d) {
      if (!finest.coupled[d]) continue;
      float* face = finest.face[d].data() + row;
      coefficients.faces(d, j, k, face);
      if (!finest.layout.seam(d, false) && position[d] == 0) std::fill_n(face, d == 0 ? 1 : user_.n[0], 0.0F);
    }
  });
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    Level& l = levels_[i];
    for (int d = 0; d < 3; ++d)
      if (l.coupled[d]) exchange(l.layout, l.face[d].data());
    if (l.gathered)
      gather_coefficients(l, levels_[i + 1]);
    else if (i + 1 < levels_.size())
      coarsen(l, levels_[i + 1]);
    scale_level(l);
    if (i > 0 && !levels_[i - 1].gathered) weigh(levels_[i - 1], l);
  }
}

void Multigrid::gather_coefficients(const Level& cut, Level& whole) const {
  cut.gathered->collect(cut.mass.data(), whole.mass.data(), true);
  for (int d = 0; d < 3; ++d)
    if (cut.coupled[d]) cut.gathered->collect(cut.face[d].data(), whole.face[d].data(), true);
}

// Sums of the fine masses, and of the fine faces over the growth of the distance between cells.
void Multigrid::coarsen(const Level& fine, Level& coarse) const {
  const Layout& lf = fine.layout;
  const Layout& lc = coarse.layout;
  const std::array<int, 3> ratio{fine.coarsened[0] ? 2 : 1, fine.coarsened[1] ? 2 : 1,
                                 fine.coarsened[2] ? 2 : 1};
  // Distance of coarse cell i from its lower neighbour, in fine cells (an odd direction ends in a single
  // cell).
  const auto distance = [&](int d, int i) {
    if (ratio[d] == 1) return 1.0F;
    const int here = lc.first[d] + i, lower = here == 0 ? lc.whole[d] - 1 : here - 1;
    const auto width = [&](int c) { return std::min(2, lf.whole[d] - 2 * c); };
    return 0.5F * static_cast<float>(width(here) + width(lower));
  };
  for_each_row(lc, [&](int j, int k) {
    const std::ptrdiff_t out = lc.index(0, j, k);
    const int rows_y = std::min(ratio[1], lf.n[1] - ratio[1] * j),
              rows_z = std::min(ratio[2], lf.n[2] - ratio[2] * k);
    // out[i] = factor * (sum over ny x nz fine rows of the pair (or, `single`, of the first of the pair))
    const auto gather = [&](const float* from, float* to, int ny, int nz, bool single, float factor) {
      const int n = lc.n[0];
      for (int b = 0; b < nz; ++b)
        for (int a = 0; a < ny; ++a) {
          const float* row = from + lf.index(0, ratio[1] * j + a, ratio[2] * k + b);
          if (a == 0 && b == 0) std::fill_n(to, n, 0.0F);
          if (ratio[0] == 1 || single) {
            const int step = ratio[0];
#pragma omp simd
            for (int i = 0; i < n; ++i) to[i] += factor * row[step * i];
          } else {
            const int whole = lf.n[0] / 2;
#pragma omp simd
            for (int i = 0; i < whole; ++i) to[i] += factor * (row[2 * i] + row[2 * i + 1]);
            if (whole < n) to[whole] += factor * row[2 * whole];
          }
        }
    };
    gather(fine.mass.data(), coarse.mass.data() + out, rows_y, rows_z, false, 1.0F);
    if (coarse.coupled[0]) {
      float* face = coarse.face[0].data() + out;
      const auto regular = static_cast<float>(ratio[0]);
      gather(fine.face[0].data(), face, rows_y, rows_z, true, 1.0F / regular);
      face[0] *= regular / distance(0, 0);
      if (lc.n[0] > 1) face[lc.n[0] - 1] *= regular / distance(0, lc.n[0] - 1);
    }
    if (coarse.coupled[1])
      gather(fine.face[1].data(), coarse.face[1].data() + out, 1, rows_z, false, 1.0F / distance(1, j));
    if (coarse.coupled[2])
      gather(fine.face[2].data(), coarse.face[2].data() + out, rows_y, 1, false, 1.0F / distance(2, k));
  });
}

// Diagonal, its roots, and the faces divided by the roots of both their cells.
void Multigrid::scale_level(Level& l) {
  const Layout& lay = l.layout;
  const int n = lay.n[0];
  const std::ptrdiff_t sy = lay.stride[1], sz = lay.stride[2];
  const auto [cx, cy, cz] = l.coupled;
  for_each_row(lay, [&, cx = cx, cy = cy, cz = cz](int j, int k) {
    const std::ptrdiff_t row = lay.index(0, j, k);
    float* root = l.root.data() + row;
    float* scale = l.scale.data() + row;
    const float* mass = l.mass.data() + row;
    for (int i = 0; i < n; ++i) root[i] = mass[i];
    const auto add = [&](int d, std::ptrdiff_t stride) {
      const float* face = l.face[d].data() + row;
#pragma omp simd
      for (int i = 0; i < n; ++i) root[i] += face[i] + face[i + stride];
    };
    if (cx) add(0, 1);
    if (cy) add(1, sy);
    if (cz) add(2, sz);
#pragma omp simd
    for (int i = 0; i < n; ++i) {
      const float diagonal = root[i];
      root[i] = std::sqrt(diagonal);
      scale[i] = diagonal > 0.0F ? 1.0F / root[i] : 0.0F;
    }
  });
  exchange(lay, l.scale.data());
  for_each_row(lay, [&](int j, int k) {
    const std::ptrdiff_t row = lay.index(0, j, k);
    const float* scale = l.scale.data() + row;
    for (int d = 0; d < 3; ++d) {
      if (!l.coupled[d]) continue;
      float* face = l.face[d].data() + row;
      const std::ptrdiff_t stride = lay.stride[d];
#pragma omp simd
      for (int i = 0; i < n; ++i) face[i] *= scale[i] * scale[i - stride];
    }
  });
  for (int d = 0; d < 3; ++d)
    if (l.coupled[d]) exchange(lay, l.face[d].data());
}

void Multigrid::weigh(Level& fine, const Level& coarse) const {
  const Layout& lf = fine.layout;
  for_each_row(lf, [&](int j, int k) {
    const std::ptrdiff_t row = lf.index(0, j, k);
    const float* root = fine.root.data() + row;
    float* weight = fine.weight.data() + row;
    const float* scale = coarse.scale.data() +
                         coarse.layout.index(0, fine.coarsened[1] ? j / 2 : j, fine.coarsened[2] ? k / 2 : k);
    const int n = lf.n[0];
    if (!fine.coarsened[0]) {
#pragma omp simd
      for (int i = 0; i < n; ++i) weight[i] = root[i] * scale[i];
    } else {
      const int whole = n / 2;
#pragma omp simd
      for (int i = 0; i < whole; ++i) {
        weight[2 * i] = root[2 * i] * scale[i];
        weight[2 * i + 1] = root[2 * i + 1] * scale[i];
      }
      if (2 * whole < n) weight[2 * whole] = root[2 * whole] * scale[whole];
    }
  });
}

}  // namespace granvof::linear
