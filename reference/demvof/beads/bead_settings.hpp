// What the bead side needs to know: the tank, the beads and their contacts, in SI units.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace demvof {

using Vector = std::array<double, 3>;  // as in fluid/fluid.hpp

// Hertz contact with tangential history (Coulomb-limited), as LIGGGHTS has it. Every parameter is that of the
// material: beads of any size have the same overlap over diameter under the same stress, and the same packing
// and friction at rest (coarse-grained beads: Bierwisch et al., J. Mech. Phys. Solids 57, 2009).
struct ContactLaw {
  double young = 5e6;              // [Pa], >= 5e6 (LIGGGHTS refuses less in SI units)
  double poisson = 0.3;            // [-]
  double restitution = 0.9;        // [-], in (0, 1]
  double bead_friction = 0.4;      // bead on bead [-]
  double rolling_friction = 0.0;   // bead on bead, epsd2 model [-]; 0 leaves the model out
  double wall_friction = 0.4;      // bead on wall [-]
  double gate_friction = 0.4;      // bead on the gate's plate [-]
  double obstacle_friction = 0.4;  // bead on obstacles [-]
};

// Obstacles: cells of a grid over the tank that no bead enters, one at least as wide as a bead.
struct Obstacles {
  std::array<int, 3> cells{1, 1, 1};  // cells[2] = 1: through the whole depth
  Vector spacing{};                   // [m]
  std::vector<char> closed;  // 1 in their cells, cell (i, j, k) at (k ny + j) nx + i; empty without obstacles
  // Not beyond the tank's sides.
  bool fill(const std::array<int, 3>& cell) const {
    for (std::size_t d = 0; d < 3; ++d)
      if (cell[d] < 0 || cell[d] >= cells[d]) return false;
    return !closed.empty() && closed[index(cell)] != 0;
  }
  std::size_t index(const std::array<int, 3>& cell) const {
    std::size_t at = 0;
    for (std::size_t d = 3; d-- > 0;)
      at = at * static_cast<std::size_t>(cells[d]) + static_cast<std::size_t>(cell[d]);
    return at;
  }
};

struct BeadSettings {
  Vector tank{};                 // inner size [m]; y is up
  bool periodic_depth = true;    // z joined to itself; otherwise walls at 0 and tank[2]
  bool periodic_length = false;  // x likewise
  double diameter = 0.0;         // [m]
  double density = 0.0;          // [kg/m3]
  ContactLaw law;
  double dt = 1e-5;            // [s]
  double gravity = 9.81;       // along -y of a level tank [m/s2]; negative pulls up
  double inclination = 0.0;    // of the floor, down towards +x [degrees]
  std::optional<double> gate;  // x of a vertical plate over the whole depth [m]
  double gate_height = 0.0;    // upper edge of the plate at the start [m]
  Obstacles obstacles;
  std::string scratch_folder;  // for the files that LIGGGHTS reads
};

// Positions and velocities, three numbers a bead: x, y, z of bead 0, of bead 1, ...
struct BeadState {
  std::vector<double> position;  // [m]
  std::vector<double> velocity;  // [m/s]
  std::size_t count() const { return position.size() / 3; }
};

}  // namespace demvof
