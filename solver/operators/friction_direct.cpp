#include "solver/operators/friction_direct.hpp"

#include <algorithm>

namespace granvof {

template <typename Visit>
void FrictionDirect::for_each_face(const Range& box, Visit&& visit) const {
  const int along = box.upper[0] - box.lower[0] >= box.upper[1] - box.lower[1] ? 0 : 1, across = 1 - along;
  std::array<int, 3> at{0, 0, 0};
  for (at[along] = box.lower[along]; at[along] <= box.upper[along]; ++at[along])
    for (at[across] = box.lower[across]; at[across] <= box.upper[across]; ++at[across])
      for (int d = 0; d < 2; ++d)
        if (at[1 - d] < box.upper[1 - d]) visit(d, grid_.cells.index(at[0], at[1], 0));
}

void FrictionDirect::number(const Range& box, const FrictionForm& form) {
  if (box != box_ || number_[0].empty())  // faces outside the box stay without a number
    for (auto& numbers : number_) numbers.assign(grid_.cells.size, -1);
  box_ = box;
  int count = 0;
  for_each_face(box, [&](int d, std::ptrdiff_t c) {
    number_[d][static_cast<std::size_t>(c)] = form.marked[d][c] != 0.0 ? count++ : -1;
  });
  first_.resize(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) first_[static_cast<std::size_t>(i)] = i;
}

void FrictionDirect::add(Strain& strain, int d, std::ptrdiff_t c, double factor) const {
  const int unknown = number_[d][static_cast<std::size_t>(c)];
  if (unknown < 0) return;
  strain.unknown[strain.count] = unknown;
  strain.factor[strain.count++] = factor;
}

template <typename Visit>
void FrictionDirect::for_each_strain(const Range& box, const FrictionForm& form, Visit&& visit) const {
  const auto& n = grid_.cells.n;
  const std::array<std::ptrdiff_t, 2> s{grid_.stride(0), grid_.stride(1)};
  const std::array<double, 2> inv_h{1.0 / grid_.h[0], 1.0 / grid_.h[1]};
  for (int j = box.lower[1]; j < box.upper[1]; ++j) {
    for (int i = box.lower[0]; i < box.upper[0]; ++i) {
      const std::ptrdiff_t c = grid_.cells.index(i, j, 0);
      if (form.mu[0][c] <= 0.0) continue;
      Strain divergence{form.lambda[c]};
      for (int d = 0; d < 2; ++d) {
        Strain stretch{2.0 * form.mu[d][c]};
        for (Strain* strain : {&stretch, &divergence}) {
          add(*strain, d, c + s[d], inv_h[d]);
          add(*strain, d, c, -inv_h[d]);
        }
        visit(stretch);
      }
      if (divergence.weight > 0.0) visit(divergence);
    }
  }
  for (int j = box.lower[1]; j <= box.upper[1]; ++j) {
    for (int i = box.lower[0]; i <= box.upper[0]; ++i) {
      const std::ptrdiff_t c = grid_.cells.index(i, j, 0);
      if (form.edge[c] <= 0.0) continue;
      // on a wall the velocity beyond is minus the inside, and half the edge's volume lies inside
      const std::array<bool, 2> below{i == 0, j == 0}, above{i == n[0], j == n[1]};
      const bool wall = below[0] || below[1] || above[0] || above[1];
      Strain shear{wall ? 0.5 * form.edge[c] : form.edge[c]};
      const double tilt = form.tilting != nullptr ? form.tilting[c] : 1.0;
      for (int d = 0; d < 2; ++d) {
        const int e = 1 - d;
        const double factor = (d == 1 ? tilt : 1.0) * inv_h[e];
        if (below[e]) {
          add(shear, d, c, 2.0 * factor);
        } else if (above[e]) {
          add(shear, d, c - s[e], -2.0 * factor);
        } else {
          add(shear, d, c, factor);
          add(shear, d, c - s[e], -factor);
        }
      }
      visit(shear);
    }
  }
}

bool FrictionDirect::factorise(const Range& box, const FrictionForm& form) {
  if (grid_.dim != 2 || grid_.cells.any_seam(0) || grid_.cells.any_seam(1)) return false;
  number(box, form);
  for_each_strain(box, form, [&](const Strain& strain) {
    const auto* end = strain.unknown.begin() + strain.count;
    if (strain.count == 0) return;
    const int lowest = *std::min_element(strain.unknown.begin(), end);
    for (int i = 0; i < strain.count; ++i) {
      int& first = first_[static_cast<std::size_t>(strain.unknown[i])];
      first = std::min(first, lowest);
    }
  });
  double squares = 0.0;
  for (std::size_t i = 0; i < first_.size(); ++i) {
    const double length = static_cast<double>(i) - first_[i];
    squares += length * length;
  }
  if (squares > longest_rows * static_cast<double>(first_.size())) return false;

  matrix_.reset(first_);
  for_each_strain(box, form, [&](const Strain& strain) {
    for (int a = 0; a < strain.count; ++a)
      for (int b = 0; b <= a; ++b)
        matrix_.add(strain.unknown[a], strain.unknown[b],
                    strain.weight * strain.factor[a] * strain.factor[b]);
  });
  for_each_face(box, [&](int d, std::ptrdiff_t c) {
    const int i = number_[d][static_cast<std::size_t>(c)];
    if (i >= 0) matrix_.add(i, i, form.mass[d][c]);
  });
  x_.resize(first_.size());
  return matrix_.factorise();
}

void FrictionDirect::apply(const linear::ConstComponents& r, const linear::Components& z) {
  for_each_face(box_, [&](int d, std::ptrdiff_t c) {
    const int i = number_[d][static_cast<std::size_t>(c)];
    if (i >= 0) x_[static_cast<std::size_t>(i)] = r[d][c];
  });
  matrix_.solve(x_.data());
  for_each_face(box_, [&](int d, std::ptrdiff_t c) {
    const int i = number_[d][static_cast<std::size_t>(c)];
    z[d][c] = i >= 0 ? x_[static_cast<std::size_t>(i)] : 0.0;
  });
}

}  // namespace granvof
