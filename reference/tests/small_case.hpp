// A case of a few hundred grains, for tests of demvof from the case file on.
#pragma once

#include <string>
#include <vector>

#include "solver/tests/scene/case_fixture.hpp"

namespace demvof::test {

// The small case of the scene's tests, smaller still: a column of 10 mm by 6 mm without a gate, for 10 ms.
inline granvof::Scene small(const std::vector<std::string>& more = {}) {
  std::vector<std::string> overrides{"tank.size=[0.03, 0.02]",
                                     "grid.dx=0.0025",
                                     "liquid.level=0.015",
                                     "bed.length=0.01",
                                     "bed.height=0.006",
                                     "gate=false",
                                     "time.unit=s",
                                     "time.end=0.01",
                                     "output.field_times=[0]",
                                     "output.series_interval=0.002",
                                     "reference.cell=0.0025",
                                     "reference.fluid_dt=2e-4"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return granvof::test::small(overrides);
}

}  // namespace demvof::test
