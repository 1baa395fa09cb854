#include "compare/metrics/deposit_shape.hpp"

#include <algorithm>

namespace granvof::compare {
namespace {

// Length over which the piecewise linear profile is at least `level`; half a column is added at both ends of
// the tank, where the profile is taken as constant up to the wall.
double length_above(const BedProfile& profile, double level) {
  const std::size_t n = profile.x.size();
  double length = 0.0;
  for (std::size_t i = 1; i < n; ++i) {
    const double a = profile.height[i - 1];
    const double b = profile.height[i];
    const double dx = profile.x[i] - profile.x[i - 1];
    if (a >= level && b >= level) length += dx;
    if ((a >= level) != (b >= level)) length += dx * (std::max(a, b) - level) / std::abs(a - b);
  }
  const double half = n > 1 ? 0.5 * (profile.x[1] - profile.x[0]) : 0.0;
  if (profile.height.front() >= level) length += half;
  if (profile.height.back() >= level) length += half;
  return length;
}

}  // namespace

BedProfile bed_profile(const std::vector<double>& f_s, const std::array<int, 3>& cells,
                       const std::array<double, 3>& spacing, double packing) {
  const auto nx = static_cast<std::size_t>(cells[0]);
  const auto ny = static_cast<std::size_t>(cells[1]);
  const auto nz = static_cast<std::size_t>(cells[2]);
  BedProfile profile{std::vector<double>(nx), std::vector<double>(nx, 0.0)};
  const double share = spacing[1] / (packing * static_cast<double>(nz));
  for (std::size_t k = 0; k < nz; ++k)
    for (std::size_t j = 0; j < ny; ++j)
      for (std::size_t i = 0; i < nx; ++i) profile.height[i] += share * f_s[(k * ny + j) * nx + i];
  for (std::size_t i = 0; i < nx; ++i) profile.x[i] = (static_cast<double>(i) + 0.5) * spacing[0];
  return profile;
}

std::optional<DepositShape> deposit_shape(const BedProfile& profile) {
  if (profile.height.empty()) return std::nullopt;
  DepositShape shape;
  shape.peak = *std::max_element(profile.height.begin(), profile.height.end());
  if (shape.peak <= 0.0) return std::nullopt;
  shape.length = length_above(profile, 0.05 * shape.peak);
  if (shape.length <= 0.0) return std::nullopt;
  shape.flat_top = length_above(profile, 0.95 * shape.peak) / shape.length;
  return shape;
}

}  // namespace granvof::compare
