// Keys that act on nothing in the scene, since what they act upon is not there or another key has turned it
// off.
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "solver/closures/critical_packing/laws.hpp"
#include "solver/closures/friction/laws.hpp"
#include "solver/closures/granular_temperature/laws.hpp"
#include "solver/plausibility/plausibility_rows.hpp"
#include "solver/scene/complete.hpp"
#include "solver/scene/keys.hpp"
#include "solver/scene/presets.hpp"

namespace granvof::plausible {
namespace {

using Condition = std::function<bool(const Scene&)>;
constexpr const char* no_effect = "it has no effect without ";

struct Idle {
  std::vector<std::string> keys;
  Condition used;
  std::string reason;
};

Condition model(bool Model::*part) {
  return [part](const Scene& s) { return s.model.*part; };
}
Condition both(Condition a, Condition b) {
  return [a = std::move(a), b = std::move(b)](const Scene& s) { return a(s) && b(s); };
}
Condition any_of(std::vector<Condition> all) {
  return [all = std::move(all)](const Scene& s) {
    return std::ranges::any_of(all, [&](const Condition& one) { return one(s); });
  };
}

bool floor_holds_grains(const Scene& s) {
  return s.sides[bottom].kind == SideKind::wall && s.sides[bottom].solid.kind == WallKind::no_slip;
}
bool law_stops_in_liquid(const Scene& s) {
  return closures::depends_on_pore_viscosity(s.model.friction_law);
}

// A parameter that some laws of critical packing alone read.
Idle of_critical_packing(const std::string& key) {
  return {{key},
          [key](const Scene& s) {
            return s.model.shear_dilatancy && s.model.critical_packing.facts().reads_key(key);
          },
          fmt::format("{}model.shear_dilatancy and model.critical_packing = {}", no_effect,
                      closures::words_that_read<closures::CriticalPackings>(key))};
}

// A parameter that some laws of friction alone read.
Idle of_friction_law(const std::string& key, const Condition& otherwise, const std::string& more) {
  const Condition read = [key, otherwise](const Scene& s) {
    return s.model.contact_friction && (s.model.friction_law.facts().reads_key(key) || otherwise(s));
  };
  return {{key},
          read,
          fmt::format("{}model.contact_friction, and model.friction_law = {}{}", no_effect,
                      closures::words_that_read<closures::FrictionLaws>(key), more)};
}

// What parts of the model that are of grains read beside the grains' material.
std::vector<std::string> keys_of_grains() {
  std::vector<std::string> names;
  for (const case_file::Key& key : case_file::keys())
    if (key.part->of_grains && key.table() != "solid") names.push_back(key.name);
  return names;
}

// The first that holds for a key says why.
std::vector<Idle> all_idle() {
  const Condition friction = model(&Model::contact_friction), shear = model(&Model::shear_dilatancy),
                  drag = model(&Model::drag), agitated = model(&Model::agitation_drag);
  const Condition never = [](const Scene&) { return false; };
  const std::string without = no_effect;
  return {
      {keys_of_grains(), has_grains, without + "grains: a [bed], or an inlet of them"},
      {{"tank.inclination"}, [](const Scene& s) { return s.gravity > 0.0; }, without + "tank.gravity"},
      {{"model.drag_law"}, any_of({drag, agitated}), without + "model.drag"},
      {{"model.agitation_drag"}, drag, "it is drag too, which model.drag = false leaves out everywhere else"},
      {{"model.kinetic_viscosity"},
       [](const Scene& s) { return closures::agitates(s.model.granular_temperature); },
       without + "model.granular_temperature"},
      {{"model.granular_temperature"},
       model(&Model::kinetic_viscosity),
       without + "model.kinetic_viscosity, which alone makes it"},
      {{"model.pressure_work", "model.radial_distribution", "model.kinetic_transport",
        "model.correlated_collisions", "model.frictional_restitution", "model.dilatancy_pressure"},
       has_agitation,
       without + "model.granular_temperature and model.kinetic_viscosity"},
      {{"contact.dilatancy_factor", "contact.dilatancy_exponent", "contact.dense_solid_fraction"},
       both(model(&Model::dense_excess), has_agitation),
       without + "model.dilatancy_pressure, model.granular_temperature and model.kinetic_viscosity"},
      {{"model.whole_stress_friction"},
       [](const Scene& s) { return !s.model.whole_stress_friction || s.model.bounds_collisions(); },
       without + "model.contact_friction, model.granular_temperature and model.kinetic_viscosity"},
      {{"model.friction_law", "model.thin_layer_arrest"}, friction, without + "model.contact_friction"},
      {{"model.friction_law"},
       [](const Scene& s) { return has_liquid(s) || !law_stops_in_liquid(s); },
       "it is of grains that a viscous liquid stops, and the scene has none"},
      {{"model.thin_layer_arrest"},
       floor_holds_grains,
       without + "a floor that grains stick to (walls.bottom)"},
      {{"contact.stop_length"},
       both(friction, model(&Model::thin_layer_arrest)),
       without + "model.thin_layer_arrest and model.contact_friction"},
      of_friction_law("contact.fast_friction", model(&Model::thin_layer_arrest),
                      ", or model.thin_layer_arrest"),
      of_friction_law("contact.inertial_number", never, ""),
      of_friction_law("contact.viscous_number", never, ""),
      {{"contact.regularisation"},
       any_of({friction, agitated, both(shear, model(&Model::dilatancy_friction))}),
       without + "model.contact_friction"},
      {{"model.packing"},
       [](const Scene& s) { return !s.model.shear_dilatancy; },
       "it has no effect with model.shear_dilatancy, which starts from what is carried"},
      {{"contact.critical_solid_fraction", "contact.dilatancy_slope", "model.critical_packing",
        "model.dilatancy_friction"},
       shear,
       without + "model.shear_dilatancy"},
      of_critical_packing("contact.dilatancy_rate"),
      {{"model.viscous_contact_pressure", "model.suspension_viscosity"},
       has_liquid,
       "it is of grains in a viscous liquid, and the scene has none"},
      {{"numerics.interface_scheme", "numerics.fluid_convection"},
       has_liquid,
       without + "a liquid beside the gas"},
      {{"bed.colour"}, model(&Model::colour), without + "model.colour: the bands stay where they are"},
  };
}

}  // namespace

std::vector<Implausible> idle_keys(const Scene& scene) {
  case_file::Faults none;
  const case_file::Draft draft =
      case_file::read_draft(case_file::read_case_text(scene.resolved, scene.name, {}), none);
  case_file::Draft unstated;
  unstated.preset = draft.preset;
  case_file::apply_preset(unstated);
  std::vector<Implausible> found;
  for (const Idle& idle : all_idle()) {
    if (idle.used(scene)) continue;
    for (const std::string& name : idle.keys) {
      const case_file::Key& key = *case_file::find_key(name);
      const std::string given = key.get(draft), usual = key.get(unstated);
      if (given != usual) found.push_back({name, given, usual, idle.reason});
    }
  }
  return found;
}

}  // namespace granvof::plausible
