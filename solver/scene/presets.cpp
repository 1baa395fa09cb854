#include "solver/scene/presets.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "solver/scene/complete.hpp"
#include "solver/scene/keys.hpp"

namespace granvof::case_file {

const std::vector<PresetEntry>& presets() {
  static const std::vector<PresetEntry> list{
      {Preset::advised, "advised",
       "For use: the paper's model, what a bed at rest needs to stay there, and what grains in air lose."},
      {Preset::paper, "paper", "The paper's model and schemes, nothing beside them."},
      {Preset::sourced, "sourced",
       "All choices that the grains of DEM-VOF, or the literature, give a reason for under water; nothing "
       "fitted."},
  };
  return list;
}

const std::vector<Choice>& choices() {
  static const std::vector<Choice> list{
      {.key = "numerics.solid_flux",
       .advised = "compressive",
       .sourced = "compressive",
       .reason =
           "Second order, bounded; the steepest flux of f_s (superbee, Roe 1985) keeps the bed's surface "
           "sharp, which upwind smears over three or four cells that run on as a density current."},
      {.key = "numerics.solid_convection",
       .advised = "mass-consistent",
       .sourced = "mass-consistent",
       .reason = "Conserves momentum with mass (Rudman 1998), so that grains fall freely as they should."},
      {.key = "numerics.fluid_convection",
       .advised = "mass-consistent",
       .sourced = "mass-consistent",
       .reason =
           "Conserves momentum with mass (Rudman 1998): by its own speed a face that liquid reaches in a "
           "gas holds it up, on every grid."},
      {.key = "numerics.bed_surface",
       .advised = "part-cells",
       .sourced = "part-cells",
       .reason =
           "Own: grains of partly filled cells bear their weight and rub by it; in whole-cells they slide as "
           "if they had no contacts, and a heap at rest drains."},
      {.key = "model.packing",
       .advised = "carried",
       .sourced = "carried",
       .reason = "Own: a bed rests at the solid fraction it was prepared at. With one packing for all it "
                 "springs apart or sinks until (13) bears its weight, and light grains are lifted off the "
                 "slope."},
      {.key = "model.friction_law",
       .advised = "inertial",
       .sourced = "inertial",
       .reason = "Friction grows with the rate of shear, from solid.friction at rest (Jop et al. 2006)."},
      {.key = "model.whole_stress_friction",
       .reason = "Own: mu(I) is a law of the whole stress, and chutes run as it has them; else the kinetic "
                 "stress comes on top, and they are too slow."},
      {.key = "model.shear_dilatancy",
       .sourced = true,
       .reason = "The packing at which grains touch follows shear: a dense bed starts at rest, and sucks "
                 "(Pailha and Pouliquen 2009)."},
      {.key = "model.thin_layer_arrest",
       .sourced = true,
       .reason = "Thin layers stop on a rough floor at slopes that thick ones run down (Pouliquen 1999)."},
      {.key = "model.agitation_drag",
       .sourced = true,
       .reason =
           "The fluid drags on the agitation of sheared grains too, 5 to 10 % of what DEM-VOF's beads lose "
           "(scaling of da Cruz et al. 2005)."},
      {.key = "model.drag_law",
       .reason = "Without the jump of (8) at f_s 0.2, for suspensions (Di Felice 1994; Beetstra et al. 2007; "
                 "Tenneti et "
                 "al. 2011). DEM-VOF takes the same law, and its records are of the paper's."},
      {.key = "model.frictional_restitution",
       .advised = true,
       .sourced = true,
       .reason =
           "Friction takes from collisions too (Chialvo and Sundaresan 2013): for grains in air; under water "
           "collisions are damped, and it does nothing."},
      {.key = "model.radial_distribution",
       .reason =
           "Collisions of dense smooth grains as DEM has them: (19) is three times too stiff in a dense "
           "core (Chialvo and Sundaresan 2013)."},
      {.key = "model.kinetic_transport",
       .advised = "with-streaming",
       .sourced = "with-streaming",
       .reason = "Dilute grains carry momentum and heat as they fly, which (20) and (22) leave out (Syamlal "
                 "et al. 1993): without it nothing stops a toe of few grains in air."},
      {.key = "model.correlated_collisions",
       .reason =
           "Dense grains of low restitution dissipate less than chance collisions would (Jenkins 2007)."},
      {.key = "model.critical_packing",
       .reason = "For grains in viscous liquids: the faster the shear, the looser the packing it drives to "
                 "(Boyer et al. 2011)."},
      {.key = "model.dilatancy_friction",
       .reason =
           "Without it dilatancy acts by the pressure of contacts and pores alone, as where its slope is "
           "large (Montella et al. 2021)."},
      {.key = "model.viscous_contact_pressure",
       .reason = "For grains in viscous liquids: a suspension that is sheared presses (Boyer et al. 2011)."},
      {.key = "model.suspension_viscosity",
       .reason =
           "For grains in viscous liquids: the liquid between dense grains is sheared more than they are "
           "(Boyer et al. 2011)."},
      {.key = "numerics.interface_scheme",
       .reason = "Beside the paper's flux of alpha: planes in the cells (Youngs 1982), or first order."},
      {.key = "numerics.contact_pressure",
       .reason = "The explicit one is there to compare with: its steps follow the elastic waves."},
  };
  return list;
}

const std::optional<Value>& Choice::value(Preset preset) const {
  static const std::optional<Value> none;
  switch (preset) {
    case Preset::advised:
      return advised;
    case Preset::sourced:
      return sourced;
    case Preset::paper:
      break;
  }
  return none;
}

std::string word_of(Preset preset) {
  return std::ranges::find(presets(), preset, &PresetEntry::preset)->word;
}

const Choice* find_choice(std::string_view key) {
  const auto found = std::ranges::find(choices(), key, &Choice::key);
  return found == choices().end() ? nullptr : &*found;
}

bool set_by_a_preset(std::string_view key) {
  const Choice* choice = find_choice(key);
  return choice && std::ranges::any_of(presets(), [&](const PresetEntry& entry) {
           return choice->value(entry.preset).has_value();
         });
}

std::string text_under(const Choice& choice, Preset preset) {
  Draft draft;
  const Key& key = *find_key(choice.key);
  if (const auto& value = choice.value(preset)) key.set(draft, *value);
  return key.get(draft);
}

void apply_preset(Draft& draft) {
  for (const Choice& choice : choices()) {
    if (const auto& value = choice.value(draft.preset)) find_key(choice.key)->set(draft, *value);
  }
}

namespace {

// The preset that a layer names; none where it names none, or none that there is.
std::optional<Preset> preset_of_layer(const CaseText& text, int layer) {
  for (const Entry& entry : text.stated("model.preset")) {
    if (entry.layer != layer) continue;
    const auto* word = std::get_if<std::string>(&entry.value);
    const auto found =
        std::ranges::find_if(presets(), [&](const PresetEntry& p) { return word && p.word == *word; });
    return found == presets().end() ? std::nullopt : std::optional(found->preset);
  }
  return std::nullopt;
}

}  // namespace

bool gives_way_to_a_preset(const CaseText& text, const std::string& key) {
  const Choice* choice = find_choice(key);
  const auto last = text.entries.find("model.preset");
  if (!choice || last == text.entries.end()) return false;
  const Entry& entry = text.entries.at(key);
  if (entry.layer >= last->second.layer) return false;
  const auto beside = preset_of_layer(text, entry.layer);
  Draft draft;
  return beside && find_key(key)->set(draft, entry.value) &&
         find_key(key)->get(draft) == text_under(*choice, *beside);
}

std::vector<ChoiceOfScene> choices_of(const Scene& scene) {
  Faults faults;
  const Draft draft = read_draft(read_case_text(scene.resolved, scene.name, {}), faults);
  faults.throw_if_any();
  std::vector<ChoiceOfScene> all;
  for (const Choice& choice : choices()) {
    const Key& key = *find_key(choice.key);
    std::vector<std::string> values = key.table() == "model" ? key.words : std::vector<std::string>{};
    for (const PresetEntry& entry : presets()) values.push_back(text_under(choice, entry.preset));
    ChoiceOfScene one{choice.key, key.get(draft), {}, choice.reason};
    for (const std::string& value : values) {
      if (value != one.now && std::ranges::find(one.others, value) == one.others.end())
        one.others.push_back(value);
    }
    all.push_back(std::move(one));
  }
  return all;
}

std::string presets_reference() {
  std::string page = "\n## Presets: model.preset\n";
  for (const PresetEntry& entry : presets()) {
    page += fmt::format("- \"{}\"{}: {}\n", entry.word,
                        entry.preset == default_preset ? " (the default)" : "", entry.about);
  }
  page +=
      "\nSingle keys go on top, in whichever of the case's files or overrides they stand; of presets the "
      "last holds. A "
      "key that only repeats the preset beside it gives way to a preset of a later layer. A dash: as in the "
      "paper.\n\n";
  std::string rule = "|---|";
  page += "| key |";
  for (const PresetEntry& entry : presets()) {
    page += fmt::format(" {} |", entry.word);
    rule += "---|";
  }
  page += " why |\n" + rule + "---|\n";
  for (const Choice& choice : choices()) {
    page += fmt::format("| {} |", choice.key);
    for (const PresetEntry& entry : presets()) {
      const bool own = choice.value(entry.preset).has_value() || entry.preset == Preset::paper;
      page += fmt::format(" {} |", own ? text_under(choice, entry.preset) : "-");
    }
    page += fmt::format(" {} |\n", choice.reason);
  }
  return page;
}

}  // namespace granvof::case_file
