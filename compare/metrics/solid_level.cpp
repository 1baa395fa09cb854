#include "compare/metrics/solid_level.hpp"

namespace granvof::compare {

std::optional<double> solid_level(const std::vector<double>& f_s, const std::array<int, 3>& cells,
                                  double row_height, double level) {
  const auto nx = static_cast<std::size_t>(cells[0]);
  const auto ny = static_cast<std::size_t>(cells[1]);
  const auto nz = static_cast<std::size_t>(cells[2]);
  std::vector<double> row(ny, 0.0);
  for (std::size_t k = 0; k < nz; ++k)
    for (std::size_t j = 0; j < ny; ++j)
      for (std::size_t i = 0; i < nx; ++i)
        row[j] += f_s[(k * ny + j) * nx + i] / static_cast<double>(nx * nz);
  for (std::size_t j = ny; j-- > 0;) {
    if (row[j] < level) continue;
    if (j + 1 == ny) return static_cast<double>(ny) * row_height;
    const double share = (row[j] - level) / (row[j] - row[j + 1]);
    return (static_cast<double>(j) + 0.5 + share) * row_height;
  }
  return std::nullopt;
}

}  // namespace granvof::compare
