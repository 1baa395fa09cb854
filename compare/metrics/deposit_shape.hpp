// Shape of a deposit: trapezoid or triangle (paper, section 4.1: h0/l0 below or above 0.75).
#pragma once

#include <array>
#include <optional>
#include <vector>

namespace granvof::compare {

// Height of the bed along the tank: one value for each column of cells.
struct BedProfile {
  std::vector<double> x;       // centres of the columns [m]
  std::vector<double> height;  // [m]
};

// The solids of each column of cells, stacked at `packing` (f_s,min): insensitive to how many cells the
// surface is smeared over. f_s in C order (z, y, x), cells = nx, ny, nz, spacing in m. In 3D the mean across
// the tank.
BedProfile bed_profile(const std::vector<double>& f_s, const std::array<int, 3>& cells,
                       const std::array<double, 3>& spacing, double packing);

struct DepositShape {
  double peak = 0.0;      // greatest height [m]
  double length = 0.0;    // length of the part higher than 5 % of the peak [m]
  double flat_top = 0.0;  // share of `length` with a height of at least 95 % of the peak [-]
};

// A triangle has a flat top of 1/19 (0.05 / 0.95), a trapezoid whose top is a share r of its base
// (r + 0.05 (1 - r)) / (1 - 0.05 (1 - r)). Ends are interpolated between columns. Nothing for an empty bed.
std::optional<DepositShape> deposit_shape(const BedProfile& profile);

}  // namespace granvof::compare
