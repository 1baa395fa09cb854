// The solid fraction at which grains touch, that model.packing chooses from. The first is the paper's. Each
// has
//   is_carried: it is a field that grains take along, and a bed starts at rest,
//   at_start(bears, Contact) -> [-] of a bed, with bears() -> [-] that at which (13) bears what lies on it.
// Equations: docs/theory/contact.md.
#pragma once

#include "solver/closures/packing/carried.hpp"
#include "solver/closures/packing/uniform.hpp"
#include "solver/model/laws.hpp"

namespace granvof::closures {

struct Packings : Choices<PackingUniform, PackingCarried> {};

inline bool is_carried(Packing chosen) {
  return chosen.with([](auto law) { return law.is_carried; });
}

}  // namespace granvof::closures
