// Energy in the terms that granvof and demvof count alike, from the columns that each writes.
//
// What the continuum calls friction and collisions, and the work of its contact pressures, are for beads one
// loss between grains; what sides and the gate's plate take is net of what moves them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compare/input/run.hpp"

namespace granvof::compare {

// "released", "motion", "agitation", "elastic", "contacts", "walls", "drag", "viscosity", "numerics".
std::vector<std::string_view> shared_terms();

// The change of a term since the first row [J] against t [s]; empty for a run without an energy ledger or a
// term that there is not. Stored energy counts as it grows, losses as they are lost.
Curve shared_term(const Run& run, std::string_view term);

// What a term takes of the potential energy that is released between two times [s]: [-]; nothing where none
// is, or where the run does not cover them.
std::optional<double> share_of_released(const Run& run, std::string_view term, Window times);

// What a term takes between two times [s], a second and a volume of the tank: [W/m3]; nothing where the run
// does not cover them.
std::optional<double> power_of(const Run& run, std::string_view term, Window times);

}  // namespace granvof::compare
