// The files that LIGGGHTS reads: beads (read_data), the gate and the obstacles (STL).
#pragma once

#include <string>

#include "reference/demvof/beads/bead_settings.hpp"

namespace demvof {

// Box in which LIGGGHTS works: the tank, with room for half-sunk floor beads and for a raised gate.
inline constexpr int bead_types = 5;
struct WorkBox {
  Vector lower{}, upper{};
};
WorkBox work_box(const BeadSettings& settings);

// Types: 1 mobile bead, 2 frozen bead, 3 walls, 4 the gate's plate, 5 obstacles. Identifiers count from 1,
// mobile beads first. Throws std::runtime_error if the file cannot be written.
void write_beads(const std::string& path, const BeadSettings& settings, const BeadState& mobile,
                 const std::vector<double>& frozen_positions);
void write_gate(const std::string& path, const BeadSettings& settings);
// The faces between obstacles and the rest of the tank.
void write_obstacles(const std::string& path, const BeadSettings& settings);

}  // namespace demvof
