// Random linear systems in the solvers' own terms, and the same as Eigen matrices assembled independently.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include <Eigen/Sparse>

#include "solver/grid/layout.hpp"
#include "solver/linear/coupled_solver.hpp"
#include "solver/linear/faces.hpp"

namespace granvof::linear::testing {

using Values = std::vector<double>;
using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

// Ghosts are two wide and hold NaN: a solver that reads one fails.
struct Box {
  explicit Box(std::array<int, 3> n, std::array<bool, 3> periodic = {})
      : layout(Layout::make(n, {2, 2, 2}, periodic)), random(7) {}

  Values values(double inside = 0.0) const {
    Values v(layout.size, std::numeric_limits<double>::quiet_NaN());
    each([&](int i, int j, int k) { v[layout.index(i, j, k)] = inside; });
    return v;
  }
  void each(const std::function<void(int, int, int)>& visit) const {
    for (int k = 0; k < layout.n[2]; ++k)
      for (int j = 0; j < layout.n[1]; ++j)
        for (int i = 0; i < layout.n[0]; ++i) visit(i, j, k);
  }
  int row(int i, int j, int k) const { return i + layout.n[0] * (j + layout.n[1] * k); }
  double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); }

  // visit(direction, memory index of the lower face, row of the cell, row of its lower neighbour)
  void each_face(const std::function<void(int, std::ptrdiff_t, int, int)>& visit) const {
    each([&](int i, int j, int k) {
      const std::array<int, 3> at{i, j, k};
      for (int d = 0; d < 3; ++d) {
        if (at[d] == 0 && !layout.periodic[d]) continue;
        std::array<int, 3> lower = at;
        lower[d] = (at[d] + layout.n[d] - 1) % layout.n[d];
        visit(d, layout.index(i, j, k), row(i, j, k), row(lower[0], lower[1], lower[2]));
      }
    });
  }
  Vector gather(const Values& v) const {
    Vector out(static_cast<Eigen::Index>(layout.count()));
    each([&](int i, int j, int k) { out[row(i, j, k)] = v[layout.index(i, j, k)]; });
    return out;
  }

  Layout layout;
  std::mt19937 random;
};

struct ScalarSystem {
  // face(direction, row of the cell, row of its lower neighbour)
  ScalarSystem(const Box& box, const std::function<double(int, int, int)>& face_value)
      : mass(box.values()), rhs(box.values()), x(box.values()) {
    for (int d = 0; d < 3; ++d) {
      if (box.layout.n[d] == 1) continue;
      face[d] = box.values();
      faces.lower[d] = face[d].data();
    }
    box.each_face([&](int d, std::ptrdiff_t index, int cell, int lower) {
      if (faces.lower[d]) face[d][index] = face_value(d, cell, lower);
    });
  }
  Matrix matrix(const Box& box) const {
    std::vector<Eigen::Triplet<double>> entries;
    const Vector m = box.gather(mass);
    entries.reserve(static_cast<std::size_t>(m.size()));
    for (int c = 0; c < m.size(); ++c) entries.emplace_back(c, c, m[c]);
    box.each_face([&](int d, std::ptrdiff_t index, int cell, int lower) {
      if (!faces.lower[d]) return;
      const double a = face[d][index];
      entries.emplace_back(cell, cell, a);
      entries.emplace_back(lower, lower, a);
      entries.emplace_back(cell, lower, -a);
      entries.emplace_back(lower, cell, -a);
    });
    Matrix out(m.size(), m.size());
    out.setFromTriplets(entries.begin(), entries.end());
    return out;
  }
  std::array<Values, 3> face;
  Faces faces;
  Values mass, rhs, x;
};

struct BlockSystem {
  // face(direction, row, lower row) = {k11, k12, k21, k22}
  BlockSystem(const Box& box, const std::function<std::array<double, 4>(int, int, int)>& face_value)
      : m11(box.values()),
        m22(box.values()),
        rhs1(box.values()),
        rhs2(box.values()),
        x1(box.values()),
        x2(box.values()) {
    for (int d = 0; d < 3; ++d) {
      if (box.layout.n[d] == 1) continue;
      for (auto& block : k) block[d] = box.values();
    }
    box.each_face([&](int d, std::ptrdiff_t index, int cell, int lower) {
      if (box.layout.n[d] == 1) return;
      const auto value = face_value(d, cell, lower);
      for (int b = 0; b < 4; ++b) k[b][d][index] = value[b];
    });
  }
  CoupledSystem system() const {
    CoupledSystem s;
    for (int d = 0; d < 3; ++d) {
      if (k[0][d].empty()) continue;
      s.k11[d] = k[0][d].data();
      s.k12[d] = k[1][d].data();
      s.k21[d] = k[2][d].data();
      s.k22[d] = k[3][d].data();
    }
    s.m11 = m11.data();
    s.m22 = m22.data();
    s.rhs1 = rhs1.data();
    s.rhs2 = rhs2.data();
    return s;
  }
  // Unknowns in the order x1 of all cells, then x2.
  Matrix matrix(const Box& box) const {
    std::vector<Eigen::Triplet<double>> entries;
    const int n = static_cast<int>(box.layout.count());
    const Vector a = box.gather(m11), b = box.gather(m22);
    for (int c = 0; c < n; ++c) {
      entries.emplace_back(c, c, a[c]);
      entries.emplace_back(n + c, n + c, b[c]);
    }
    box.each_face([&](int d, std::ptrdiff_t index, int cell, int lower) {
      for (int block = 0; block < 4; ++block) {
        if (k[block][d].empty()) continue;
        const int r = n * (block / 2), c = n * (block % 2);
        const double v = k[block][d][index];
        entries.emplace_back(r + cell, c + cell, v);
        entries.emplace_back(r + lower, c + lower, v);
        entries.emplace_back(r + cell, c + lower, -v);
        entries.emplace_back(r + lower, c + cell, -v);
      }
    });
    Matrix out(2 * n, 2 * n);
    out.setFromTriplets(entries.begin(), entries.end());
    return out;
  }
  std::array<std::array<Values, 3>, 4> k;
  Values m11, m22, rhs1, rhs2, x1, x2;
};

}  // namespace granvof::linear::testing
