// The friction system of a thin bed in two dimensions, factorised.
//
// A raft or a spread deposit is many cells long and a few thick, with free surfaces: it bends almost without
// strain, and the preconditioner of single components, which takes bending for shear, needs 100 to 200
// iterations where the whole matrix, numbered along the bed, is a band of twice the thickness.
#pragma once

#include <array>
#include <vector>

#include "solver/linear/conjugate_gradient.hpp"
#include "solver/linear/envelope_cholesky.hpp"
#include "solver/operators/box_of_grains.hpp"

namespace granvof {

// The symmetric form sum over cells and edges of 2 mu (du_d/dx_d)^2 + lambda (div u)^2 + mu_edge shear^2 and
// mass u^2 that friction_operator.cpp is the gradient of; arrays of the grid's layout.
struct FrictionForm {
  std::array<const double*, 2> mu;      // of a normal strain along either direction [Pa s]
  const double *lambda, *edge;          // [Pa s]
  const double* tilting;                // see Friction::tilting; nullptr for 1
  std::array<const double*, 2> marked;  // not 0 on the unknown faces
  std::array<const double*, 2> mass;    // [kg/m3 s]
};

class FrictionDirect {
 public:
  // Mean square of the row lengths up to which a factorisation is cheaper than the 15 to 25 iterations of a
  // bed that is not thin; beds of some 20 cells.
  static constexpr double longest_rows = 45.0 * 45.0;

  explicit FrictionDirect(const Grid& grid) : grid_(grid) {}

  // Numbers the unknown faces of the box and factorises, if that pays; false if not (thick beds, seams,
  // three dimensions).
  bool factorise(const Range& box, const FrictionForm& form);
  // z = A^-1 r on the unknown faces, 0 on the others of the box.
  void apply(const linear::ConstComponents& r, const linear::Components& z);

 private:
  // Linear in the velocities of a few faces, with the weight of its square.
  struct Strain {
    double weight = 0.0;
    int count = 0;
    std::array<int, 4> unknown{};
    std::array<double, 4> factor{};
  };

  void number(const Range& box, const FrictionForm& form);
  void add(Strain& strain, int d, std::ptrdiff_t c, double factor) const;
  template <typename Visit>
  void for_each_strain(const Range& box, const FrictionForm& form, Visit&& visit) const;
  // visit(d, c) for every face of the box, across its length first.
  template <typename Visit>
  void for_each_face(const Range& box, Visit&& visit) const;

  const Grid& grid_;
  Range box_{{0, 0, 0}, {0, 0, 0}};
  std::array<std::vector<int>, 2> number_;  // of a face, -1 where known
  std::vector<int> first_;                  // coupled face of every unknown
  std::vector<double> x_;
  linear::EnvelopeCholesky matrix_;
};

}  // namespace granvof
