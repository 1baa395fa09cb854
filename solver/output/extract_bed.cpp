#include "solver/output/extract_bed.hpp"

#include <algorithm>

#include "solver/output/measures.hpp"

namespace granvof::scalar {

namespace {

// Mean height of the solid in cells with f_s > threshold, weighted by f_s.
Value centre_height(const CellFields& fields, double threshold) {
  double weight = 0.0;
  double moment = 0.0;
  for (int k = 0; k < fields.cells[2]; ++k) {
    for (int j = 0; j < fields.cells[1]; ++j) {
      const double y = (j + 0.5) * fields.spacing[1];
      for (int i = 0; i < fields.cells[0]; ++i) {
        const double f = fields.f_s[cell_index(fields, i, j, k)];
        if (f <= threshold) continue;
        weight += f;
        moment += f * y;
      }
    }
  }
  if (weight == 0.0) return std::nullopt;
  return moment / weight;
}

// Upper edge of the dense bed in a profile of f_s, in rows: the last dense row and the one above it are full
// up to their share between what lies above them (a suspension, or nothing) and the packing below. Exact for
// a sharp edge anywhere in a cell, at any packing, and continuous as rows become dense.
Value upper_edge(const std::vector<double>& profile, double threshold) {
  const auto dense = std::find_if(profile.rbegin(), profile.rend(), [&](double f) { return f >= threshold; });
  if (dense == profile.rend()) return std::nullopt;
  const auto last = static_cast<std::size_t>(profile.rend() - dense) - 1;
  const auto at = [&](std::size_t row) { return row < profile.size() ? profile[row] : 0.0; };
  if (last + 1 == profile.size()) return static_cast<double>(profile.size());
  const double above = at(last + 2);
  const double packing = last > 0 ? std::max(profile[last], profile[last - 1]) : profile[last];
  const auto full = [&](double f) { return std::clamp((f - above) / (packing - above), 0.0, 1.0); };
  return static_cast<double>(last) + full(at(last)) + full(at(last + 1));
}

// P_c in the lowest cell of every column that no obstacle fills; and 1, or 0 where there is none.
struct Base {
  std::vector<double> pressure, open;
};
Base base_of_columns(const CellFields& fields, const Scene& scene) {
  Base base;
  const std::vector<bool> solid = obstacle_cells(fields, scene);
  for (int k = 0; k < fields.cells[2]; ++k) {
    for (int i = 0; i < fields.cells[0]; ++i) {
      int j = 0;
      while (!solid.empty() && j < fields.cells[1] && solid[cell_index(fields, i, j, k)]) ++j;
      const bool open = j < fields.cells[1];
      base.open.push_back(open ? 1.0 : 0.0);
      base.pressure.push_back(open ? fields.p_c[cell_index(fields, i, j, k)] : 0.0);
    }
  }
  return base;
}

}  // namespace

Value p_base(const CellFields& fields, const Scene& scene) {
  if (!scene.bed) return std::nullopt;
  const auto share_x = share_under_bed(fields, scene, 0);
  const auto share_z = share_under_bed(fields, scene, 2);
  double weight = 0.0;
  double sum = 0.0;
  const Base base = base_of_columns(fields, scene);
  std::size_t column = 0;
  for (const double z : share_z) {
    for (const double x : share_x) {
      const double share = x * z * base.open[column];
      weight += share;
      sum += share * base.pressure[column++];
    }
  }
  if (weight == 0.0) return std::nullopt;
  return sum / weight;
}

Value base_height(const CellFields& grid, const Scene& scene) {
  CellFields heights;
  heights.cells = grid.cells;
  heights.spacing = grid.spacing;
  for (int k = 0; k < grid.cells[2]; ++k)
    for (int j = 0; j < grid.cells[1]; ++j)
      heights.p_c.insert(heights.p_c.end(), static_cast<std::size_t>(grid.cells[0]),
                         (j + 0.5) * grid.spacing[1]);
  return p_base(heights, scene);  // the mean of the heights of the same cells
}

Value y_c(const CellFields& fields, const Scene& scene) {
  return centre_height(fields, dense_threshold(scene));
}

Value bed_bottom(const CellFields& fields, const Scene& scene) {
  auto profile = bed_profile_along_y(fields, scene);
  std::reverse(profile.begin(), profile.end());
  const auto depth = upper_edge(profile, dense_threshold(scene));
  if (!depth) return std::nullopt;
  return (fields.cells[1] - *depth) * fields.spacing[1];
}

Value bed_top(const CellFields& fields, const Scene& scene) {
  const auto rows = upper_edge(bed_profile_along_y(fields, scene), dense_threshold(scene));
  if (!rows) return std::nullopt;
  return *rows * fields.spacing[1];
}

Value bed_height(const CellFields& fields, const Scene& scene) {
  const auto bottom = bed_bottom(fields, scene);
  const auto top = bed_top(fields, scene);
  if (!bottom || !top) return std::nullopt;
  return *top - *bottom;
}

Value bed_height_equivalent(const CellFields& fields, const Scene& scene) {
  double all = 0.0;
  double dense = 0.0;
  double rows = 0.0;
  for (const double f : bed_profile_along_y(fields, scene)) {
    all += f;
    if (f < dense_threshold(scene)) continue;
    dense += f;
    rows += 1.0;
  }
  if (rows == 0.0) return std::nullopt;
  return all / (dense / rows) * fields.spacing[1];
}

Value y_solid_mean(const CellFields& fields, const Scene&) {
  return centre_height(fields, 0.0);
}

Value solid_volume(const CellFields& fields, const Scene& scene) {
  double sum = 0.0;
  for (const double f : fields.f_s) sum += f;
  return sum * cell_volume(fields, scene);
}

Value f_s_max(const CellFields& fields, const Scene&) {
  return *std::max_element(fields.f_s.begin(), fields.f_s.end());
}

Value f_s_min(const CellFields& fields, const Scene&) {
  return *std::min_element(fields.f_s.begin(), fields.f_s.end());
}

Value theta_max(const CellFields& fields, const Scene& scene) {
  Value largest;
  for (std::size_t c = 0; c < fields.f_s.size(); ++c) {
    if (fields.f_s[c] < present_threshold(scene)) continue;
    largest = std::max(largest.value_or(fields.theta[c]), fields.theta[c]);
  }
  return largest;
}

}  // namespace granvof::scalar
