#include "reference/demvof/program/record_chute.hpp"

#include <fmt/format.h>

#include "reference/demvof/beads/mpi_session.hpp"
#include "reference/demvof/program/scratch_folder.hpp"
#include "reference/demvof/program/test_directory.hpp"
#include "reference/demvof/program/watched_work.hpp"
#include "solver/output/stop_signals.hpp"

namespace demvof {

namespace {

int record_in_this_process(const granvof::Scene& scene, const RecordOptions& options,
                           const ScratchFolder& scratch) {
  const MpiSession session;
  const TestClock clock;
  const ChuteResult result = run_chute(chute_settings(scene, options.seed, scratch.name().string()));
  const FrictionFit fit = fit_of(result);
  write_tests(scene, options, clock, result, friction_monitors(result, fit));
  fmt::print("mu_s {:.4f} +- {:.4f}, mu_2 {:.4f} +- {:.4f}, I_0 {:.4f} +- {:.4f}; {} points, rms {:.4f}\n",
             fit.law.at_rest, fit.band.at_rest, fit.law.limit, fit.band.limit, fit.law.scale, fit.band.scale,
             result.points.size(), fit.rms);
  return 0;
}

}  // namespace

int record_chute(const granvof::Scene& scene, const RecordOptions& options) {
  check_tests(scene);
  require_own_tests(options.out, scene, "mu_s");
  granvof::listen_to_stop_signals();  // nothing is written before the end, and nothing is then
  const ScratchFolder scratch(options.scratch);
  const WorkEnd done = work_in_own_process([&] { return record_in_this_process(scene, options, scratch); });
  if (done.code) return *done.code;
  fmt::print(stderr, "demvof: {}: {}\n", scene.name, reason_of(done, scratch.name()));
  return 1;
}

}  // namespace demvof
