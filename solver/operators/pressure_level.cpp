#include "solver/operators/pressure_level.hpp"

#include <algorithm>

#include "solver/operators/mixture.hpp"
#include "solver/scene/gravity.hpp"

namespace granvof {

PressureLevel::PressureLevel(const Grid& grid, const Scene& scene) : grid_(grid), scene_(scene) {
  if (!may_be_parted() && grid.sealed()) add_part(0, grid.cells.n[vertical] - 1);
}

bool PressureLevel::may_be_parted() const {
  // every column has its own end at an open top
  if (grid_.has_whole_columns() && grid_.tank_side(vertical, true).passes_fluid) return false;
  return !grid_.obstacles.none() || scene_.gate.has_value();
}

void PressureLevel::add_part(int number, int row) {
  Lid lid{grid_.all_cells()};
  lid.row.lower[vertical] = row;
  lid.row.upper[vertical] = row + 1;
  lid.cells = sum_over(grid_.cells, lid.row, belongs_to(number));
  lids_.push_back(lid);
}

void PressureLevel::find_parts(const ContinuityTree& tree) {
  const Layout& l = grid_.cells;
  part_of_.assign(l.size, -1);
  std::vector<double> highest(static_cast<std::size_t>(tree.sealed_parts()), 0.0);
  for_each_place(grid_.all_cells(), [&](const std::array<int, 3>& at) {
    const std::ptrdiff_t c = l.index(at);
    const int part = tree.sealed_part_of(c);
    part_of_[static_cast<std::size_t>(c)] = part;
    if (part < 0) return;
    double& row = highest[static_cast<std::size_t>(part)];
    row = std::max(row, static_cast<double>(at[vertical]));
  });
  if (l.is_cut()) l.communicator->max(highest);
  lids_.clear();
  for (std::size_t part = 0; part < highest.size(); ++part)
    add_part(static_cast<int>(part), static_cast<int>(highest[part]));
}

void PressureLevel::set(const Field& alpha, Field& p_c) const {
  if (lids_.empty()) return;
  const double rho_l = scene_.liquid.density, rho_g = scene_.gas.density;
  const double half = 0.5 * normal_gravity(scene_) * grid_.h[vertical];
  const double* a = alpha.data();
  double* p = p_c.data();
  std::vector<double> means;
  for (const Lid& lid : lids_) {
    const auto counts = belongs_to(static_cast<int>(means.size()));
    means.push_back(sum_over(grid_.cells, lid.row,
                             [=](std::ptrdiff_t c) {
                               return counts(c) != 0.0 ? p[c] - half * mixture(a[c], rho_l, rho_g) : 0.0;
                             }) /
                    lid.cells);
  }
  if (part_of_.empty()) {
    for_each(grid_.cells, [=, mean = means.front()](std::ptrdiff_t c) { p[c] -= mean; });
    return;
  }
  const int* of = part_of_.data();
  const double* mean = means.data();
  for_each(grid_.cells, [=](std::ptrdiff_t c) { p[c] -= of[c] < 0 ? 0.0 : mean[of[c]]; });
}

}  // namespace granvof
