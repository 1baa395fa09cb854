// A dry layer of beads, periodic along and across, on a floor: what element tests are made with.
#pragma once

#include <string>
#include <vector>

#include "reference/demvof/beads/bead_engine.hpp"

namespace demvof {

struct LayerSettings {
  double diameter = 0.0;    // [m]
  double density = 0.0;     // of the beads [kg/m3]
  double gravity = 9.81;    // [m/s2], > 0
  double dt = 1e-5;         // [s]
  ContactLaw law;           // the run's
  double length = 10.0;     // along the flow, periodic [diameters]
  double depth = 8.0;       // across, periodic [diameters]
  double layer = 14.0;      // height of the layer at rest [diameters]
  bool rough_floor = true;  // frozen beads, half sunk; else a plane with the law's wall friction
  bool flows = true;        // starts with Bagnold's profile of fast flow; else at rest
  unsigned seed = 1;        // of the layer and of the floor
  std::string scratch_folder;
  double time_unit() const;  // sqrt(d/g) [s]
};

// Means over a window, in bins one diameter high.
struct Profile {
  std::vector<double> solid;        // f_s [-]
  std::vector<double> velocity;     // along the slope [m/s]
  std::vector<double> fluctuation;  // variance of one component of the velocity, mean of the three [m2/s2]
};

inline constexpr double bottom_left_out = 3.0;  // of the layer, in diameters
inline constexpr double surface_left_out =
    4.0;                                      // load above a point that counts, in diameters of packed layer
inline constexpr double rest_packing = 0.58;  // of a layer, for its load [-]
inline constexpr int samples_per_window = 10;

class PeriodicLayer {
 public:
  // Beads at random without contact; they fall. Throws std::runtime_error as BeadEngine does.
  explicit PeriodicLayer(const LayerSettings& settings);

  BeadEngine& engine() { return engine_; }
  const LayerSettings& settings() const { return s_; }
  // Advances by `steps` (a multiple of samples_per_window) and averages. Throws std::runtime_error when a
  // bead is lost.
  Profile window(int steps);
  // Edge between the bins `edge - 1` and `edge`: the mass of the bins above it, on its area [kg/m2].
  double mass_above(const Profile& profile, std::size_t edge) const;
  // Whether that edge is far enough from floor and surface.
  bool counts(const Profile& profile, std::size_t edge) const;

 private:
  LayerSettings s_;
  BeadEngine engine_;
  std::size_t bins_ = 0;
};

}  // namespace demvof
