// Metrics of a run as a whole: volumes, bounds, speeds, energy, warnings, cost. What each is stands in the
// registry.
#pragma once

#include "compare/checks/registry.hpp"

namespace granvof::compare {

Measured solid_volume_error(const Run& run, const Parameters& p, const FindRun&);
Measured liquid_volume_error(const Run& run, const Parameters& p, const FindRun&);
Measured solid_fraction_max(const Run& run, const Parameters& p, const FindRun&);
Measured solid_fraction_min(const Run& run, const Parameters& p, const FindRun&);
Measured liquid_speed_max(const Run& run, const Parameters& p, const FindRun&);
Measured fluid_speed_max(const Run& run, const Parameters& p, const FindRun&);
Measured solid_speed_max(const Run& run, const Parameters& p, const FindRun&);
Measured energy_closure(const Run& run, const Parameters& p, const FindRun&);
Measured ledger_share(const Run& run, const Parameters& p, const FindRun&);
Measured ledger_order(const Run& run, const Parameters& p, const FindRun& find);
Measured energy_created(const Run& run, const Parameters& p, const FindRun&);
Measured warnings(const Run& run, const Parameters& p, const FindRun&);
Measured core_seconds(const Run& run, const Parameters& p, const FindRun&);

}  // namespace granvof::compare
