#include "solver/operators/surface_weight.hpp"

#include <cmath>
#include <limits>

#include "solver/scene/gravity.hpp"

namespace granvof {
namespace {

// Of a cell that holds one fluid, what may be of the other: compressive fluxes leave as much beside a
// surface.
constexpr double trace = 0.01;
// Steps of alpha whose weight is far below what a pressure is solved to.
constexpr double least_step = 1e-9;
constexpr int reach = 2;  // cells to either side; as many as there are ghosts
constexpr double none = std::numeric_limits<double>::quiet_NaN();

}  // namespace

SurfaceWeight::SurfaceWeight(const Grid& grid, const Scene& scene, const Boundary& boundary)
    : grid_(grid), boundary_(boundary), difference_(scene.liquid.density - scene.gas.density) {
  const Vec3 g = confined_gravity(scene);
  for (int d = 0; d < grid.dim; ++d)
    if (std::fabs(g[d]) > std::fabs(g[axis_])) axis_ = d;
  gravity_ = g[axis_];
  if (gravity_ == 0.0 || difference_ == 0.0) return;
  below_a_floor_ = gravity_ * difference_ < 0.0 ? 1.0 : 0.0;
  for (const bool upper : {false, true}) {
    const SideRule& side = grid.tank_side(axis_, upper);
    if (grid.has_side(axis_, upper) && !side.joined)
      ends_[upper ? 1 : 0] = side.is_open() ? End::passing : End::wall;
  }
  height_ = Field(grid);
  height_.fill(none);
}

void SurfaceWeight::update(const Field& alpha) {
  if (height_.empty()) return;
  for (auto& entries : entries_) entries.clear();
  find_heights(alpha.data());
  for (int d = 0; d < grid_.dim; ++d) add(alpha.data(), d);
}

void SurfaceWeight::find_heights(const double* alpha) {
  for (const std::ptrdiff_t c : found_) height_[c] = none;
  found_.clear();
  const std::ptrdiff_t s = grid_.stride(axis_);
  for_each_place(grid_.all_cells(), [&](const std::array<int, 3>& at) {
    const std::ptrdiff_t c = grid_.cells.index(at);
    const bool cut = alpha[c] > trace && alpha[c] < 1.0 - trace;
    if (!cut && std::fabs(alpha[c] - alpha[c - s]) < 1.0 - 2.0 * trace) return;
    height_[c] = height_in_window(alpha, c, at[axis_]);
    found_.push_back(c);
  });
  boundary_.exchange(height_);
}

void SurfaceWeight::add(const double* alpha, int d) {
  const std::ptrdiff_t s = grid_.stride(d);
  const double of_height = -difference_ * gravity_ * grid_.h[axis_] / grid_.h[d];
  for_each_place(grid_.inner_faces(d), [&](const std::array<int, 3>& at) {
    const std::ptrdiff_t c = grid_.cells.index(at);
    const double step = alpha[c] - alpha[c - s];
    if (std::fabs(step) < least_step) return;
    const double here = height_near(c);
    // over the face: along the column half a cell below the middle of c
    const double height = d == axis_ ? here + 0.5 : 0.5 * (here + height_near(c - s));
    if (height == height) entries_[d].push_back({c, of_height * step * height});
  });
}

double SurfaceWeight::height_in_window(const double* alpha, std::ptrdiff_t c, int row) const {
  double sum = alpha[c];
  // The last cell on one side. A wall is taken for what lies before it at rest.
  const auto last = [&](int towards, double beyond) {
    double at_end = alpha[c];
    bool walled = false;
    for (int r = 1; r <= reach; ++r) {
      const std::ptrdiff_t cell = c + r * towards * grid_.stride(axis_);
      const End end = walled ? End::wall : end_at(cell, row + r * towards);
      if (end == End::passing) return none;
      walled = end == End::wall;
      sum += at_end = walled ? beyond : alpha[cell];
    }
    return at_end;
  };
  const double low = last(-1, below_a_floor_), high = last(1, 1.0 - below_a_floor_);
  if (!(std::fabs(low - high) >= 1.0 - trace)) return none;
  return (low > high ? sum : 2 * reach + 1 - sum) - reach - 0.5;
}

double SurfaceWeight::height_near(std::ptrdiff_t c) const {
  for (const int r : {0, -1, 1, -2, 2}) {
    const double height = height_[c + r * grid_.stride(axis_)];
    if (height == height) return height + r;
  }
  return none;
}

SurfaceWeight::End SurfaceWeight::end_at(std::ptrdiff_t c, int row) const {
  if (row < 0 && ends_[0] != End::none) return ends_[0];
  if (row >= grid_.cells.n[axis_] && ends_[1] != End::none) return ends_[1];
  const char* solid = grid_.obstacles.solid();
  return solid != nullptr && solid[c] != 0 ? End::wall : End::none;
}

}  // namespace granvof
