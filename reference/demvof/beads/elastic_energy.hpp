// Energy stored in the contacts of the beads.
#pragma once

#include <optional>
#include <vector>

#include "reference/demvof/beads/bead_settings.hpp"

namespace demvof {

struct ElasticEnergy {
  double beads = 0.0;  // of bead on bead, frozen ones included [J]
  double walls = 0.0;  // of bead on plane, obstacle and the gate's plate [J]
};

// 8/15 Y* sqrt(R*) delta^{5/2} of each Hertz contact with overlap delta, Y* = Y / (2 (1 - nu^2)), R* = d/4
// between beads and d/2 at a plane, edge or corner (Landau & Lifshitz, Theory of Elasticity, sec. 9). The
// tangential springs are left out: with Coulomb's limit they hold at most mu^2 5 (2 - nu) / (12 (1 - nu)) of
// the normal ones, a sixth at mu = 0.4. `mobile`, `frozen`: three numbers a bead [m]; `gate_edge`: lower edge
// of the plate over the floor, none without one [m].
ElasticEnergy elastic_energy(const BeadSettings& settings, const std::vector<double>& mobile,
                             const std::vector<double>& frozen, std::optional<double> gate_edge);

}  // namespace demvof
