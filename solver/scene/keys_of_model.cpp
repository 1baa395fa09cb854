#include "solver/scene/keys_of_model.hpp"

#include "solver/closures/critical_packing/laws.hpp"
#include "solver/closures/drag/laws.hpp"
#include "solver/closures/friction/laws.hpp"
#include "solver/closures/granular_temperature/laws.hpp"
#include "solver/closures/kinetic_transport/laws.hpp"
#include "solver/closures/packing/laws.hpp"
#include "solver/closures/radial_distribution/laws.hpp"
#include "solver/scene/key_types.hpp"
#include "solver/scene/presets.hpp"
#include "solver/scene/words_of_list.hpp"

namespace granvof::case_file {

std::vector<Key> contact_keys() {
  const auto of = [](auto member) {
    return [member](auto& draft) -> auto& {
      return draft.scene.contact.*member;
    };
  };
  return {
      key(parts::solid_pressure, "contact.stiffness", "Pa", positive, of(&Contact::stiffness), "K of (13)."),
      key(parts::solid_pressure, "contact.exponent", "-",
          Bounds{.lower = 0.0, .upper = 10.0, .lower_open = true}, of(&Contact::exponent), "chi of (13)."),
      key(parts::solid_pressure, "contact.dilatancy_factor", "-", not_negative, of(&Contact::flow_law_factor),
          "a' of the flow law in (15)."),
      key(parts::solid_pressure, "contact.dilatancy_exponent", "-", positive, of(&Contact::flow_law_exponent),
          "delta of the flow law in (15)."),
      key(parts::solid_pressure, "contact.dense_solid_fraction", "-", part,
          of(&Contact::dense_solid_fraction), "f_s0 of (15); at most solid_fraction_max."),
      key(parts::solid_pressure, "contact.solid_fraction_min", "-", part, of(&Contact::solid_fraction_min),
          "f_s,min, random loose packing; below solid_fraction_max."),
      key(parts::solid_pressure, "contact.solid_fraction_max", "-", part, of(&Contact::solid_fraction_max),
          "f_s,max."),
      key(parts::friction, "contact.regularisation", "s", positive, of(&Contact::regularisation),
          "n of (17)."),
      otherwise(
          key(parts::friction, "contact.fast_friction", "-", not_negative, of(&Contact::fast_friction),
              "mu_2 of mu(I), mu(I_v) and h_stop; at least solid.friction with a friction_law that reads "
              "it or thin_layer_arrest."),
          "0.643, or solid.friction where that is more"),
      key(parts::friction, "contact.inertial_number", "-", positive, of(&Contact::inertial_number),
          "I_0 of mu(I)."),
      came_later(key(parts::friction, "contact.stop_length", "-", positive, of(&Contact::stop_length),
                     "L of h_stop, in grain diameters, with thin_layer_arrest."),
                 "1.65"),
      came_later(
          key(parts::packing, "contact.critical_solid_fraction", "-", part,
              of(&Contact::critical_solid_fraction),
              "f_c, packing under slow shear, with shear_dilatancy; between solid_fraction_min and _max."),
          "0.582"),
      came_later(key(parts::packing, "contact.dilatancy_slope", "-", positive, of(&Contact::dilatancy_slope),
                     "K_psi, tangent of the dilatancy angle per solid fraction above f_c."),
                 "4.09"),
      came_later(
          key(parts::packing, "contact.dilatancy_rate", "-", not_negative, of(&Contact::loosening_factor),
              "a of the critical packing f_c / (1 + a sqrt(J)), with critical_packing = \"by-rate\"."),
          "1"),
      came_later(key(parts::friction, "contact.viscous_number", "-", positive, of(&Contact::viscous_number),
                     "I_v at which mu(I_v) is half way from solid.friction to fast_friction."),
                 "0.005"),
  };
}

std::vector<Key> model_keys() {
  const auto of = [](auto member) {
    return [member](auto& draft) -> auto& {
      return draft.scene.model.*member;
    };
  };
  Words<Preset> preset_words;
  for (const PresetEntry& entry : presets()) preset_words.emplace_back(entry.word, entry.preset);
  return {
      // Named for the reader: it is in the hashes by what it sets.
      scoped(
          choice(
              parts::label, "model.preset", preset_words, [](auto& draft) -> auto& { return draft.preset; },
              "What is chosen beside the paper's model, see Presets below; single keys go on top."),
          Scope::label),
      key(parts::drag, "model.drag", "", any, of(&Model::drag), "Drag, (8) and (9)."),
      // demvof's too: in both hashes
      scoped(came_later(
                 choice(parts::drag, "model.drag_law", words_of<closures::DragLaws>(), of(&Model::drag_law),
                        "Drag coefficient, of both codes: " + sources_of<closures::DragLaws>() +
                            "; only the first jumps, at f_s 0.2."),
                 R"("paper")"),
             Scope::setup),
      key(parts::fluid_viscosity, "model.les", "", any, of(&Model::les), "Subgrid viscosity (10)."),
      choice(parts::granular_temperature, "model.granular_temperature",
             words_of<closures::TemperatureModels>(), of(&Model::granular_temperature), "Eq (7)."),
      key(parts::granular_temperature, "model.pressure_work", "", any, of(&Model::pressure_work),
          "-P_s^K div u_s in (7)."),
      key(parts::solid_pressure, "model.dilatancy_pressure", "", any, of(&Model::dense_excess),
          "Dense-flow excess P_s^EF, (14)."),
      key(parts::kinetic_stress, "model.kinetic_viscosity", "", any, of(&Model::kinetic_viscosity),
          "mu_s^K and zeta_s^K, (20), (21)."),
      came_later(choice(parts::kinetic_stress, "model.radial_distribution",
                        words_of<closures::RadialDistributions>(), of(&Model::radial_distribution),
                        "g0: " + sources_of<closures::RadialDistributions>() +
                            "; the latter of spheres that jam at contact.solid_fraction_max."),
                 R"("paper")"),
      came_later(choice(parts::kinetic_stress, "model.kinetic_transport",
                        words_of<closures::KineticTransports>(), of(&Model::kinetic_transport),
                        "mu_s^K and kappa_s^K, " + sources_of<closures::KineticTransports>() +
                            ": what collisions hand over, or with what grains carry between them."),
                 R"("collisional")"),
      came_later(key(parts::granular_temperature, "model.correlated_collisions", "", any,
                     of(&Model::correlated_collisions),
                     "Dense collisions dissipate less, by a correlation length (Jenkins 2007)."),
                 "false"),
      key(parts::friction, "model.contact_friction", "", any, of(&Model::contact_friction), "tau_s^E, (17)."),
      choice(parts::friction, "model.friction_law", words_of<closures::FrictionLaws>(),
             of(&Model::friction_law),
             "Friction coefficient, " + sources_of<closures::FrictionLaws>() +
                 ": solid.friction, or mu(I), which it is at rest, or likewise mu(I_v), of grains that a "
                 "viscous liquid stops."),
      came_later(
          key(parts::friction, "model.whole_stress_friction", "", any, of(&Model::whole_stress_friction),
              "The friction law is one of all that grains bear: it goes by P_s^E + P_s^K, and collisions "
              "shear by no more than it has for P_s^K."),
          "false"),
      came_later(choice(parts::packing, "model.packing", words_of<closures::Packings>(), of(&Model::packing),
                        "Where grains touch: at contact.solid_fraction_min everywhere (the paper), or where "
                        "(13) bears the weight of the bed as it is set up, carried with the grains: a bed "
                        "then starts at rest at any solid fraction."),
                 R"("uniform")"),
      came_later(key(parts::friction, "model.thin_layer_arrest", "", any, of(&Model::thin_layer_arrest),
                     "Friction of a layer on a no-slip floor at least that at which it stops, h_stop "
                     "(Pouliquen 1999)."),
                 "false"),
      came_later(key(parts::packing, "model.shear_dilatancy", "", any, of(&Model::shear_dilatancy),
                     "The packing at which grains touch follows shear to contact.critical_solid_fraction "
                     "(Pailha and Pouliquen 2009), from where model.packing = \"carried\" starts."),
                 "false"),
      came_later(choice(parts::packing, "model.critical_packing", words_of<closures::CriticalPackings>(),
                        of(&Model::critical_packing),
                        "With shear_dilatancy: contact.critical_solid_fraction at any rate of shear, or less "
                        "the faster, by inertia and viscosity (Boyer et al. 2011)."),
                 R"("constant")"),
      came_later(key(parts::packing, "model.dilatancy_friction", "", any, of(&Model::dilatancy_friction),
                     "With shear_dilatancy: the tangent of the dilatancy angle adds to friction (Pailha and "
                     "Pouliquen 2009); without it dilatancy acts by pressure alone (Montella et al. 2021)."),
                 "true"),
      came_later(key(parts::viscous_contacts, "model.viscous_contact_pressure", "", any,
                     of(&Model::viscous_contact_pressure),
                     "Pressure of grains that a viscous liquid shears past each other (Boyer et al. 2011)."),
                 "false"),
      came_later(key(parts::viscous_contacts, "model.suspension_viscosity", "", any,
                     of(&Model::suspension_viscosity),
                     "The liquid's viscosity grows with the solid fraction (Boyer et al. 2011)."),
                 "false"),
      came_later(key(parts::kinetic_stress, "model.frictional_restitution", "", any,
                     of(&Model::frictional_restitution),
                     "e0 less what solid.friction takes in collisions (Chialvo and Sundaresan 2013)."),
                 "false"),
      came_later(
          key(parts::friction, "model.agitation_drag", "", any, of(&Model::agitation_drag),
              "Drag on the agitation of grains that shear past each other, as friction (da Cruz et al. "
              "2005)."),
          "false"),
      key(parts::grains_transport, "model.colour", "", any, of(&Model::colour), "Colour of the solid, (25)."),
  };
}

}  // namespace granvof::case_file
