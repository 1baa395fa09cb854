#include "solver/run/memory_demand.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <fmt/format.h>
#include <sys/resource.h>

#include "solver/output/host_facts.hpp"
#include "solver/scene/case_error.hpp"

namespace granvof {
namespace {

// Largest resident size, by its growth from 3e4 to 1.2e5 cells of s1 and from 5e4 to 4e5 of dambreak-beads.
constexpr double bytes_per_cell_2d = 2000.0, bytes_per_cell_3d = 3000.0;
// What the lowest of several processes holds of the whole tank beside its slab: two states and what is made
// of them for output. By 1840 bytes a cell of two processes after a first output of sw at 1.9e5 cells, where
// there is one state of 128 bytes.
constexpr double whole_bytes_per_cell_2d = 400.0, whole_bytes_per_cell_3d = 500.0;
constexpr double bytes_of_program = 2e7;

double cells_of(const Scene& scene) {
  const auto& n = scene.grid.cells;
  return static_cast<double>(n[0]) * n[1] * n[2];
}

}  // namespace

double memory_demand(const Scene& scene, int processes) {
  const bool plane = scene.dimensions == 2;
  const double per_cell = (plane ? bytes_per_cell_2d : bytes_per_cell_3d) / processes;
  const double of_whole = processes == 1 ? 0.0 : plane ? whole_bytes_per_cell_2d : whole_bytes_per_cell_3d;
  return (per_cell + of_whole) * cells_of(scene) + bytes_of_program;
}

double memory_limit() {
  auto limit = static_cast<double>(host_facts().memory_bytes);
  rlimit own{};
  if (::getrlimit(RLIMIT_AS, &own) == 0 && own.rlim_cur != RLIM_INFINITY)
    limit = std::min(limit, static_cast<double>(own.rlim_cur));
  double group = 0.0;  // the file says "max" where there is no limit
  if (std::ifstream("/sys/fs/cgroup/memory.max") >> group) limit = std::min(limit, group);
  return limit;
}

void check_memory(const Scene& scene, int processes) {
  const double demand = memory_demand(scene, processes), limit = memory_limit();
  if (demand <= limit) return;
  const double coarser = std::pow(demand / limit, 1.0 / scene.dimensions);
  throw CaseError(fmt::format(
      "{}: grid.dx: got {:.9g}, allowed: what fits into memory; {:.0f} cells need {:.3g} GB and there "
      "are {:.3g} GB, enough for cells of about {:.2g} m",
      scene.file.string(), scene.grid.spacing[0], cells_of(scene), demand * 1e-9, limit * 1e-9,
      coarser * scene.grid.spacing[0]));
}

}  // namespace granvof
