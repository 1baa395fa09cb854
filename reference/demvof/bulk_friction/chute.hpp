// Bulk friction of the beads: a dry layer flowing down a rough chute, periodic along and across.
//
// The slope is lowered in stages, from fast flow to rest. Everywhere in the layer the shear stress follows
// from the momentum above it, also while the flow slows down:
//   tau(y) = integral over y' > y of rho_s f_s (g sin - du/dt),  P(y) = integral of rho_s f_s g cos
// and mu = tau / P belongs to the inertial number I = (du/dy) d / sqrt(P / rho_s) (GDR MiDi, Eur. Phys. J. E
// 14, 2004).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reference/demvof/beads/bead_settings.hpp"
#include "reference/demvof/bulk_friction/friction_law.hpp"

namespace demvof {

struct ChuteSettings {
  double diameter = 0.0;       // [m]
  double density = 0.0;        // of the beads [kg/m3]
  double gravity = 9.81;       // [m/s2]
  double dt = 1e-5;            // [s]
  ContactLaw law;              // the run's
  double length = 10.0;        // along the flow, periodic [diameters]
  double depth = 8.0;          // across, periodic [diameters]
  double layer = 14.0;         // height of the layer at rest [diameters]
  std::vector<double> slopes;  // one stage each, in this order [degrees]
  double stage_time = 0.3;     // [s]
  unsigned seed = 1;           // of the layer and of the floor
  std::string scratch_folder;
};

// One window of the flow, averaged over the layer without its bottom and its surface.
struct ChutePoint {
  double time = 0.0;   // middle of the window [s]
  double slope = 0.0;  // [degrees]
  FrictionPoint friction;
  double solid_fraction = 0.0;  // [-]
  double mean_speed = 0.0;      // along the chute [m/s]
};

struct ChuteResult {
  std::size_t beads = 0;
  double duration = 0.0;              // of the flow [s]
  std::vector<ChutePoint> points;     // windows in which the layer flowed
  std::optional<double> lowest_flow;  // smallest slope at whose end the layer still flowed [degrees]
  std::optional<double> stopped_at;   // first slope at whose end it was at rest [degrees]
};

// Throws std::runtime_error when a bead is lost.
ChuteResult run_chute(const ChuteSettings& settings);

}  // namespace demvof
