// The 2x2 system of fluid and granular pressure: BiCGSTAB in double precision around two scalar V-cycles.
//
// Preconditioner (block lower, then upper elimination of the face blocks K = [k11 k12; k21 k22]):
//   P: V-cycle of faces k11 and mass m11; S: V-cycle of the face-wise Schur complement max(0, k22 - k21 k12 /
//   k11) and mass m22; theta = sum k12 / sum k11 per cell. y1 = P r1;  y2 = S (r2 - K21 y1);  y1 -= theta y2.
//
// The second row may hold in a part of the box alone, as grains fill a part of a tank: nothing of it is
// computed beyond.
#pragma once

#include <array>
#include <optional>

#include "solver/grid/for_each.hpp"
#include "solver/grid/memory.hpp"
#include "solver/linear/multigrid.hpp"
#include "solver/linear/padded_layout.hpp"
#include "solver/linear/tolerance.hpp"

namespace granvof::linear {

// Per cell: m11 x1 + sum over faces of [k11 (x1 - x1_neighbour) + k12 (x2 - x2_neighbour)] = rhs1
//           m22 x2 + sum over faces of [k21 (x1 - x1_neighbour) + k22 (x2 - x2_neighbour)] = rhs2
// Face arrays as in Faces; the four blocks couple the same directions. k11, k22, m11, m22 >= 0, and
// k21 k12 <= k11 k22 on every face. With `second` the second row is that of these cells; k12 and k22 of the
// faces around them are 0, and beyond them x2, m22 and rhs2 are neither read nor written. The range
// spans directions that are periodic or cut among processes, and may be empty.
struct CoupledSystem {
  std::array<const double*, 3> k11{}, k12{}, k21{}, k22{};
  const double* m11 = nullptr;
  const double* m22 = nullptr;
  const double* rhs1 = nullptr;
  const double* rhs2 = nullptr;
  std::optional<Range> second;
};

class CoupledSolver {
 public:
  // Systems whose arrays all have `layout`. `spacing` as in Multigrid.
  explicit CoupledSolver(const Layout& layout, const std::array<double, 3>& spacing = {1.0, 1.0, 1.0});

  // x1 and x2 are the guess on entry. Converged when each row's residual is below max(absolute, relative
  // times its own initial residual); the report holds the larger of the two rows. With m11 = 0 everywhere x1
  // is determined up to a constant and rhs1 must sum to 0. Ghosts of all arrays are neither read nor written.
  Report solve(const CoupledSystem& system, double* x1, double* x2, const Tolerance& tolerance);

 private:
  struct Norms {
    double first = 0.0, second = 0.0;
    bool below(const Norms& target) const { return first <= target.first && second <= target.second; }
    double larger() const { return first > second ? first : second; }
    bool finite() const;
  };
  // Scalar products of one product with the matrix: with the given pair, and with itself.
  struct Products {
    double with = 0.0, self = 0.0;
  };
  using Pair = std::array<Buffer<double>, 2>;
  using FloatPair = std::array<Buffer<float>, 2>;

  void fit(const Range& second);
  void set(const CoupledSystem& system);
  Norms true_residual(const CoupledSystem& system, const double* x1, const double* x2);
  void precondition(const Pair& from, FloatPair& to);
  void precondition_second(const double* r2, FloatPair& to);
  bool has_second(int j, int k) const;
  template <bool X, bool Y, bool Z, typename T>
  void product_row(const CoupledSystem& system, const T* v1, const T* v2, int j, int k, double* out1,
                   double* out2);
  Products multiply(const CoupledSystem& system, FloatPair& v, Pair& out, const Pair& with);
  Norms subtract(double factor, const Pair& what);
  void advance(double alpha, double omega, double* x1, double* x2);
  double dot(const Pair& a, const Pair& b) const;
  double first_direction();
  void direction(double beta, double omega);

  Layout user_;
  std::array<double, 3> spacing_;
  Multigrid pressure_;
  std::optional<Multigrid> granular_;  // of the part with a second row; none without
  Range part_{{0, 0, 0}, {0, 0, 0}};   // cells with a second row
  std::array<Layout, 2> given_;        // of either row's values, as the caller keeps them
  std::array<Layout, 2> layout_;       // padded, of everything below
  std::array<bool, 3> coupled_{};
  Buffer<double> zeros_;
  Buffer<float> theta_;               // of the second row's cells
  std::array<Buffer<float>, 3> k21_;  // of the first row's layout; ghosts beyond seams filled
  Pair r_, shadow_, p_, v_, t_;
  FloatPair y_, w_;  // preconditioned p and r
};

}  // namespace granvof::linear
