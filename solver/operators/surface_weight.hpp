// What the weight of liquid and gas on a face has beside that of their mean density, because the surface
// between them lies somewhere in the cells and not on the face.
// Equations: docs/theory/balances.md.
#pragma once

#include <vector>

#include "solver/grid/boundary.hpp"

namespace granvof {

// A fluid at rest has P_c = rho_c g.(x - x_s) + constant, x_s a point of its surface. Between the cells a and
// b of a face that is a step of mean(rho_c) g.(x_b - x_a) + (rho_b - rho_a) g.(x - x_s), x the middle of the
// face. The first is what gravity does to the inertia of the face (mixture.hpp); the second is here. With
// both a plane surface across g is at rest however it lies in the cells; the first alone has a curl, which
// stirs. Source: gravity reduced to the interface, as S. Popinet has it in Basilisk; by columns our own.
//
// x_s is the height of the liquid in the column of cells along the axis that g is nearest to, of both columns
// the mean. A column that does not go from one fluid to the other within five cells has none, nor one that
// ends at a side that the fluid passes, where the pressure is given.
class SurfaceWeight {
 public:
  SurfaceWeight(const Grid& grid, const Scene& scene, const Boundary& boundary);

  // From alpha [-] with two ghost layers. All processes at once.
  void update(const Field& alpha);

  struct Entry {
    std::ptrdiff_t face;
    double force;  // along the face's axis, per volume of fluid [N/m3]
  };
  // Faces of direction d that have any, each once.
  const std::vector<Entry>& operator[](int d) const { return entries_[d]; }

 private:
  void find_heights(const double* alpha);
  void add(const double* alpha, int d);
  double height_in_window(const double* alpha, std::ptrdiff_t c, int row) const;
  double height_near(std::ptrdiff_t c) const;
  // What ends a column there.
  enum class End { none, wall, passing };
  End end_at(std::ptrdiff_t c, int row) const;

  const Grid& grid_;
  const Boundary& boundary_;
  int axis_ = vertical;                // of the columns
  double gravity_ = 0.0;               // along it [m/s2]
  double difference_ = 0.0;            // rho_l - rho_g [kg/m3]
  double below_a_floor_ = 1.0;         // alpha of what a floor is taken for, a lid for the other fluid
  std::array<End, 2> ends_{};          // of all columns, below and above
  Field height_;                       // of the surface over the middle of a cell [cells]; not a number: none
  std::vector<std::ptrdiff_t> found_;  // cells that have any
  std::array<std::vector<Entry>, 3> entries_;
};

}  // namespace granvof
