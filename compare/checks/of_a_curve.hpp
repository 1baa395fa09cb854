// Metrics of one curve of a run: its distance from a published one, and its value at a time. What each is
// stands in the registry.
#pragma once

#include "compare/checks/registry.hpp"

namespace granvof::compare {

Measured dam_break_distance(const Run& run, const Parameters& p, const FindRun&);
Measured grain_front_distance(const Run& run, const Parameters& p, const FindRun&);
Measured base_pressure_distance(const Run& run, const Parameters& p, const FindRun&);
Measured solid_level_distance(const Run& run, const Parameters& p, const FindRun&);

// Of the f_s that a front is seen at, 0.30.
Curve grain_front_curve(const Run& run);

Measured grain_front_at(const Run& run, const Parameters& p, const FindRun&);
Measured solid_height_at(const Run& run, const Parameters& p, const FindRun&);
Measured liquid_height_at(const Run& run, const Parameters& p, const FindRun&);
Measured solid_volume_at(const Run& run, const Parameters& p, const FindRun&);
Measured granular_temperature_at(const Run& run, const Parameters& p, const FindRun&);
Measured kinetic_energy_of_grains(const Run& run, const Parameters& p, const FindRun&);
Measured interface_height_at(const Run& run, const Parameters& p, const FindRun&);
Measured liquid_front_at(const Run& run, const Parameters& p, const FindRun&);

}  // namespace granvof::compare
