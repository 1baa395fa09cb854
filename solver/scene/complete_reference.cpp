#include <algorithm>

#include <fmt/format.h>

#include "solver/scene/completion.hpp"

namespace granvof::case_file {
namespace {

constexpr double most_reference_cells = 1e8;

void slice(const Completion& c) {
  std::optional<double>& depth = c.d.reference.slice_depth;
  if (c.flat() && !depth) c.refuse("reference.slice_depth", "a number > 0 [m], required in 2D");
  if (!c.flat() && c.given("reference.slice_depth")) {
    c.refuse("reference.slice_depth", "no such key in 3D: tank.size has the depth");
  }
  c.d.reference.settings.slice_depth = depth.value_or(c.s.tank[2]);
}

void cells(const Completion& c) {
  double total = 1.0;
  for (int axis = 0; axis < c.s.dimensions; ++axis)
    total *= std::max(1.0, c.s.tank[axis] / c.d.reference.settings.cell);
  if (total > most_reference_cells) {
    c.refuse("reference.cell", fmt::format("a cell of which the tank has at most {}", most_reference_cells));
  }
}

void steps_of_reference(const Completion& c) {
  const ReferenceSettings& r = c.d.reference.settings;
  if (r.dt * r.coarse_graining > r.fluid_dt) {
    c.refuse("reference.dt", fmt::format("at most reference.fluid_dt{} = {} s",
                                         r.coarse_graining > 1.0 ? " / reference.coarse_graining" : "",
                                         r.fluid_dt / r.coarse_graining));
  }
}

void release(const Completion& c) {
  ReferenceInput& input = c.d.reference;
  ReferenceSettings& r = input.settings;
  const bool gated = c.has("gate");
  r.release =
      *(input.release = input.release.value_or(gated ? ReferenceRelease::gate : ReferenceRelease::instant));
  if (r.release == ReferenceRelease::gate && !gated) {
    c.refuse("reference.release", "\"instant\": the case has no [gate]");
  }
  r.hold = *(input.hold = input.hold.value_or(gated ? ReferenceSettings{}.hold : 0.0));
}

void beads(const Completion& c) {
  ReferenceInput& input = c.d.reference;
  ReferenceSettings& r = input.settings;
  r.packing = *(input.packing = input.packing.value_or(c.d.bed.solid_fraction));
  r.bead_friction = *(input.bead_friction = input.bead_friction.value_or(c.s.solid.friction));
  r.bead_restitution = *(input.bead_restitution = input.bead_restitution.value_or(c.s.solid.restitution));
  r.wall_friction = *(input.wall_friction = input.wall_friction.value_or(r.bead_friction));
  r.gate_friction = input.gate_friction.value_or(r.wall_friction);
  // Records know of the key only where the plate is not as the walls are.
  if (r.gate_friction == r.wall_friction) input.gate_friction.reset();
}

}  // namespace

void complete_reference(Completion& c) {
  if (!c.has("reference")) return;
  c.rule({"reference", "bed"}, [&] { c.needs("reference", "bed"); });
  c.rule({"scene.dimensions", "tank", "reference.slice_depth"}, [&] { slice(c); });
  c.rule({"scene.dimensions", "tank.size", "reference.cell"}, [&] { cells(c); });
  c.rule({"reference.dt", "reference.coarse_graining", "reference.fluid_dt"}, [&] { steps_of_reference(c); });
  c.rule({"reference.seeds"}, [&] {
    std::vector<int> seeds = c.d.reference.settings.seeds;
    std::ranges::sort(seeds);
    if (seeds.empty()) c.refuse("reference.seeds", "at least one seed");
    if (std::ranges::adjacent_find(seeds) != seeds.end())
      c.refuse("reference.seeds", "each seed once: the same run twice has no spread");
  });
  c.rule({"reference.release", "gate"}, [&] { release(c); });
  c.rule({"reference.gate_friction", "gate"}, [&] {
    if (c.given("reference.gate_friction") && !c.has("gate"))
      c.refuse("reference.gate_friction", "no such key without a [gate]");
  });
  c.rule({"reference", "bed", "solid"}, [&] { beads(c); });
  c.s.reference = c.d.reference.settings;
}

}  // namespace granvof::case_file
