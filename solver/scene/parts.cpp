#include "solver/scene/parts.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "solver/closures/granular_temperature/laws.hpp"
#include "solver/scene/scene.hpp"

namespace granvof {
namespace {

bool has_side(const Scene& scene, SideKind kind) {
  return std::ranges::any_of(scene.sides, [=](const Side& side) { return side.kind == kind; });
}
bool agitates_grains(const Scene& s) {
  return has_grains(s) && has_agitation(s);
}

}  // namespace

bool has_grains(const Scene& s) {
  return s.bed || std::ranges::any_of(s.sides, [](const Side& side) {
           return side.kind == SideKind::inlet && side.inflow.solid_fraction > 0.0;
         });
}

bool has_liquid(const Scene& s) {
  return !s.liquid_boxes.empty() || std::ranges::any_of(s.sides, [](const Side& side) {
    return (side.kind == SideKind::inlet && side.inflow.liquid_share > 0.0) || side.outflow.level > 0.0;
  });
}

bool has_agitation(const Scene& s) {
  return closures::agitates(s.model.granular_temperature) && s.model.kinetic_viscosity;
}

PartsOfModel parts_of_model(const Scene& scene) {
  PartsOfModel parts;
  for (const Part* part : all_parts()) {
    if (part->acts == nullptr && part->equations.front() == 0) continue;
    (part->acts == nullptr || part->acts(scene) ? parts.act : parts.rest).push_back(part);
  }
  return parts;
}

namespace parts {

constexpr Part grains_transport{.name = "transport of grains",
                                .equations = {1, 25},
                                .page = "docs/theory/balances.md",
                                .code = "solver/operators/solid_transport.hpp",
                                .acts = has_grains,
                                .of_grains = true};
constexpr Part interface {
  .name = "interface", .equations = {2, 3, 24}, .page = "docs/theory/balances.md",
  .code = "solver/operators/interface_transport.hpp", .acts = has_liquid
};
constexpr Part pressure{.name = "pressure",
                        .equations = {4},
                        .page = "docs/theory/balances.md",
                        .code = "solver/operators/coupled_pressure.hpp"};
constexpr Part momentum{.name = "momentum",
                        .equations = {5, 6},
                        .page = "docs/theory/balances.md",
                        .code = "solver/operators/momentum_predictor.hpp"};
constexpr Part drag{.name = "drag",
                    .equations = {8, 9},
                    .page = "docs/theory/drag.md",
                    .code = "solver/operators/interphase_drag.hpp",
                    .acts = [](const Scene& s) { return has_grains(s) && s.model.drag; },
                    .of_grains = true};
constexpr Part fluid_viscosity{.name = "fluid viscosity",
                               .equations = {10},
                               .page = "docs/theory/balances.md",
                               .code = "solver/operators/viscosity.hpp"};
constexpr Part solid_pressure{.name = "solid pressure",
                              .equations = {12, 13, 14, 15},
                              .page = "docs/theory/contact.md",
                              .code = "solver/closures/solid_pressure.hpp",
                              .acts = has_grains,
                              .of_grains = true};
constexpr Part packing{.name = "packing",
                       .page = "docs/theory/choices.md",
                       .code = "solver/operators/packing.hpp",
                       .acts = [](const Scene& s) { return has_grains(s) && s.model.carries_packing(); },
                       .of_grains = true};
constexpr Part friction{.name = "friction",
                        .equations = {17},
                        .page = "docs/theory/contact.md",
                        .code = "solver/operators/friction.hpp",
                        .acts = [](const Scene& s) { return has_grains(s) && s.model.contact_friction; },
                        .of_grains = true};
constexpr Part kinetic_stress{.name = "kinetic stress",
                              .equations = {11, 16, 18, 19, 20, 21},
                              .page = "docs/theory/kinetic-theory.md",
                              .code = "solver/closures/collisions.hpp",
                              .acts = agitates_grains,
                              .of_grains = true};
constexpr Part granular_temperature{.name = "granular temperature",
                                    .equations = {7, 22, 23},
                                    .page = "docs/theory/kinetic-theory.md",
                                    .code = "solver/operators/granular_temperature.hpp",
                                    .acts = agitates_grains,
                                    .of_grains = true};
constexpr Part viscous_contacts{
    .name = "viscous contacts",
    .page = "docs/theory/choices.md",
    .code = "solver/closures/suspension.hpp",
    .acts =
        [](const Scene& s) {
          return has_grains(s) && (s.model.viscous_contact_pressure || s.model.suspension_viscosity);
        },
    .of_grains = true};
constexpr Part bed_surface{
    .name = "bed surface",
    .page = "docs/theory/choices.md",
    .code = "solver/operators/bed_surface.hpp",
    .acts = [](const Scene& s) { return has_grains(s) && s.numerics.has_part_cells(); },
    .of_grains = true};
constexpr Part walls{
    .name = "walls", .page = "docs/theory/sides.md", .code = "solver/grid/sides/side_rule.hpp"};
constexpr Part inlet{.name = "inlets",
                     .page = "docs/theory/sides.md",
                     .code = "solver/grid/sides/inlet.cpp",
                     .acts = [](const Scene& s) { return has_side(s, SideKind::inlet); }};
constexpr Part outlet{.name = "outlets",
                      .page = "docs/theory/sides.md",
                      .code = "solver/grid/sides/outlet.cpp",
                      .acts = [](const Scene& s) { return has_side(s, SideKind::outlet); }};
constexpr Part obstacles{.name = "obstacles",
                         .page = "docs/theory/sides.md",
                         .code = "solver/grid/obstacles.hpp",
                         .acts = [](const Scene& s) { return !s.obstacles.empty(); }};
constexpr Part gate{.name = "gate",
                    .page = "docs/theory/choices.md",
                    .code = "solver/operators/aperture.hpp",
                    .acts = [](const Scene& s) { return s.gate.has_value(); }};
constexpr Part label{.name = "label", .page = "docs/how-to/scene.md", .code = "solver/scene/load_scene.hpp"};
constexpr Part materials{
    .name = "materials", .page = "docs/theory/README.md", .code = "solver/model/grains.hpp"};
constexpr Part start{.name = "start", .page = "docs/how-to/scene.md", .code = "solver/run/initial_state.hpp"};
constexpr Part grid{.name = "grid", .page = "docs/theory/numerics.md", .code = "solver/grid/grid.hpp"};
constexpr Part time_step{
    .name = "time step", .page = "docs/theory/numerics.md", .code = "solver/run/step_control.hpp"};
constexpr Part ledger{
    .name = "energy ledger", .page = "docs/theory/energy.md", .code = "solver/run/energy_budget.hpp"};
constexpr Part output{.name = "output", .page = "docs/output.md", .code = "solver/output/run_writer.hpp"};
constexpr Part reference{.name = "reference",
                         .page = "reference/README.md",
                         .code = "solver/scene/complete_reference.cpp",
                         .acts = [](const Scene& s) { return s.reference.has_value(); }};

}  // namespace parts

std::span<const Part* const> all_parts() {
  using namespace parts;
  static constexpr std::array list{&grains_transport,
                                   &interface,
                                   &pressure,
                                   &momentum,
                                   &drag,
                                   &fluid_viscosity,
                                   &solid_pressure,
                                   &packing,
                                   &friction,
                                   &kinetic_stress,
                                   &granular_temperature,
                                   &viscous_contacts,
                                   &bed_surface,
                                   &walls,
                                   &inlet,
                                   &outlet,
                                   &obstacles,
                                   &gate,
                                   &label,
                                   &materials,
                                   &start,
                                   &grid,
                                   &time_step,
                                   &ledger,
                                   &output,
                                   &reference};
  return list;
}

std::string text_of_equations(std::span<const int> equations) {
  std::string text;
  for (std::size_t first = 0; first < equations.size();) {
    if (equations[first] == 0) break;
    std::size_t last = first;
    while (last + 1 < equations.size() && equations[last + 1] == equations[last] + 1) ++last;
    if (!text.empty()) text += ", ";
    text += fmt::format("({})", equations[first]);
    if (last > first) text += fmt::format("{}({})", last > first + 1 ? "-" : ", ", equations[last]);
    first = last + 1;
  }
  return text;
}

}  // namespace granvof
