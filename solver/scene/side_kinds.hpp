// The kinds of sides by name: the one table of what a case file, a picture and a message call them.
#pragma once

#include <array>
#include <cstddef>

#include "solver/scene/scene.hpp"

namespace granvof {

struct SideKindFacts {
  SideKind kind;
  const char* name;
  bool by_word = false;   // `walls.SIDE = "name"` says all of it; else what is said of a side makes it one
  bool top_only = false;  // no other side may be one
};

inline constexpr std::array side_kinds{
    SideKindFacts{SideKind::wall, "wall"},
    SideKindFacts{SideKind::open, "open", true, true},
    SideKindFacts{SideKind::periodic, "periodic", true},
    SideKindFacts{SideKind::inlet, "inlet"},
    SideKindFacts{SideKind::outlet, "outlet"},
};

constexpr const SideKindFacts& facts_of(SideKind kind) {
  std::size_t at = 0;
  while (side_kinds.at(at).kind != kind) ++at;
  return side_kinds[at];
}

}  // namespace granvof
