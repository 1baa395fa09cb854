#include "reference/demvof/program/record_chute.hpp"

#include <fmt/format.h>

#include "reference/demvof/beads/mpi_session.hpp"
#include "reference/demvof/program/test_directory.hpp"

namespace demvof {

namespace {

int record_in_this_process(const granvof::Scene& scene, const RecordOptions& options,
                           const std::filesystem::path& scratch) {
  const MpiSession session;
  const TestClock clock;
  const ChuteResult result = run_chute(chute_settings(scene, options.seed, scratch.string()));
  const FrictionFit fit = fit_of(result);
  write_tests(scene, options, clock, result, friction_monitors(result, fit));
  fmt::print("mu_s {:.4f} +- {:.4f}, mu_2 {:.4f} +- {:.4f}, I_0 {:.4f} +- {:.4f}; {} points, rms {:.4f}\n",
             fit.law.at_rest, fit.band.at_rest, fit.law.limit, fit.band.limit, fit.law.scale, fit.band.scale,
             result.points.size(), fit.rms);
  return 0;
}

}  // namespace

int record_chute(const granvof::Scene& scene, const RecordOptions& options) {
  return record_tests(scene, options, "mu_s", record_in_this_process);
}

}  // namespace demvof
