// What a side of the tank does to both phases: the answers that operators ask for.
//
// Each kind of side is one file beside this one, which fills in the answers; what it does not fill in is that
// of a closed side. An operator asks for an answer, never for the kind.
#pragma once

#include <functional>
#include <limits>
#include <optional>

#include "solver/scene/scene.hpp"

namespace granvof {

enum class Phase { fluid, solid };

// Of a velocity component c along the side: its ghosts are share * (the value inside) + shift[c]. No-slip: -1
// and twice the wall's velocity; no stress: 1 and 0.
struct Tangent {
  double share = 1.0;
  Vec3 shift{};  // [m/s]
};

struct SideRule {
  bool joined = false;  // to the opposite side: none of what follows is asked

  // The fluid passes at the pressure given on the side, and its velocity there is one of the unknowns; else
  // its velocity there is given.
  bool passes_fluid = false;
  // P_c on the side at a place on it [m] -> [Pa]; none: zero. Of sides that pass the fluid.
  std::function<double(const Vec3& place)> pressure;
  // Grains leave at the speed at which they arrive, and none come in; else their velocity there is given.
  bool passes_grains = false;
  double inflow_of_fluid = 0.0, inflow_of_grains = 0.0;  // given velocity, into the tank [m/s]

  // What is beyond; none: as inside.
  std::optional<double> solid_fraction, liquid_share;
  // alpha of what flows back where two fluids lie beyond, by the place on the side [m] and the height of a
  // cell [m]; none: as inside. What leaves keeps the surface it has inside.
  std::function<double(const Vec3& place, double cell)> liquid_that_flows_back;

  Tangent fluid, grains;
  // Tangential stress of the contacts over P_s^E, at most: infinite where grains stick, 0 where they slip.
  double friction = std::numeric_limits<double>::infinity();
  // Bumps that grains collide with: largest angle of a contact from the normal [rad], and their restitution
  // [-]; none: grains that collide stick, and the side takes no fluctuation energy.
  struct Bumps {
    double angle = 0.0, restitution = 0.0;
  };
  std::optional<Bumps> bumps;
  Vec3 velocity{};           // of a wall, in its own plane [m/s]
  bool bears_grains = true;  // a bed may rest on it

  // Something flows through it.
  bool is_open() const { return passes_fluid || inflow_of_fluid != 0.0; }
  double inflow(Phase phase) const { return phase == Phase::fluid ? inflow_of_fluid : inflow_of_grains; }
  bool passes(Phase phase) const { return phase == Phase::fluid ? passes_fluid : passes_grains; }
  const Tangent& tangent(Phase phase) const { return phase == Phase::fluid ? fluid : grains; }
};

// One function a kind, each in the file of its name.
SideRule wall_rule(const Side& side);
SideRule open_top_rule(const Scene& scene);
SideRule periodic_rule();
SideRule inlet_rule(const Inflow& inflow);
SideRule outlet_rule(const Scene& scene, int side);

// Of one of the six sides of a scene: the one list of kinds.
SideRule side_rule(const Scene& scene, int side);

}  // namespace granvof
