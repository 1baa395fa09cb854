// The fields of one instant at cell centres, as the output contract states them (docs/output.md).
//
// Both the continuum solver and the DEM-VOF reference fill this and hand it to the writers, so that every
// scalar of series.csv comes from one piece of code whichever program ran.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace granvof {

struct CellFields {
  double time = 0.0;                  // [s]
  std::array<int, 3> cells{1, 1, 1};  // nx, ny, nz
  std::array<double, 3> spacing{};    // [m]
  // All arrays are in C order (z, y, x): index = (k * ny + j) * nx + i; velocities hold one array a
  // component.
  std::vector<double> f_s;                 // solid fraction [-]
  std::vector<double> alpha;               // liquid share of the continuous phase [-]
  std::vector<double> p_c;                 // fluid pressure [Pa]
  std::vector<double> p_s;                 // solid pressure [Pa]; empty where a program has none
  std::vector<double> theta;               // granular temperature [m2/s2]
  std::vector<double> phi;                 // colour of the solid [-]
  std::array<std::vector<double>, 3> u_s;  // solid velocity [m/s]; component 2 empty in 2D
  std::array<std::vector<double>, 3> u_c;  // velocity of the continuous phase [m/s]

  std::size_t index(int i, int j, int k) const {
    return static_cast<std::size_t>((k * cells[1] + j) * cells[0] + i);
  }
};

// Throws std::invalid_argument naming the array whose size is not that of `fields.cells`.
// `p_s` may be empty everywhere, component 2 of the velocities where there is one layer of cells.
void check_sizes(const CellFields& fields);

}  // namespace granvof
