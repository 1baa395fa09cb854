#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "solver/scene/completion.hpp"
#include "solver/scene/side_kinds.hpp"
#include "solver/scene/side_names.hpp"

namespace granvof::case_file {
namespace {

// What a wall says of itself beside its word.
constexpr std::array<const char*, 6> wall_parts{".fluid",    ".solid",     ".solid_friction",
                                                ".velocity", ".bumpiness", ".bump_restitution"};

std::string side_key(int side) {
  return "walls." + std::string(side_names[side]);
}

bool closed(const std::optional<SideWord>& word) {
  return !word || word->kind == SideKind::wall;
}

// A word for a whole side that is not closed leaves no room for parts, unless they say all that a wall is.
void check_parts(const Completion& c, int side, const std::string& of, const std::optional<SideWord>& word) {
  const SideInput& input = c.d.sides[side];
  if (closed(word) || (input.fluid && input.solid)) return;
  const std::string allowed =
      fmt::format(R"(nothing beside {} = "{}"; a wall there needs both {}.fluid and {}.solid)", of,
                  facts_of(word->kind).name, side_key(side), side_key(side));
  for (const char* part : wall_parts) {
    if (c.given(side_key(side) + part)) c.refuse(side_key(side) + part, allowed);
  }
}

// The words that are left where one is for the top alone.
void check_top_only(const Completion& c, int side) {
  const std::optional<SideWord>& word = c.d.sides[side].word;
  if (side == top || !word || !facts_of(word->kind).top_only) return;
  std::string allowed = R"("no-slip" | "slip")";
  for (const SideKindFacts& kind : side_kinds)
    if (kind.by_word && !kind.top_only) allowed += fmt::format(R"( | "{}")", kind.name);
  c.refuse(side_key(side), fmt::format("{}; only walls.top may be {}", allowed, facts_of(word->kind).name));
}

void check_side(const Completion& c, int side) {
  const std::string name = side_key(side);
  const SideInput& input = c.d.sides[side];
  if (side == front || side == back) {
    c.only_in_3d(name);
    for (const char* part : wall_parts) c.only_in_3d(name + part);
    for (const char* part :
         {".inflow", ".inflow_solid_fraction", ".inflow_liquid_share", ".outflow_pressure", ".outflow_level"})
      c.only_in_3d(name + part);
  }
  check_top_only(c, side);
  check_parts(c, side, name, input.word);
  if (input.velocity.empty()) return;
  c.components(name + ".velocity", input.velocity);
  if (side == side_all || input.velocity[side / 2] != 0.0) {
    c.refuse(name + ".velocity", "a velocity in the plane of one side, its normal component 0");
  }
}

void check_friction(const Completion& c, int side, bool coulomb) {
  const std::string key = side_key(side) + ".solid_friction";
  if (coulomb && !c.d.sides[side].solid_friction) {
    c.refuse(key, "a number >= 0, required with solid = \"coulomb\"");
  }
  if (!coulomb && c.d.sides[side].solid_friction) c.refuse(key, "only with solid = \"coulomb\"");
}

void check_bumps(const Completion& c, int side, bool bumpy) {
  const SideInput& input = c.d.sides[side];
  if (bumpy && !input.bumpiness)
    c.refuse(side_key(side) + ".bumpiness", "a number in (0, 90], required with solid = \"bumpy\"");
  if (!bumpy && input.bumpiness) c.refuse(side_key(side) + ".bumpiness", "only with solid = \"bumpy\"");
  if (!bumpy && input.bump_restitution)
    c.refuse(side_key(side) + ".bump_restitution", "only with solid = \"bumpy\"");
}

// What a side does not say itself, by part or by word, walls.all says.
void inherit(SideInput& own, const SideInput& all) {
  const auto part = [](const std::optional<WallKind>& kind, const std::optional<SideWord>& word) {
    return kind || !word ? kind : std::optional(word->wall);
  };
  const bool by_all = !own.solid && !own.word;
  own.fluid = part(own.fluid, own.word);
  own.solid = part(own.solid, own.word);
  own.fluid = own.fluid ? own.fluid : part(all.fluid, all.word).value_or(WallKind::no_slip);
  own.solid = own.solid ? own.solid : part(all.solid, all.word).value_or(WallKind::no_slip);
  if (!own.solid_friction && (by_all || own.solid == WallKind::coulomb))
    own.solid_friction = all.solid_friction;
  if (own.solid == WallKind::bumpy) {
    if (!own.bumpiness) own.bumpiness = all.bumpiness;
    if (!own.bump_restitution) own.bump_restitution = all.bump_restitution;
  }
  own.word.reset();
}

bool flows(const SideInput& side) {
  return side.inflow || side.outflow_pressure;
}

// An inlet or an outlet is that alone.
void check_flow(const Completion& c, int side) {
  const std::string name = side_key(side);
  const SideInput& input = c.d.sides[side];
  if (side == side_all && flows(input)) {
    c.refuse(name + (input.inflow ? ".inflow" : ".outflow_pressure"), "an inlet or an outlet of one side");
  }
  if (input.inflow && input.outflow_pressure)
    c.refuse(name + ".outflow_pressure", "nothing beside " + name + ".inflow: an inlet or an outlet");
  for (const char* part : {".inflow_solid_fraction", ".inflow_liquid_share"})
    if (c.given(name + part) && !input.inflow) c.refuse(name + part, "only with " + name + ".inflow");
  if (c.given(name + ".outflow_level") && !input.outflow_pressure)
    c.refuse(name + ".outflow_level", "only with " + name + ".outflow_pressure");
  if (!flows(input)) return;
  const auto alone = [&](const std::string& key) {
    if (c.given(key))
      c.refuse(key, "nothing beside " + name + (input.inflow ? ".inflow" : ".outflow_pressure"));
  };
  alone(name);
  for (const char* part : wall_parts) alone(name + part);
}

void fill_inlet(const Completion& c, int side) {
  SideInput own;
  const SideInput& input = c.d.sides[side];
  own.inflow = input.inflow;
  own.inflow_solid_fraction = input.inflow_solid_fraction.value_or(0.0);
  own.inflow_liquid_share = input.inflow_liquid_share.value_or(c.has("liquid") ? 1.0 : 0.0);
  if (*own.inflow_liquid_share > 0.0 && !c.has("liquid"))
    c.refuse(side_key(side) + ".inflow_liquid_share", "0: the case has no [liquid]");
  if (*own.inflow_solid_fraction > 0.0 && !c.has("solid"))
    c.refuse(side_key(side) + ".inflow_solid_fraction", "0: the case has no [solid]");
  if (*own.inflow_solid_fraction > c.s.contact.solid_fraction_max)
    c.refuse(side_key(side) + ".inflow_solid_fraction",
             fmt::format("at most contact.solid_fraction_max = {}", c.s.contact.solid_fraction_max));
  c.s.sides[side].kind = SideKind::inlet;
  c.s.sides[side].inflow = {*own.inflow, *own.inflow_solid_fraction, *own.inflow_liquid_share};
  c.d.sides[side] = own;
}

void fill_outlet(const Completion& c, int side) {
  SideInput own;
  const SideInput& input = c.d.sides[side];
  own.outflow_pressure = input.outflow_pressure;
  own.outflow_level = input.outflow_level.value_or(c.d.level.value_or(0.0));
  if (c.outside(0.0, *own.outflow_level, 1))
    c.refuse(side_key(side) + ".outflow_level", fmt::format("at most the tank's height {} m", c.s.tank[1]));
  if (*own.outflow_level > 0.0 && !c.has("liquid"))
    c.refuse(side_key(side) + ".outflow_level", "0: the case has no [liquid]");
  c.s.sides[side].kind = SideKind::outlet;
  c.s.sides[side].outflow = {*own.outflow_pressure, *own.outflow_level};
  c.d.sides[side] = own;
}

// What comes in has to leave.
void check_way_out(const Completion& c, int side) {
  if (c.s.sides[side].kind != SideKind::inlet) return;
  for (const Side& other : c.s.sides)
    if (other.kind == SideKind::outlet || other.kind == SideKind::open) return;
  c.refuse(side_key(side) + ".inflow",
           "a way out beside it: an outlet (outflow_pressure), or walls.top = \"open\"");
}

// Copies a side into the scene and states it in full in the draft.
void fill_side(const Completion& c, int side) {
  Side& to = c.s.sides[side];
  SideInput& input = c.d.sides[side];
  const SideInput& all = c.d.sides[side_all];
  if (c.flat() && side >= front) {
    to.fluid.kind = to.solid.kind = WallKind::slip;
    input = {};
    return;
  }
  if (flows(input)) return input.inflow ? fill_inlet(c, side) : fill_outlet(c, side);
  const std::optional<SideWord> word = input.word               ? input.word
                                       : all.fluid && all.solid ? std::nullopt
                                                                : all.word;
  if (!input.word) check_parts(c, side, side_key(side_all), word);
  if (!closed(word) && !(input.fluid && input.solid)) {
    to.kind = word->kind;
    input = {};
    input.word = word;
    return;
  }
  inherit(input, all);
  check_friction(c, side, input.solid == WallKind::coulomb);
  check_bumps(c, side, input.solid == WallKind::bumpy);
  if (input.solid == WallKind::bumpy)
    input.bump_restitution = input.bump_restitution.value_or(c.s.solid.restitution);
  if (!input.velocity.empty() && input.fluid == WallKind::slip && input.solid == WallKind::slip) {
    c.refuse(side_key(side) + ".velocity", "only where a phase feels it: fluid or solid not \"slip\"");
  }
  to.fluid.kind = *input.fluid;
  to.solid = {*input.solid, input.solid_friction.value_or(0.0), input.bumpiness.value_or(0.0),
              input.bump_restitution.value_or(0.0)};
  std::copy(input.velocity.begin(), input.velocity.end(), to.velocity.begin());
}

void check_period(const Completion& c, int side) {
  if (c.s.sides[side].kind != SideKind::periodic) return;
  if (c.s.sides[side ^ 1].kind != SideKind::periodic) {
    c.refuse(side_key(side),
             fmt::format(R"("periodic" only together with {} = "periodic")", side_key(side ^ 1)));
  }
  if (side / 2 == 1 && c.s.gravity != 0.0) {
    c.refuse(side_key(side),
             "\"periodic\" along gravity only with tank.gravity = 0: all would fall for ever");
  }
}

}  // namespace

void complete_walls(Completion& c) {
  for (int side = 0; side <= side_all; ++side) {
    c.rule({"scene.dimensions", side_key(side)}, [&] {
      check_side(c, side);
      check_flow(c, side);
    });
  }
  c.rule({"walls.all"}, [&] {
    const SideInput& all = c.d.sides[side_all];
    check_friction(c, side_all, all.solid == WallKind::coulomb);
    check_bumps(c, side_all, all.solid == WallKind::bumpy);
  });
  for (int side = 0; side < side_all; ++side) {
    c.rule({"scene.dimensions", "tank", "contact.solid_fraction_max", "liquid.level", side_key(side),
            "walls.all"},
           [&] { fill_side(c, side); });
  }
  c.d.sides[side_all] = {};  // every side now says it for itself
  for (int side = 0; side < side_all; ++side) {
    c.rule({"scene.dimensions", side_key(side), side_key(side ^ 1), "walls.all", "tank.gravity"},
           [&] { check_period(c, side); });
    c.rule({"walls"}, [&] { check_way_out(c, side); });
  }
}

}  // namespace granvof::case_file
