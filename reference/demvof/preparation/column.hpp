// Columns of beads at a wanted packing, from a seed.
//
// A settled column: beads dispersed at random fall under buoyant gravity, slowed by a drag that stands for
// the liquid, with the friction of the preparation, which sets the packing; then they come to rest once more
// with the friction of the run (if wanted), and what stands above the wanted height is cut off. A suspended
// column (below about 0.55 no pile is at rest): beads at random without contact and without velocity.
#pragma once

#include <string>
#include <vector>

#include "reference/demvof/beads/bead_settings.hpp"

namespace demvof {

struct ColumnSettings {
  Vector lower{}, upper{};     // where the column stands [m]
  bool periodic_depth = true;  // z joined to itself; otherwise planes at both ends
  double packing = 0.57;       // wanted; reached exactly only by a suspended column
  bool suspended = false;
  double diameter = 0.0;
  double density = 0.0;          // of the beads while they settle [kg/m3]
  double buoyant_gravity = 0.0;  // [m/s2], > 0
  ContactLaw preparation_law;    // sets the packing
  ContactLaw final_law;          // the run's
  bool final_settling =
      true;  // at rest under it; else released as prepared, at the packing of the preparation
  double dt = 1e-5;
  std::vector<double> floor;  // frozen beads under the column, absolute positions; may be empty
  unsigned seed = 1;
  std::string scratch_folder;
};

struct Column {
  std::vector<double> position;  // three numbers a bead
  double packing = 0.0;          // in the inner part, 3 d from every boundary [-]
  double height = 0.0;           // of the top beads' upper edge over the column's floor [m]
  double residual_speed = 0.0;   // rms speed of the beads when the preparation ended [m/s]
};

// Throws std::runtime_error when the beads do not come to rest or do not fill the wanted height,
// granvof::StopRequested where a signal asks for the end meanwhile.
Column prepare_column(const ColumnSettings& settings);

// Solid fraction of the part of a set of beads inside a box, by counting centres [-].
double packing_inside(const std::vector<double>& position, const Vector& lower, const Vector& upper,
                      double diameter);

}  // namespace demvof
