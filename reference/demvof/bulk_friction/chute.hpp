// Bulk friction of the beads: a dry layer flowing down a rough chute, periodic along and across.
//
// The slope is lowered in stages, from fast flow to rest. Everywhere in the layer the shear stress follows
// from the momentum above it, also while the flow slows down:
//   tau(y) = integral over y' > y of rho_s f_s (g sin - du/dt),  P(y) = integral of rho_s f_s g cos
// and mu = tau / P belongs to the inertial number I = (du/dy) d / sqrt(P / rho_s) (GDR MiDi, Eur. Phys. J. E
// 14, 2004). Then, if wanted, the slope is raised again from rest until the layer starts.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reference/demvof/bulk_friction/friction_law.hpp"
#include "reference/demvof/bulk_friction/layer.hpp"

namespace demvof {

struct ChuteSettings : LayerSettings {
  std::vector<double> slopes;  // one stage each, in this order [degrees]
  double stage_time = 0.3;     // [s]
  bool find_start = false;     // raise the slope again after the layer has stopped
};

// One window of the flow, averaged over the layer without its bottom and its surface.
struct ChutePoint {
  double time = 0.0;   // middle of the window [s]
  double slope = 0.0;  // [degrees]
  FrictionPoint friction;
  double solid_fraction = 0.0;  // [-]
  double mean_speed = 0.0;      // along the chute [m/s]
  double load = 0.0;            // P [Pa]
  double temperature = 0.0;     // Theta without what shear alone spreads in a bin, over (d du/dy)^2 [-]
};

struct ChuteResult {
  std::size_t beads = 0;
  double duration = 0.0;              // of the flow [s]
  std::vector<ChutePoint> points;     // windows in which the layer flowed
  std::optional<double> lowest_flow;  // smallest slope at whose end the layer still flowed [degrees]
  std::optional<double> stopped_at;   // first slope at whose end it was at rest [degrees]
  std::optional<double> started_at;   // first slope on the way up at whose end it flows [degrees]
};

// Change of the velocity of each bin over `time` [m/s2].
std::vector<double> acceleration_between(const Profile& before, const Profile& after, double time);

// Means of a window over the heights that count, but for its time; nothing without flow. `acceleration` a bin
// [m/s2], slope [degrees].
std::optional<ChutePoint> chute_point(const PeriodicLayer& layer, const Profile& now,
                                      const std::vector<double>& acceleration, double slope);

// Throws std::runtime_error when a bead is lost.
ChuteResult run_chute(const ChuteSettings& settings);

}  // namespace demvof
