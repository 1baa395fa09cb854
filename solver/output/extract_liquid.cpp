#include "solver/output/extract_liquid.hpp"

#include <algorithm>
#include <vector>

#include "solver/output/measures.hpp"

namespace granvof::scalar {

namespace {

constexpr double interface_alpha = 0.5;

// Height of alpha = 0.5 in the columns for which use(i, k) holds.
template <class Use>
Value level(const CellFields& fields, const Scene& scene, Use use) {
  std::vector<double> share;
  const std::vector<bool> solid = obstacle_cells(fields, scene);
  for (int j = 0; j < fields.cells[1]; ++j) {
    double liquid = 0.0;
    double fluid = 0.0;
    for (int k = 0; k < fields.cells[2]; ++k) {
      for (int i = 0; i < fields.cells[0]; ++i) {
        if (!use(i, k)) continue;
        const auto c = cell_index(fields, i, j, k);
        if (!solid.empty() && solid[c]) continue;
        liquid += fields.alpha[c] * (1.0 - fields.f_s[c]);
        fluid += 1.0 - fields.f_s[c];
      }
    }
    if (fluid <= 0.0 && solid.empty()) return std::nullopt;
    // A row that obstacles fill divides nothing: it counts as the one below.
    share.push_back(fluid > 0.0 ? liquid / fluid : share.empty() ? 1.0 : share.back());
  }
  return last_crossing(share, fields.spacing[1], interface_alpha);
}

double column_height(const CellFields& fields, int i) {
  double sum = 0.0;
  for (int k = 0; k < fields.cells[2]; ++k) {
    for (int j = 0; j < fields.cells[1]; ++j) sum += fields.alpha[cell_index(fields, i, j, k)];
  }
  return sum * fields.spacing[1] / fields.cells[2];
}

}  // namespace

Value interface_height(const CellFields& fields, const Scene& scene) {
  return level(fields, scene, [](int, int) { return true; });
}

Value interface_height_outside(const CellFields& fields, const Scene& scene) {
  if (!scene.bed) return std::nullopt;
  const auto share_x = share_under_bed(fields, scene, 0);
  const auto share_z = share_under_bed(fields, scene, 2);
  return level(fields, scene, [&](int i, int k) {
    return share_x[static_cast<std::size_t>(i)] * share_z[static_cast<std::size_t>(k)] == 0.0;
  });
}

Value liquid_front(const CellFields& fields, const Scene&) {
  Value front;
  for (int k = 0; k < fields.cells[2]; ++k) {
    const auto begin = fields.alpha.begin() + static_cast<std::ptrdiff_t>(cell_index(fields, 0, 0, k));
    const std::vector<double> row(begin, begin + fields.cells[0]);
    const auto x = last_crossing(row, fields.spacing[0], interface_alpha);
    if (x) front = std::max(front.value_or(*x), *x);
  }
  return front;
}

Value liquid_height_left(const CellFields& fields, const Scene&) {
  return column_height(fields, 0);
}

Value liquid_height_right(const CellFields& fields, const Scene&) {
  return column_height(fields, fields.cells[0] - 1);
}

Value liquid_volume(const CellFields& fields, const Scene& scene) {
  double sum = 0.0;
  for (std::size_t c = 0; c < fields.alpha.size(); ++c) sum += fields.alpha[c] * (1.0 - fields.f_s[c]);
  return sum * cell_volume(fields, scene);
}

}  // namespace granvof::scalar
