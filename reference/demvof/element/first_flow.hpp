// Friction of beads that have not yet flowed: of a random packing at rest, and in its first strain.
#pragma once

#include <optional>
#include <vector>

#include "reference/demvof/bulk_friction/chute.hpp"

namespace demvof {

struct FirstFlow {
  std::optional<double> started_at;  // first slope at whose end the layer flows [degrees]
  std::vector<ChutePoint> points;    // windows after that, on `first_slope`; momentum as on the chute
  std::vector<double> strain;        // of each since the layer was prepared [-]
};

inline constexpr double first_slope = 26.0;  // [degrees]
// Between the breaking of the packing and what a collapse strains, its run-out over its height [-].
inline constexpr double least_strain = 0.3, largest_strain = 6.0;

// A layer that settles as a column is prepared is tilted from rest, half a degree at a time, until it flows,
// then to `first_slope`. It has not the friction of long flow: on a chute, after a strain of a hundred, slow
// flow meets less, and stops at a lower slope than it starts at. What a collapse strains is this. Throws as
// packing_at_rest.
FirstFlow first_flow(LayerSettings settings, const ContactLaw& preparation);

}  // namespace demvof
