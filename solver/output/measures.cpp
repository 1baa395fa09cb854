#include "solver/output/measures.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "solver/output/fields_file.hpp"

namespace granvof {

namespace {

void check_finite(const std::vector<double>& values, const char* name, const CellFields& fields) {
  const auto bad = std::find_if(values.begin(), values.end(), [](double v) { return !std::isfinite(v); });
  if (bad == values.end()) return;
  const auto index = static_cast<std::size_t>(bad - values.begin());
  const auto nx = static_cast<std::size_t>(fields.cells[0]);
  const auto ny = static_cast<std::size_t>(fields.cells[1]);
  throw std::domain_error(fmt::format("{} is {} in cell ({}, {}, {}) at t = {} s", name, *bad, index % nx,
                                      index / nx % ny, index / (nx * ny), fields.time));
}

}  // namespace

void check_fields(const CellFields& fields, const Scene& scene) {
  check_sizes(fields);
  for (std::size_t d = 0; d < static_cast<std::size_t>(scene.dimensions); ++d) {
    const double length = fields.cells[d] * fields.spacing[d];
    if (std::abs(length - scene.tank[d]) > 1e-6 * scene.tank[d]) {
      throw std::invalid_argument(fmt::format("the fields are {} m long in direction {}, the tank is {} m",
                                              length, d, scene.tank[d]));
    }
  }
  check_finite(fields.f_s, "f_s", fields);
  check_finite(fields.alpha, "alpha", fields);
  check_finite(fields.p_c, "p_c", fields);
  check_finite(fields.p_s, "p_s", fields);
  check_finite(fields.theta, "theta", fields);
  check_finite(fields.phi, "phi", fields);
  for (const auto& component : fields.u_s) check_finite(component, "u_s", fields);
  for (const auto& component : fields.u_c) check_finite(component, "u_c", fields);
}

double dense_threshold(const Scene& scene) {
  return 0.95 * scene.contact.solid_fraction_min;
}

double present_threshold(const Scene& scene) {
  return 0.1 * scene.contact.solid_fraction_min;
}

std::vector<bool> obstacle_cells(const CellFields& fields, const Scene& scene) {
  if (scene.obstacles.empty()) return {};
  const auto& n = fields.cells;
  std::vector<bool> solid(static_cast<std::size_t>(n[0]) * n[1] * n[2], false);
  const auto inside = [&](const Box& box, const std::array<int, 3>& at) {
    for (std::size_t d = 0; d < static_cast<std::size_t>(scene.dimensions); ++d) {
      const double centre = (at[d] + 0.5) * fields.spacing[d];
      if (centre < box.lower[d] || centre > box.upper[d]) return false;
    }
    return true;
  };
  for (int k = 0; k < fields.cells[2]; ++k)
    for (int j = 0; j < fields.cells[1]; ++j)
      for (int i = 0; i < fields.cells[0]; ++i)
        for (const Box& box : scene.obstacles)
          if (inside(box, {i, j, k})) solid[cell_index(fields, i, j, k)] = true;
  return solid;
}

double cell_volume(const CellFields& fields, const Scene& scene) {
  const double thickness = scene.dimensions == 2 ? scene.tank[2] / fields.cells[2] : fields.spacing[2];
  return fields.spacing[0] * fields.spacing[1] * thickness;
}

std::vector<double> solid_volume_along_x(const CellFields& fields, const Scene& scene) {
  const auto [nx, ny, nz] = fields.cells;
  std::vector<double> volume(static_cast<std::size_t>(nx), 0.0);
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      const double* row = &fields.f_s[cell_index(fields, 0, j, k)];
      for (std::size_t i = 0; i < volume.size(); ++i) volume[i] += row[i];
    }
  }
  const double cell = cell_volume(fields, scene);
  for (double& v : volume) v *= cell;
  return volume;
}

std::vector<double> bed_height_profile(const CellFields& fields, const Scene& scene) {
  auto height = solid_volume_along_x(fields, scene);
  const double base = cell_volume(fields, scene) / fields.spacing[1] * fields.cells[2];
  for (double& h : height) h /= base * scene.contact.solid_fraction_min;
  return height;
}

std::vector<double> share_under_bed(const CellFields& fields, const Scene& scene, int direction) {
  const auto d = static_cast<std::size_t>(direction);
  const auto n = static_cast<std::size_t>(fields.cells[d]);
  const bool all_under = d == 2 && scene.dimensions == 2 && scene.bed;
  std::vector<double> share(n, all_under ? 1.0 : 0.0);
  if (all_under || !scene.bed) return share;
  const double h = fields.spacing[d];
  for (std::size_t c = 0; c < n; ++c) {
    const double lower = std::max(static_cast<double>(c) * h, scene.bed->box.lower[d]);
    const double upper = std::min(static_cast<double>(c + 1) * h, scene.bed->box.upper[d]);
    // The bound keeps a share of rounding error, where the bed ends on a cell face, from counting as a
    // column.
    if (upper - lower > 1e-9 * h) share[c] = (upper - lower) / h;
  }
  return share;
}

std::vector<double> bed_profile_along_y(const CellFields& fields, const Scene& scene) {
  if (!scene.bed) return {};
  const auto [nx, ny, nz] = fields.cells;
  const auto share_x = share_under_bed(fields, scene, 0);
  const auto share_z = share_under_bed(fields, scene, 2);
  std::vector<double> profile(static_cast<std::size_t>(ny), 0.0);
  double weight = 0.0;
  for (const double z : share_z) {
    for (const double x : share_x) weight += x * z;
  }
  if (weight == 0.0) return {};
  const std::vector<bool> solid = obstacle_cells(fields, scene);
  for (int j = 0; j < ny && !solid.empty(); ++j) {  // over what obstacles leave of the row
    double open = 0.0, sum = 0.0;
    for (int k = 0; k < nz; ++k) {
      for (int i = 0; i < nx; ++i) {
        const std::size_t c = cell_index(fields, i, j, k);
        if (solid[c]) continue;
        const double share = share_x[static_cast<std::size_t>(i)] * share_z[static_cast<std::size_t>(k)];
        open += share;
        sum += share * fields.f_s[c];
      }
    }
    profile[static_cast<std::size_t>(j)] = open > 0.0 ? sum / open : 0.0;
  }
  if (!solid.empty()) return profile;
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        profile[static_cast<std::size_t>(j)] += share_x[static_cast<std::size_t>(i)] *
                                                share_z[static_cast<std::size_t>(k)] *
                                                fields.f_s[cell_index(fields, i, j, k)];
      }
    }
  }
  for (double& f : profile) f /= weight;
  return profile;
}

Value last_crossing(const std::vector<double>& values, double spacing, double threshold) {
  for (std::size_t c = values.size(); c-- > 0;) {
    if (values[c] < threshold) continue;
    const double centre = (static_cast<double>(c) + 0.5) * spacing;
    if (c + 1 == values.size()) return static_cast<double>(values.size()) * spacing;
    return centre + spacing * (values[c] - threshold) / (values[c] - values[c + 1]);
  }
  return std::nullopt;
}

}  // namespace granvof
