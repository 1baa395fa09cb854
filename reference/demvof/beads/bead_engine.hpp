// The bead side of demvof: LIGGGHTS as a library.
//
// Mobile beads move, are pulled by gravity and carry the load of the fluid. Frozen beads only stand in the
// way: they make a floor rough. The engine's x and z are
// periodic or walled; y is walled.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "reference/demvof/beads/bead_settings.hpp"
#include "reference/demvof/beads/elastic_energy.hpp"
#include "reference/demvof/beads/fluid_load.hpp"
#include "reference/demvof/beads/work_meter.hpp"

namespace demvof {

class BeadEngine {
 public:
  // Throws std::runtime_error when the scratch folder cannot be written. MPI must be initialised.
  BeadEngine(BeadSettings settings, const BeadState& mobile, const std::vector<double>& frozen_positions);
  ~BeadEngine();
  BeadEngine(const BeadEngine&) = delete;
  BeadEngine& operator=(const BeadEngine&) = delete;
  BeadEngine(BeadEngine&&) = delete;
  BeadEngine& operator=(BeadEngine&&) = delete;

  void set_load(const FluidLoad& load);
  // Advance by `steps` DEM steps. Throws std::runtime_error when a bead has left the tank.
  void run(int steps);
  // State of the mobile beads, in the order in which they were given.
  const BeadState& state() const { return state_; }

  void set_contact_law(const ContactLaw& law);  // from now on; rolling friction only if there was some before
  void set_velocities(const std::vector<double>& velocity);
  // Along -y [m/s2], negative pulls up; a slope [degrees] turns it towards +x, as on a chute.
  void set_gravity(double gravity, double slope = 0.0);
  void raise_gate(double speed);  // [m/s]
  void remove_gate();

  double time() const { return static_cast<double>(steps_done_) * settings_.dt; }
  const BeadSettings& settings() const { return settings_; }
  double bead_mass() const;
  double bead_volume() const;

  // Of the mobile beads now [J]; the work adds up from the beginning.
  const BeadWork& work() const { return meter_->work(); }
  double translation_energy() const;
  double spin_energy() const { return meter_->spin_energy(); }
  double potential_energy() const;  // zero at the bottom left corner
  ElasticEnergy elastic_energy() const;

 private:
  BeadSettings settings_;
  void* lammps_ = nullptr;
  std::size_t mobile_ = 0, frozen_ = 0;
  BeadState state_;
  std::vector<double> frozen_position_;
  FluidLoad load_;  // as LIGGGHTS has it
  std::unique_ptr<WorkMeter> meter_;
  Vector gravity_{};           // [m/s2]
  double raised_since_ = 0.0;  // time() at which the plate began to move [s]
  double gate_speed_ = 0.0;    // [m/s]
  long steps_done_ = 0;
  bool rolling_ = false;
  bool gate_present_ = false;
  bool gate_moving_ = false;
  bool set_up_ = false;  // whether the next run may skip LIGGGHTS' set-up
  double** load_scalar_ = nullptr;
  double** load_vector_ = nullptr;
  std::vector<double> gathered_;

  void command(const std::string& line);
  void declare_materials();
  void declare_walls();
  using MeshWriter = void(const std::string& path, const BeadSettings& settings);
  void declare_mesh(const char* name, MeshWriter& write, int type);
  bool declare_surfaces();  // false where there are none
  void refresh_state();
};

}  // namespace demvof
