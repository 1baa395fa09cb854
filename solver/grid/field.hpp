// Values on a grid: one number a cell, or one number a face and direction.
#pragma once

#include <array>
#include <span>

#include "solver/grid/grid.hpp"
#include "solver/grid/memory.hpp"

namespace granvof {

class Field {
 public:
  Field() = default;
  explicit Field(const Grid& grid, double value = 0.0) : values_(grid.cells.size, value) {}

  double* data() { return values_.data(); }
  const double* data() const { return values_.data(); }
  double& operator[](std::ptrdiff_t index) { return values_[static_cast<std::size_t>(index)]; }
  double operator[](std::ptrdiff_t index) const { return values_[static_cast<std::size_t>(index)]; }
  std::span<double> span() { return values_; }
  std::span<const double> span() const { return values_; }
  bool empty() const { return values_.empty(); }
  void fill(double value) { values_.assign(values_.size(), value); }

 private:
  Buffer<double> values_;
};

// One field a computed direction; entries beyond the grid's dimensions stay empty.
class FaceField {
 public:
  FaceField() = default;
  explicit FaceField(const Grid& grid, double value = 0.0) {
    for (int d = 0; d < grid.dim; ++d) component_[d] = Field(grid, value);
  }
  Field& operator[](int d) { return component_[d]; }
  const Field& operator[](int d) const { return component_[d]; }

 private:
  std::array<Field, 3> component_;
};

}  // namespace granvof
