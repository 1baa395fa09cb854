#include "solver/scene/fill.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace granvof {
namespace {

double overlap(double lower_a, double upper_a, double lower_b, double upper_b) {
  return std::max(0.0, std::min(upper_a, upper_b) - std::max(lower_a, lower_b));
}

Box common(const Box& a, const Box& b) {
  Box both;
  for (int axis = 0; axis < 3; ++axis) {
    both.lower[axis] = std::max(a.lower[axis], b.lower[axis]);
    both.upper[axis] = std::min(a.upper[axis], b.upper[axis]);
  }
  return both;
}

// Area under the bed's front face within x in [lower, upper], between the heights `from` and `to`.
double area_below_face(const Bed& bed, double lower, double upper, double from, double to) {
  const double rise = std::tan(bed.slope * std::numbers::pi / 180.0);
  const auto height = [&](double x) { return bed.box.lower[1] + (bed.box.upper[0] - x) * rise; };
  const auto where = [&](double y) { return bed.box.upper[0] - (y - bed.box.lower[1]) / rise; };
  const double full = std::clamp(where(to), lower, upper);    // left of it the face is above `to`
  const double empty = std::clamp(where(from), full, upper);  // right of it the face is below `from`
  const double mean = 0.5 * (std::min(height(full), to) + std::max(height(empty), from)) - from;
  return (full - lower) * (to - from) + (empty - full) * std::max(mean, 0.0);
}

// Share of [lower, upper] that lies in bands 0, 2, 4, ... of `size`, counted from 0.
double share_of_even_bands(double lower, double upper, double size) {
  const auto covered = [=](double x) {
    const double pairs = std::floor(x / (2.0 * size));
    return pairs * size + std::min(x - 2.0 * size * pairs, size);
  };
  return (covered(upper) - covered(lower)) / (upper - lower);
}

// Share of a union of boxes, from that of each alone: what two cover counts once.
template <typename Share>
double of_union(std::span<const Box> boxes, const Share& share) {
  if (boxes.empty()) return 0.0;
  const Box& first = boxes.front();
  const auto rest = boxes.subspan(1);
  std::vector<Box> shared;  // what the rest covers of the first
  shared.reserve(rest.size());
  for (const Box& other : rest) shared.push_back(common(first, other));
  return share(first) + of_union(rest, share) - of_union(std::span<const Box>(shared), share);
}

}  // namespace

double share_of(const Box& box, const Box& cell) {
  double share = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    share *= overlap(box.lower[axis], box.upper[axis], cell.lower[axis], cell.upper[axis]) /
             (cell.upper[axis] - cell.lower[axis]);
  }
  return std::min(share, 1.0);
}

double share_of(const Bed& bed, const Box& cell) {
  if (bed.slope == 90.0) return share_of(bed.box, cell);
  const Box both = common(bed.box, cell);
  for (int axis = 0; axis < 3; ++axis) {
    if (both.upper[axis] <= both.lower[axis]) return 0.0;
  }
  const double area = area_below_face(bed, both.lower[0], both.upper[0], both.lower[1], both.upper[1]);
  const double cell_area = (cell.upper[0] - cell.lower[0]) * (cell.upper[1] - cell.lower[1]);
  const double across = (both.upper[2] - both.lower[2]) / (cell.upper[2] - cell.lower[2]);
  return std::min(area / cell_area * across, 1.0);
}

double colour_of(const Bed& bed, const Box& cell) {
  const Box both = common(bed.box, cell);
  for (int axis = 0; axis < 3; ++axis)
    if (both.upper[axis] <= both.lower[axis]) return 0.0;
  if (bed.colour == ColourPattern::uniform) return 1.0;
  const auto bands = [&](int axis) {
    return share_of_even_bands(both.lower[axis] - bed.box.lower[axis], both.upper[axis] - bed.box.lower[axis],
                               bed.colour_size);
  };
  double colour = bed.colour == ColourPattern::columns ? bands(0) : bands(1);
  if (bed.colour == ColourPattern::checks) {
    const double across = bands(0);
    colour = colour * across + (1.0 - colour) * (1.0 - across);
  }
  return std::clamp(colour, 0.0, 1.0);
}

double share_of(std::span<const Box> boxes, const Box& cell) {
  return of_union(boxes, [&](const Box& box) { return share_of(box, cell); });
}

double shared_by(const Bed& bed, std::span<const Box> boxes, const Box& cell) {
  return of_union(boxes, [&](const Box& box) {
    const double share = share_of(box, cell);
    return share > 0.0 ? share * share_of(bed, common(box, cell)) : 0.0;
  });
}

}  // namespace granvof
