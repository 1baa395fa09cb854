// Scenes and fields whose scalars are known by hand.
#pragma once

#include <array>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "solver/output/cell_fields.hpp"
#include "solver/output/measures.hpp"
#include "solver/scene/scene.hpp"
#include "solver/tests/temporary_directory.hpp"

namespace granvof::test {

inline Scene make_scene(int dimensions, std::array<int, 3> cells, Vec3 tank) {
  Scene scene;
  scene.name = "sample";
  scene.title = "A \"sample\" <scene>";
  scene.hash = "0123456789abcdef";
  scene.resolved = "name = \"sample\"\n";
  scene.dimensions = dimensions;
  scene.tank = tank;
  scene.gravity = 10.0;
  scene.grid.cells = cells;
  for (std::size_t d = 0; d < 3; ++d) scene.grid.spacing[d] = tank[d] / cells[d];
  scene.gas = {1.0, 1e-5};
  scene.liquid = {1000.0, 1e-3};
  scene.solid.density = 2500.0;
  return scene;
}

// 8 x 5 cells of 0.05 x 0.02 m, 0.1 m deep.
inline Scene small_scene() {
  return make_scene(2, {8, 5, 1}, {0.4, 0.1, 0.1});
}

// 4 x 3 x 2 cells of 0.1 m.
inline Scene small_scene_3d() {
  return make_scene(3, {4, 3, 2}, {0.4, 0.3, 0.2});
}

inline Bed bed_of(Vec3 lower, Vec3 upper) {
  Bed bed;
  bed.box = {lower, upper};
  bed.solid_fraction = 0.57;
  return bed;
}

// Gas at rest everywhere, no solid.
inline CellFields empty_fields(const Scene& scene) {
  CellFields fields;
  fields.cells = scene.grid.cells;
  fields.spacing = scene.grid.spacing;
  const auto n = static_cast<std::size_t>(fields.cells[0]) * static_cast<std::size_t>(fields.cells[1]) *
                 static_cast<std::size_t>(fields.cells[2]);
  const std::vector<double> zero(n, 0.0);
  fields.f_s = fields.alpha = fields.p_c = fields.theta = fields.phi = zero;
  fields.u_s = fields.u_c = {zero, zero, {}};
  if (scene.dimensions == 3) fields.u_s[2] = fields.u_c[2] = zero;
  return fields;
}

// Sets the cells [i0, i1) x [j0, j1) of all layers.
inline void fill(const CellFields& fields, std::vector<double>& values, std::array<int, 2> i,
                 std::array<int, 2> j, double value) {
  for (int k = 0; k < fields.cells[2]; ++k) {
    for (int row = j[0]; row < j[1]; ++row) {
      for (int c = i[0]; c < i[1]; ++c) values[cell_index(fields, c, row, k)] = value;
    }
  }
}

// A number in every cell of every field that no other cell or field has; exact in single precision.
inline CellFields numbered_fields(const Scene& scene, double time) {
  auto fields = empty_fields(scene);
  fields.time = time;
  double number = 1.0;
  const auto count_up = [&](std::vector<double>& values) {
    for (double& v : values) v = (number += 1.0) / 1024.0;
  };
  for (auto* values : {&fields.f_s, &fields.alpha, &fields.p_c, &fields.theta, &fields.phi})
    count_up(*values);
  for (auto& values : fields.u_s) count_up(values);
  for (auto& values : fields.u_c) count_up(values);
  return fields;
}

// While it lives, no file of this process can grow beyond `bytes`: a full disk, without root.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    previous_signal_ = std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &previous_);
    rlimit limit = previous_;
    limit.rlim_cur = bytes;
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;
  FullDisk(FullDisk&&) = delete;
  FullDisk& operator=(FullDisk&&) = delete;
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &previous_);
    std::signal(SIGXFSZ, previous_signal_);
  }

 private:
  rlimit previous_{};
  void (*previous_signal_)(int) = nullptr;
};

// The text of the exception of type E that `action` throws; fails the test if it throws none.
template <class E>
std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const E& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

}  // namespace granvof::test
