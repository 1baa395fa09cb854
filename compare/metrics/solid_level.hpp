// Height of a front in a settling suspension or a deposit: where f_s passes a level.
#pragma once

#include <array>
#include <optional>
#include <vector>

namespace granvof::compare {

// Highest y at which f_s, averaged over each row of cells, falls to `level`, linear between the rows' centres
// [m]. f_s in C order (z, y, x). The top row above the level gives the top of the box; nothing if no row
// reaches it.
std::optional<double> solid_level(const std::vector<double>& f_s, const std::array<int, 3>& cells,
                                  double row_height, double level);

}  // namespace granvof::compare
