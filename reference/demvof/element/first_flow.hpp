// Friction of beads that have not yet flowed: of a random packing at rest, and in its first strain.
#pragma once

#include <optional>
#include <vector>

#include "reference/demvof/bulk_friction/chute.hpp"

namespace demvof {

struct FirstFlow {
  std::optional<double> started_at;  // first slope at whose end the layer flows [degrees]
  std::vector<ChutePoint> points;    // windows after that; momentum as on the chute
  std::vector<double> strain;        // of each since the layer was prepared [-]
};

inline constexpr double first_slope = 26.0;  // [degrees]
// Between the breaking of the packing and what a collapse strains, its run-out over its height [-].
inline constexpr double least_strain = 0.3, largest_strain = 6.0;

// A layer that settles as a column is prepared is tilted from rest, half a degree at a time, until it flows,
// then to `first_slope`, and after `largest_strain` to 34 degrees until I = 0.6. In long slow flow on a chute
// beads of one size may slide into layers, which then pass each other with less friction and stop at a lower
// slope; it depends on the seed and on how slowly the slope is lowered. A collapse strains too little for
// that. Throws as packing_at_rest.
FirstFlow first_flow(LayerSettings settings, const ContactLaw& preparation);

}  // namespace demvof
