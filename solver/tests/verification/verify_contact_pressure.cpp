// Implicit against explicit contact pressure: two ways through the same equations that must meet.
#include <cmath>

#include "solver/tests/verification/measured_scenes.hpp"

namespace granvof::test {
namespace {

// s1 on 5 mm cells to T = 2. Explicit contact pressure must follow the elastic waves, (13): steps of
// 0.5 h / sqrt(dP_s/df_s / rho_s).
struct Collapse {
  std::vector<double> f_s;
  int steps = 0;
};

Collapse collapse(const char* contact_pressure) {
  Simulation run(
      shipped_scene("s1", {"grid.dx=0.005", std::string("numerics.contact_pressure=") + contact_pressure}));
  run.until(2.0 * std::sqrt(0.049 / 9.81));
  Collapse result{{}, static_cast<int>(run.steps)};
  for (int j = 0; j < run.grid.cells.n[1]; ++j)
    for (int i = 0; i < run.grid.cells.n[0]; ++i) result.f_s.push_back(run.now.f_s[run.cell(i, j)]);
  return result;
}

TEST(ContactPressure, ExplicitMeetsImplicit) {
  const Collapse implicit = collapse("implicit"), explicit_one = collapse("explicit");
  double grains = 0.0, apart = 0.0;
  for (std::size_t c = 0; c < implicit.f_s.size(); ++c) {
    grains += implicit.f_s[c];
    apart += 0.5 * std::fabs(implicit.f_s[c] - explicit_one.f_s[c]);
  }
  report("grains_elsewhere", apart / grains);
  report("steps_implicit", implicit.steps);
  report("steps_explicit", explicit_one.steps);
  EXPECT_LT(apart / grains, 0.01);
  EXPECT_GT(explicit_one.steps, 5 * implicit.steps);  // what the implicit coupling is for
}

}  // namespace
}  // namespace granvof::test
