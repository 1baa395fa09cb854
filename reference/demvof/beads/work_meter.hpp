// Work of the forces on the mobile beads, counted in every DEM step.
//
// Velocity Verlet kicks a bead by F dt/2, lets it drift, and kicks it again by the force at the new place. A
// kick changes 1/2 m v^2 by F dt/2 . (v + F dt / (4 m)), v before it, exactly: so counted, the works of all
// forces add up to the change of the beads' kinetic energy, spin included, to rounding.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "reference/demvof/beads/bead_settings.hpp"
#include "reference/demvof/beads/fluid_load.hpp"

namespace demvof {

// Done on the mobile beads since the engine was made [J]; a loss is negative.
struct BeadWork {
  double gravity = 0.0;
  double drag = 0.0;      // FluidLoad's coefficient (velocity - u_bead)
  double force = 0.0;     // FluidLoad's force
  double contacts = 0.0;  // with beads, mobile and frozen
  double walls = 0.0;     // with the planes of the tank, which stand
  double surfaces = 0.0;  // with obstacles and the gate's plate
  // By whatever moves the plate: its force on the beads times its own speed.
  double gate_drive = 0.0;

  BeadWork& operator+=(const BeadWork& other);
  // Change of the kinetic energy.
  double total() const { return gravity + drag + force + contacts + walls + surfaces; }
};

// LIGGGHTS adds forces in the order in which they were declared. The meter looks at them at three places.
class WorkMeter {
 public:
  enum class Place { after_beads, after_walls, after_all };

  // `lammps` outlives the meter; `load` is what was last handed to LIGGGHTS.
  WorkMeter(void* lammps, const BeadSettings& settings, const FluidLoad& load);
  // To be called for each place in turn, between the commands that declare the forces.
  void look(Place place);
  void look_last_again();  // behind a force that was declared after all

  void set_gravity(const Vector& acceleration) { gravity_ = acceleration; }  // [m/s2]
  void set_gate_speed(double speed) { gate_speed_ = speed; }                 // upwards [m/s]
  const BeadWork& work() const { return work_; }
  double spin_energy() const;  // of the mobile beads now [J]

 private:
  struct Probe {
    WorkMeter* meter = nullptr;
    Place place = Place::after_all;
  };
  // Forces and torques as they were at a place, three numbers an atom of LIGGGHTS.
  struct Forces {
    std::vector<double> force, torque;
  };

  void* lammps_;
  const FluidLoad& load_;
  double mass_ = 0.0, inertia_ = 0.0;  // [kg], [kg m2]
  double dt_ = 0.0;                    // [s]
  Vector gravity_{};
  double gate_speed_ = 0.0;
  double plate_ = 0.0, reach_of_plate_ = 0.0;  // where it stands, and how near a bead is that it moves [m]
  std::array<Probe, 3> probes_{};
  Forces beads_, walls_;
  BeadWork work_, second_kick_;  // the second kick of a step is given with the next one
  std::int64_t last_step_ = 0;   // LIGGGHTS sets itself up at step 0

  static void called(void* probe, std::int64_t step, int atoms, int* tags, double** x, double** unused);
  void keep(Forces& forces) const;
  void count(std::int64_t step);
  void count_bead(int atom, bool whole_step, BeadWork& first);
};

}  // namespace demvof
