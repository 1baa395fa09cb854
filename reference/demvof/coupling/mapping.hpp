// Bilinear mapping between beads and cells: the one mapping for void fraction, drag, gathering and metrics.
//
// A bead shares itself among the cell centres around it (4 in two dimensions, 8 in three). Weights that would
// fall outside the tank, or across a closed gate, go to the cell on the bead's own side, those of cells that
// obstacles fill to the others in proportion, which at a plane wall is the same: so their sum is 1
// everywhere, what is deposited is what the bead has, and gather is the transpose of deposit.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "reference/demvof/beads/bead_settings.hpp"

namespace demvof {

class Mapping {
 public:
  // Cells fill the tank; cells[2] = 1 means that the depth is not resolved.
  // `obstacles`: 1 in the cells that they fill; empty where there are none.
  Mapping(std::array<int, 3> cells, const Vector& spacing, std::vector<char> obstacles = {});

  // The gate stands on the faces x = face * spacing[0] and closes the share closed[j] of the face in row j:
  // that share of what would be mapped across stays on the bead's side. Shares, because a jump would be a
  // source of volume. An empty vector removes it.
  void set_gate(int face, std::vector<double> closed);

  // Weights of all beads at these positions (three numbers a bead). Throws std::runtime_error where one is
  // inside an obstacle.
  void update(const std::vector<double>& position);

  // Sum over beads of weight * value [value's unit], added to `cells`. `values[stride * bead + offset]`.
  void deposit(const std::vector<double>& values, int stride, int offset, std::vector<double>& cells) const;
  void deposit(double value, std::vector<double>& cells) const;
  // values[stride * bead + offset] = sum over cells of weight * cell.
  void gather(const std::vector<double>& cells, int stride, int offset, std::vector<double>& values) const;

  std::size_t cell_count() const { return cell_count_; }
  double cell_volume() const { return spacing_[0] * spacing_[1] * spacing_[2]; }

 private:
  std::array<int, 3> cells_{};
  Vector spacing_{};
  std::vector<char> obstacles_;
  std::size_t cell_count_ = 0;
  std::size_t beads_ = 0;
  int corners_ = 4;
  int gate_face_ = -1;
  std::vector<double> closed_;
  std::vector<std::int32_t> index_;  // corners_ cells a bead
  std::vector<double> weight_;

  void keep_out_of_obstacles(std::size_t bead, const double* position);
};

}  // namespace demvof
