#include "reference/demvof/program/scene_setup.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "reference/demvof/preparation/rough_floor.hpp"
#include "reference/demvof/program/obstacle_setup.hpp"
#include "solver/scene/case_error.hpp"
#include "solver/scene/printable.hpp"
#include "solver/scene/scales.hpp"
#include "solver/scene/side_kinds.hpp"

namespace demvof {

namespace {

using granvof::Scene;
using granvof::SideKind;
using granvof::WallKind;

constexpr double loosest_pile = 0.55;  // below it a bed cannot be at rest: it is suspended [-]
// In bead diameters; in a thinner slice a bead touches another and its image.
constexpr double thinnest_slice = 2.0;

constexpr double densest_pile = 0.66;  // spheres at random reach 0.64, a little more between walls [-]
// What LIGGGHTS takes of beads in SI units.
constexpr double stiffest = 1e9;            // [Pa]
constexpr double least_restitution = 0.05;  // [-]
constexpr double most_steps = 1e9;          // weeks for a thousand beads
// Their contacts alone would take more than 10 GB, and their steps years.
constexpr double most_beads = 1e7;
constexpr std::size_t longest_name = 1000;  // of a file, in a message [bytes]

[[noreturn]] void refuse(const Scene& scene, const std::string& why) {
  throw granvof::CaseError(fmt::format("{}: demvof cannot compute this scene: {}",
                                       granvof::case_file::printable(scene.file.string(), longest_name),
                                       why));
}

bool flat(const Scene& scene) {
  return scene.dimensions == 2;
}

std::array<int, 3> reference_cells(const Scene& scene) {
  std::array<int, 3> cells{1, 1, 1};
  for (std::size_t d = 0; d < (flat(scene) ? 2U : 3U); ++d) {
    cells[d] = std::max(1, static_cast<int>(std::lround(scene.tank[d] / scene.reference->cell)));
  }
  return cells;
}

FluidSide fluid_side(const granvof::Side& side) {
  if (side.kind == SideKind::open) return FluidSide::open;
  return side.fluid.kind == WallKind::slip ? FluidSide::slip : FluidSide::no_slip;
}

bool slippery_for_beads(const Scene& scene) {
  return scene.sides[granvof::left].solid.kind == WallKind::slip &&
         scene.sides[granvof::bottom].solid.kind == WallKind::slip;
}

ContactLaw run_law(const Scene& scene) {
  const granvof::ReferenceSettings& r = *scene.reference;
  ContactLaw law;
  law.young = r.young;
  law.poisson = r.poisson;
  law.restitution = r.bead_restitution;
  law.bead_friction = r.bead_friction;
  law.rolling_friction = r.bead_rolling_friction;
  law.wall_friction = slippery_for_beads(scene) ? 0.0 : r.wall_friction;
  law.obstacle_friction = r.wall_friction;  // grains stick to them beside walls on which they slip, too
  law.gate_friction = slippery_for_beads(scene) && r.gate_friction == r.wall_friction ? 0.0 : r.gate_friction;
  return law;
}

// On that of the tank, or on an obstacle.
bool stands_on_a_floor(const Scene& scene) {
  const granvof::Box& bed = scene.bed->box;
  const double d = bead_diameter(scene);
  return bed.lower[1] < d ||
         std::any_of(scene.obstacles.begin(), scene.obstacles.end(), [&](const granvof::Box& box) {
           return std::abs(bed.lower[1] - box.upper[1]) < d && box.lower[0] < bed.upper[0] &&
                  box.upper[0] > bed.lower[0];
         });
}

// Share of [from, to] inside [lower, upper].
double overlap(double from, double to, double lower, double upper) {
  return std::max(0.0, std::min(to, upper) - std::max(from, lower)) / (to - from);
}

// Beads of the bed, without the floor's.
double bead_count(const Scene& scene) {
  const granvof::Box& bed = scene.bed->box;
  const double area = (bed.upper[0] - bed.lower[0]) * (bed.upper[1] - bed.lower[1]);
  const double depth = flat(scene) ? depth_of(scene) : bed.upper[2] - bed.lower[2];
  return scene.reference->packing * area * depth /
         (std::numbers::pi / 6.0 * std::pow(bead_diameter(scene), 3));
}

void check_packing(const Scene& scene) {
  if (scene.reference->packing > densest_pile) {
    refuse(scene, fmt::format("reference.packing is {}, a bed that cannot be packed, allowed: <= {}",
                              scene.reference->packing, densest_pile));
  }
  const double count = bead_count(scene);
  if (count < 1.0) {
    refuse(scene,
           fmt::format("the bed holds {:.3g} beads of {:.6g} m (reference.packing, solid.diameter), allowed: "
                       "at least one",
                       count, bead_diameter(scene)));
  }
  if (count > most_beads) {
    refuse(scene,
           fmt::format("{:.3g} beads of {:.6g} m (solid.diameter, reference.coarse_graining), allowed: "
                       "at most {:g} beads",
                       count, bead_diameter(scene), most_beads));
  }
}

void check_times(const Scene& scene) {
  const granvof::ReferenceSettings& r = *scene.reference;
  if (const double all = r.hold + scene.times.end; all > most_steps * r.dt) {
    refuse(scene,
           fmt::format("reference.hold and time.end are {:g} s, allowed: at most {:g} s, {:g} steps of "
                       "reference.dt",
                       all, most_steps * r.dt, most_steps));
  }
  if (const double time = granvof::scales_of(scene).time(); r.fluid_dt > time) {
    refuse(scene,
           fmt::format("reference.fluid_dt is {} s, allowed: at most {:.3g} s, in which the scene changes",
                       r.fluid_dt, time));
  }
}

}  // namespace

void check_beads(const Scene& scene) {
  if (!scene.reference) refuse(scene, "it has no [reference] table");
  if (scene.reference->young < 5e6) {
    refuse(scene, fmt::format("reference.young is {}, allowed: >= 5e6 Pa", scene.reference->young));
  }
  const granvof::ReferenceSettings& r = *scene.reference;
  if (r.young > stiffest)
    refuse(scene, fmt::format("reference.young is {}, allowed: <= {:g} Pa", r.young, stiffest));
  if (r.bead_restitution <= least_restitution) {
    refuse(scene, fmt::format("reference.bead_restitution is {}, allowed: > {}", r.bead_restitution,
                              least_restitution));
  }
}

void check_scene(const Scene& scene) {
  check_beads(scene);
  check_times(scene);
  if (!scene.bed) refuse(scene, "it has no [bed]");
  if (scene.bed->slope != 90.0) refuse(scene, fmt::format("bed.slope is {}, allowed: 90", scene.bed->slope));
  check_packing(scene);
  const std::size_t sides = flat(scene) ? 4 : 6;
  for (std::size_t s = 0; s < sides; ++s) {
    const SideKind kind = scene.sides[s].kind;
    if (kind != SideKind::wall && kind != SideKind::open)
      refuse(scene,
             fmt::format("a side is of kind {}, allowed: no-slip, slip, open", granvof::facts_of(kind).name));
    for (const double v : scene.sides[s].velocity) {
      if (v != 0.0) refuse(scene, "a wall moves, allowed: walls at rest");
    }
  }
  if (const std::string why = obstacles_refused(with_reference_grid(scene)); !why.empty()) refuse(scene, why);
  if (bead_diameter(scene) > scene.reference->cell) {
    refuse(
        scene,
        fmt::format("beads of {:.6g} m are larger than the fluid's cells; allowed: reference.cell = {:.6g} m",
                    bead_diameter(scene), scene.reference->cell));
  }
  if (flat(scene) && depth_of(scene) < thinnest_slice * bead_diameter(scene)) {
    refuse(scene, fmt::format("reference.slice_depth is {:.6g} m, allowed: >= {:.6g} m, {} bead diameters",
                              depth_of(scene), thinnest_slice * bead_diameter(scene), thinnest_slice));
  }
  if (scene.gate) {
    const double faces = scene.gate->position / (scene.tank[0] / reference_cells(scene)[0]);
    if (std::abs(faces - std::round(faces)) > 1e-6) {
      refuse(
          scene,
          fmt::format("the gate at {} m does not lie on a face of the fluid cells; choose reference.cell so "
                      "that it does",
                      scene.gate->position));
    }
  }
}

double bead_diameter(const Scene& scene) {
  return scene.solid.diameter * scene.reference->coarse_graining;
}

double bead_dt(const Scene& scene) {
  return scene.reference->dt * scene.reference->coarse_graining;
}

double solid_share(const Scene& scene, std::size_t beads) {
  return static_cast<double>(beads) / bead_count(scene);
}

double depth_of(const Scene& scene) {
  return flat(scene) ? scene.reference->slice_depth : scene.tank[2];
}

FluidSettings fluid_settings(const Scene& scene, const std::string& scratch) {
  FluidSettings f;
  f.cells = reference_cells(scene);
  f.spacing = {scene.tank[0] / f.cells[0], scene.tank[1] / f.cells[1], depth_of(scene) / f.cells[2]};
  f.gravity = scene.gravity;
  f.inclination = scene.inclination;
  f.gas_density = scene.gas.density;
  f.gas_viscosity = scene.gas.viscosity;
  f.liquid_density = scene.liquid.density;
  f.liquid_viscosity = scene.liquid.viscosity;
  f.large_eddy = scene.model.les;
  f.convection = scene.reference->convection == granvof::ReferenceConvection::van_leer
                     ? MomentumConvection::van_leer
                     : MomentumConvection::upwind;
  for (std::size_t s = 0; s < 6; ++s) {
    f.sides[s] = flat(scene) && s >= 4 ? FluidSide::empty : fluid_side(scene.sides[s]);
  }
  f.obstacles = obstacles_on(with_reference_grid(scene)).closed;
  f.scratch_folder = scratch;
  return f;
}

BeadSettings bead_settings(const Scene& scene, const std::string& scratch) {
  BeadSettings b;
  b.tank = {scene.tank[0], scene.tank[1], depth_of(scene)};
  b.periodic_depth = flat(scene);
  b.diameter = bead_diameter(scene);
  b.density = scene.solid.density;
  b.law = run_law(scene);
  b.dt = bead_dt(scene);
  b.gravity = scene.gravity;
  b.inclination = scene.inclination;
  if (scene.gate) {
    b.gate = scene.gate->position;
    b.gate_height = scene.bed->box.upper[1] + 4.0 * b.diameter;
  }
  b.obstacles = obstacles_on(with_reference_grid(scene));
  b.scratch_folder = scratch;
  return b;
}

ColumnSettings column_settings(const Scene& scene, unsigned seed, const std::vector<double>& floor,
                               const std::string& scratch) {
  const granvof::ReferenceSettings& r = *scene.reference;
  ColumnSettings c;
  c.lower = scene.bed->box.lower;
  c.upper = scene.bed->box.upper;
  c.periodic_depth = flat(scene);
  if (flat(scene)) {
    c.lower[2] = 0.0;
    c.upper[2] = depth_of(scene);
  }
  c.packing = r.packing;
  c.suspended = r.packing < loosest_pile;
  c.diameter = bead_diameter(scene);
  c.density = scene.solid.density;
  const double lighter = scene.liquid.density / scene.solid.density;
  // Floating beads are packed under their own weight's size of buoyancy; only its size matters.
  c.buoyant_gravity = scene.gravity * std::max(0.1, std::abs(1.0 - lighter));
  c.final_law = c.preparation_law = run_law(scene);
  c.preparation_law.bead_friction = r.preparation_friction;
  c.preparation_law.rolling_friction = r.preparation_rolling_friction;
  // A column that is not held is wanted as it was prepared: the packing that its friction cannot carry.
  c.final_settling = !scene.gate || r.hold > 0.0;
  c.dt = bead_dt(scene);
  c.floor = floor;
  c.seed = seed;
  c.scratch_folder = scratch;
  return c;
}

std::vector<double> floor_beads(const Scene& scene, unsigned seed) {
  const double d = bead_diameter(scene);
  if (scene.reference->floor != granvof::ReferenceFloor::rough || !stands_on_a_floor(scene)) return {};
  if (scene.obstacles.empty()) return rough_floor({scene.tank[0], depth_of(scene), flat(scene)}, d, seed);
  std::vector<double> beads;
  const auto cover = [&](const granvof::Vec3& lower, const granvof::Vec3& upper, double height) {
    const double depth = flat(scene) ? depth_of(scene) : upper[2] - lower[2];
    const std::vector<double> floor = rough_floor({upper[0] - lower[0], depth, flat(scene)}, d, seed);
    for (std::size_t n = 0; n + 2 < floor.size(); n += 3) {
      const double at[] = {lower[0] + floor[n], height + floor[n + 1],
                           (flat(scene) ? 0.0 : lower[2]) + floor[n + 2]};
      if (!inside_an_obstacle(scene, at)) beads.insert(beads.end(), std::begin(at), std::end(at));
    }
  };
  cover({0.0, 0.0, 0.0}, scene.tank, 0.0);
  for (const granvof::Box& box : scene.obstacles) cover(box.lower, box.upper, box.upper[1]);
  return beads;
}

std::vector<double> initial_alpha(const Scene& scene, const FluidSettings& fluid) {
  const auto [nx, ny, nz] = fluid.cells;
  std::vector<double> alpha;
  alpha.reserve(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) * static_cast<std::size_t>(nz));
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        double share = 0.0;
        for (const granvof::Box& box : scene.liquid_boxes) {
          double inside =
              overlap(i * fluid.spacing[0], (i + 1) * fluid.spacing[0], box.lower[0], box.upper[0]) *
              overlap(j * fluid.spacing[1], (j + 1) * fluid.spacing[1], box.lower[1], box.upper[1]);
          if (!flat(scene)) {
            inside *= overlap(k * fluid.spacing[2], (k + 1) * fluid.spacing[2], box.lower[2], box.upper[2]);
          }
          share = std::max(share, inside);
        }
        alpha.push_back(share);
      }
    }
  }
  return alpha;
}

Scene with_reference_grid(const Scene& scene) {
  Scene changed = scene;
  changed.grid.cells = reference_cells(scene);
  for (std::size_t d = 0; d < 3; ++d) changed.grid.spacing[d] = scene.tank[d] / changed.grid.cells[d];
  return changed;
}

}  // namespace demvof
