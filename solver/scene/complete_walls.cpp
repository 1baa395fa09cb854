#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "solver/scene/completion.hpp"
#include "solver/scene/side_names.hpp"

namespace granvof::case_file {
namespace {

std::string side_key(int side) {
  return "walls." + std::string(side_names[side]);
}

WallKind kind_of(SideWord word) {
  return word == SideWord::slip ? WallKind::slip : WallKind::no_slip;
}

bool closed(const std::optional<SideWord>& word) {
  return word != SideWord::open && word != SideWord::periodic;
}

// A word for a whole side that is not closed leaves no room for parts, unless they say all that a wall is.
void check_parts(const Completion& c, int side, const std::string& of, const std::optional<SideWord>& word) {
  const SideInput& input = c.d.sides[side];
  if (closed(word) || (input.fluid && input.solid)) return;
  const std::string allowed =
      fmt::format("nothing beside {} = {}; a wall there needs both {}.fluid and {}.solid", of,
                  word == SideWord::open ? "\"open\"" : "\"periodic\"", side_key(side), side_key(side));
  for (const char* part : {".fluid", ".solid", ".solid_friction", ".velocity"}) {
    if (c.given(side_key(side) + part)) c.refuse(side_key(side) + part, allowed);
  }
}

void check_side(const Completion& c, int side) {
  const std::string name = side_key(side);
  const SideInput& input = c.d.sides[side];
  if (side == front || side == back) {
    for (const char* part : {"", ".fluid", ".solid", ".solid_friction", ".velocity"})
      c.only_in_3d(name + part);
  }
  if (input.word == SideWord::open && side != top) {
    c.refuse(name, R"("no-slip" | "slip" | "periodic"; only walls.top may be open)");
  }
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

// What a side does not say itself, by part or by word, walls.all says.
void inherit(SideInput& own, const SideInput& all) {
  const auto part = [](const std::optional<WallKind>& kind, const std::optional<SideWord>& word) {
    return kind || !word ? kind : std::optional(kind_of(*word));
  };
  const bool by_all = !own.solid && !own.word;
  own.fluid = part(own.fluid, own.word);
  own.solid = part(own.solid, own.word);
  own.fluid = own.fluid ? own.fluid : part(all.fluid, all.word).value_or(WallKind::no_slip);
  own.solid = own.solid ? own.solid : part(all.solid, all.word).value_or(WallKind::no_slip);
  if (!own.solid_friction && (by_all || own.solid == WallKind::coulomb))
    own.solid_friction = all.solid_friction;
  own.word.reset();
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
  const std::optional<SideWord> word = input.word               ? input.word
                                       : all.fluid && all.solid ? std::nullopt
                                                                : all.word;
  if (!input.word) check_parts(c, side, side_key(side_all), word);
  if (!closed(word) && !(input.fluid && input.solid)) {
    to.kind = word == SideWord::open ? SideKind::open : SideKind::periodic;
    input = {};
    input.word = word;
    return;
  }
  inherit(input, all);
  check_friction(c, side, input.solid == WallKind::coulomb);
  if (!input.velocity.empty() && input.fluid == WallKind::slip && input.solid == WallKind::slip) {
    c.refuse(side_key(side) + ".velocity", "only where a phase feels it: fluid or solid not \"slip\"");
  }
  to.fluid.kind = *input.fluid;
  to.solid = {*input.solid, input.solid_friction.value_or(0.0)};
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
    c.rule({"scene.dimensions", side_key(side)}, [&] { check_side(c, side); });
  }
  c.rule({"walls.all"}, [&] { check_friction(c, side_all, c.d.sides[side_all].solid == WallKind::coulomb); });
  for (int side = 0; side < side_all; ++side) {
    c.rule({"scene.dimensions", side_key(side), "walls.all"}, [&] { fill_side(c, side); });
  }
  c.d.sides[side_all] = {};  // every side now says it for itself
  for (int side = 0; side < side_all; ++side) {
    c.rule({"scene.dimensions", side_key(side), side_key(side ^ 1), "walls.all", "tank.gravity"},
           [&] { check_period(c, side); });
  }
}

}  // namespace granvof::case_file
