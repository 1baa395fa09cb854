#include "solver/scene/keys_of_sides.hpp"

#include "solver/scene/key_types.hpp"
#include "solver/scene/side_kinds.hpp"
#include "solver/scene/side_names.hpp"

namespace granvof::case_file {

std::vector<Key> side_keys(int side) {
  Words<SideWord> side_words{{"no-slip", {}}, {"slip", {.wall = WallKind::slip}}};
  for (const SideKindFacts& kind : side_kinds)
    if (kind.by_word) side_words.emplace_back(kind.name, SideWord{.kind = kind.kind});
  const Words<WallKind> fluid_words{{"no-slip", WallKind::no_slip}, {"slip", WallKind::slip}};
  const Words<WallKind> solid_words{{"no-slip", WallKind::no_slip},
                                    {"slip", WallKind::slip},
                                    {"coulomb", WallKind::coulomb},
                                    {"bumpy", WallKind::bumpy}};
  const std::string name = "walls." + std::string(side_names[side]);
  const auto input = [side](auto member) {
    return [ side, member ](auto& draft) -> auto& {
      return draft.sides[static_cast<std::size_t>(side)].*member;
    };
  };
  std::vector<Key> list{
      otherwise(
          choice(
              name, side_words, input(&SideInput::word),
              "Both phases alike; \"open\" for the top only; \"periodic\" with its opposite. SIDE is left, "
              "right, bottom, top, front, back (the last two in 3D only), or all for the rest."),
          side == side_all ? "\"no-slip\"" : "walls.all"),
      otherwise(
          choice(name + ".fluid", fluid_words, input(&SideInput::fluid), "Gas and liquid at this side."),
          "the side's word, else walls.all"),
      otherwise(
          choice(name + ".solid", solid_words, input(&SideInput::solid),
                 "Grains at this side; \"coulomb\": tangential stress at most solid_friction times P_s; "
                 "\"bumpy\": grains are glued to it, and those that hit them slip and heat (Richman 1988)."),
          "the side's word, else walls.all"),
      key(name + ".solid_friction", "-", not_negative, input(&SideInput::solid_friction),
          "mu_w; with solid = \"coulomb\" only."),
      key(name + ".bumpiness", "degrees", Bounds{.lower = 0.0, .upper = 90.0, .lower_open = true},
          input(&SideInput::bumpiness),
          "Largest angle of a contact with a bump from the normal, sin = (d + gap) / 2d; with "
          "solid = \"bumpy\" only."),
      otherwise(key(name + ".bump_restitution", "-", share, input(&SideInput::bump_restitution),
                    "Of grains on those bumps; with solid = \"bumpy\" only."),
                "solid.restitution"),
      otherwise(
          key(name + ".velocity", "m/s", any, input(&SideInput::velocity), "Of the wall, in its own plane."),
          "at rest"),
      key(parts::inlet, name + ".inflow", "m/s", positive, input(&SideInput::inflow),
          "Makes the side an inlet: speed at which both phases come in. Not for all."),
      key(parts::inlet, name + ".inflow_solid_fraction", "-", share, input(&SideInput::inflow_solid_fraction),
          "Of what comes in; at 0 the grains of the tank find a closed wall there."),
      otherwise(key(parts::inlet, name + ".inflow_liquid_share", "-", share,
                    input(&SideInput::inflow_liquid_share), "alpha of what comes in."),
                "1 with a [liquid], else 0"),
      key(parts::outlet, name + ".outflow_pressure", "Pa", any, input(&SideInput::outflow_pressure),
          "Makes the side an outlet: P_c at its upper end, below it with the weight of fluid at "
          "rest. Grains leave, and none come in. Not for all."),
      otherwise(key(parts::outlet, name + ".outflow_level", "m", not_negative,
                    input(&SideInput::outflow_level), "Of the liquid beyond that outlet."),
                "liquid.level, else 0"),
  };
  for (Key& k : list) k.documented = side == 0;
  return list;
}

std::vector<Key> obstacle_keys() {
  const std::string each = "; of each [[obstacle]].";
  std::vector<Key> list;
  for (int axis = 0; axis < 3; ++axis) {
    const std::string name = std::string("obstacle.") + "xyz"[axis];
    const auto corner = [axis](auto side) {
      return [ axis, side ](auto& draft) -> auto& {
        return (draft.obstacles.*side)[static_cast<std::size_t>(axis)];
      };
    };
    Key lower = key(name + "0", "m", not_negative, corner(&ObstacleInput::lower), "Lower end" + each),
        upper = key(name + "1", "m", positive, corner(&ObstacleInput::upper),
                    "Upper end, on a face of cells as the lower" + each);
    if (axis == 2) {
      lower = otherwise(std::move(lower), "0 (3D only)");
      upper = otherwise(std::move(upper), "the tank's (3D only)");
    } else {
      lower = required(std::move(lower));
      upper = required(std::move(upper));
    }
    list.push_back(std::move(lower));
    list.push_back(std::move(upper));
  }
  return list;
}

}  // namespace granvof::case_file
