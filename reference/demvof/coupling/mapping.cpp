#include "reference/demvof/coupling/mapping.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace demvof {

namespace {

// The two cells around a position in one direction, and the weight of the second.
struct Pair {
  int first = 0, second = 0;
  double weight = 0.0;
};

Pair around(double position, double spacing, int cells) {
  const double s = position / spacing - 0.5;
  const double below = std::floor(s);
  const int first = static_cast<int>(below);
  return {std::clamp(first, 0, cells - 1), std::clamp(first + 1, 0, cells - 1), s - below};
}

}  // namespace

Mapping::Mapping(std::array<int, 3> cells, const Vector& spacing, std::vector<char> obstacles)
    : cells_(cells),
      spacing_(spacing),
      obstacles_(std::move(obstacles)),
      cell_count_(static_cast<std::size_t>(cells[0]) * static_cast<std::size_t>(cells[1]) *
                  static_cast<std::size_t>(cells[2])),
      corners_(cells[2] > 1 ? 8 : 4) {}

void Mapping::set_gate(int face, std::vector<double> closed) {
  gate_face_ = face;
  closed_ = std::move(closed);
}

void Mapping::update(const std::vector<double>& position) {
  beads_ = position.size() / 3;
  index_.resize(beads_ * static_cast<std::size_t>(corners_));
  weight_.resize(index_.size());
  const double gate_x = gate_face_ * spacing_[0];
  std::size_t out = 0;
  for (std::size_t bead = 0; bead < beads_; ++bead) {
    const double px = position[3 * bead];
    const Pair x = around(px, spacing_[0], cells_[0]);
    const Pair y = around(position[3 * bead + 1], spacing_[1], cells_[1]);
    const Pair z = around(position[3 * bead + 2], spacing_[2], cells_[2]);
    const bool astride = !closed_.empty() && x.first == gate_face_ - 1 && x.second == gate_face_;
    for (int corner = 0; corner < corners_; ++corner) {
      const bool right = (corner & 1) != 0, upper = (corner & 2) != 0, behind = (corner & 4) != 0;
      const int j = upper ? y.second : y.first;
      const int k = corners_ == 4 ? 0 : (behind ? z.second : z.first);
      // Weight of the right cell; across a gate less of it, or of the left one, by the closed share.
      double to_right = x.weight;
      if (astride) {
        const double closed = closed_[static_cast<std::size_t>(j)];
        to_right = px < gate_x ? to_right * (1.0 - closed) : 1.0 - (1.0 - to_right) * (1.0 - closed);
      }
      const int i = right ? x.second : x.first;
      double w = (right ? to_right : 1.0 - to_right) * (upper ? y.weight : 1.0 - y.weight);
      if (corners_ == 8) w *= behind ? z.weight : 1.0 - z.weight;
      index_[out] = (k * cells_[1] + j) * cells_[0] + i;
      weight_[out++] = w;
    }
    if (!obstacles_.empty()) keep_out_of_obstacles(bead, &position[3 * bead]);
  }
}

void Mapping::keep_out_of_obstacles(std::size_t bead, const double* position) {
  std::size_t own = 0, stride = 1;
  for (std::size_t d = 0; d < 3; ++d) {
    const int cell = cells_[d] == 1 ? 0 : static_cast<int>(std::floor(position[d] / spacing_[d]));
    own += stride * static_cast<std::size_t>(std::clamp(cell, 0, cells_[d] - 1));
    stride *= static_cast<std::size_t>(cells_[d]);
  }
  if (obstacles_[own] != 0)
    throw std::runtime_error(fmt::format("a bead is inside an obstacle, at ({:.6g}, {:.6g}, {:.6g}) m",
                                         position[0], position[1], position[2]));
  const auto corners = static_cast<std::size_t>(corners_), first = bead * corners;
  double open = 0.0;
  for (std::size_t n = first; n < first + corners; ++n) {
    if (obstacles_[static_cast<std::size_t>(index_[n])] != 0) weight_[n] = 0.0;
    open += weight_[n];
  }
  for (std::size_t n = first; n < first + corners; ++n) weight_[n] /= open;
}

void Mapping::deposit(const std::vector<double>& values, int stride, int offset,
                      std::vector<double>& cells) const {
  std::size_t in = 0;
  for (std::size_t bead = 0; bead < beads_; ++bead) {
    const double value = values[bead * static_cast<std::size_t>(stride) + static_cast<std::size_t>(offset)];
    for (int corner = 0; corner < corners_; ++corner, ++in) {
      cells[static_cast<std::size_t>(index_[in])] += weight_[in] * value;
    }
  }
}

void Mapping::deposit(double value, std::vector<double>& cells) const {
  for (std::size_t in = 0; in < index_.size(); ++in) {
    cells[static_cast<std::size_t>(index_[in])] += weight_[in] * value;
  }
}

void Mapping::gather(const std::vector<double>& cells, int stride, int offset,
                     std::vector<double>& values) const {
  std::size_t in = 0;
  for (std::size_t bead = 0; bead < beads_; ++bead) {
    double sum = 0.0;
    for (int corner = 0; corner < corners_; ++corner, ++in) {
      sum += weight_[in] * cells[static_cast<std::size_t>(index_[in])];
    }
    values[bead * static_cast<std::size_t>(stride) + static_cast<std::size_t>(offset)] = sum;
  }
}

}  // namespace demvof
