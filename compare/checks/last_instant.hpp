// Metrics of a run's last fields.
#pragma once

#include "compare/checks/registry.hpp"

namespace granvof::compare {

Measured hydrostatic(const Run& run, const Parameters& p, const FindRun& find);
Measured ergun(const Run& run, const Parameters& p, const FindRun& find);
Measured bed_weight(const Run& run, const Parameters& p, const FindRun& find);
Measured solid_pressure(const Run& run, const Parameters& p, const FindRun& find);
Measured asymmetry(const Run& run, const Parameters& p, const FindRun& find);
Measured settling_slip(const Run& run, const Parameters& p, const FindRun& find);
Measured middle_depth(const Run& run, const Parameters& p, const FindRun& find);
Measured film(const Run& run, const Parameters& p, const FindRun& find);
Measured reattachment(const Run& run, const Parameters& p, const FindRun& find);

}  // namespace granvof::compare
