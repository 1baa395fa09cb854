// CICSAM: the share of liquid that a face's flux carries (Ubbink & Issa, J. Comput. Phys. 153, 26-50, 1999).
#pragma once

#include <algorithm>
#include <cmath>

namespace granvof {

// alpha at the face from the upwind, donor and acceptor cells, in [0, 1].
// courant: outflow Courant number of the donor cell, >= 0. cosine_squared: square of the cosine between the
// interface normal in the donor cell and the face normal, in [0, 1].
// Hyper-C where the interface lies across the flow, Ultimate-Quickest where it lies along it, both in
// normalised variables; first-order upwind where the donor is an extremum.
inline double cicsam_face_value(double upwind, double donor, double acceptor, double courant,
                                double cosine_squared) {
  const double range = acceptor - upwind;
  if (std::fabs(range) < 1e-12) return donor;
  const double norm = (donor - upwind) / range;
  if (norm <= 0.0 || norm >= 1.0) return donor;
  const double hyper_c = courant > 0.0 ? std::min(1.0, norm / courant) : 1.0;
  const double quickest = (8.0 * courant * norm + (1.0 - courant) * (6.0 * norm + 3.0)) / 8.0;
  const double ultimate_quickest = std::min(quickest, hyper_c);
  // cos(2 theta) = 2 cos^2 - 1, so (cos(2 theta) + 1) / 2 = cos^2
  const double blend = std::min(cosine_squared, 1.0);
  const double face = blend * hyper_c + (1.0 - blend) * ultimate_quickest;
  return std::clamp(upwind + face * range, 0.0, 1.0);
}

}  // namespace granvof
