#include "reference/demvof/program/record_scene.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "reference/demvof/beads/mpi_session.hpp"
#include "reference/demvof/preparation/column.hpp"
#include "reference/demvof/program/progress.hpp"
#include "reference/demvof/program/recording.hpp"
#include "reference/demvof/program/scene_setup.hpp"
#include "reference/demvof/program/scratch_folder.hpp"
#include "reference/demvof/program/snapshot.hpp"
#include "reference/demvof/program/watched_work.hpp"
#include "solver/output/output_error.hpp"
#include "solver/output/run_writer.hpp"
#include "solver/output/stop_signals.hpp"

namespace demvof {

namespace {

using granvof::Scene;

// Of the packing that was asked for; seeds differ by half of it.
constexpr double packing_tolerance = 0.01;

constexpr const char* nothing_to_resume = "there is no checkpoint to go on from: demvof writes none";

double core_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

// Everything of a recording from the preparation of its bed to its end, which is written into run.json.
class Session {
 public:
  Session(const Scene& scene, const RecordOptions& options)
      : scene_(scene),
        gridded_(with_reference_grid(scene)),
        options_(options),
        scratch_(options.scratch),
        line_(options.progress, scene.name),
        writer_(granvof::RunWriter::fresh(options.out, gridded_, {"demvof", options.command, 1, 1, {}},
                                          monitor_columns(), options.force)) {}

  int go();  // to the end; the exit code

 private:
  int work();  // what LIGGGHTS and OpenFOAM may end, in a process of its own
  Column prepare(const std::vector<double>& floor);
  void record();
  void note_release(const CoupledRun& run);
  void say_if_missed(double packing);
  void bring_up_to_date();
  int end(granvof::ExitState state, const std::string& reason);

  const Scene& scene_;
  const Scene gridded_;
  const RecordOptions& options_;
  const ScratchFolder scratch_;
  ProgressLine line_;
  granvof::RunWriter writer_;
  granvof::RunProgress progress_;
  double now_ = 0.0;  // [s] since the release; that of the last step
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
};

void Session::bring_up_to_date() {
  progress_.simulated_time = std::min(now_, scene_.times.end);
  progress_.core_seconds = core_seconds();
  progress_.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
}

Column Session::prepare(const std::vector<double>& floor) {
  line_.say("preparing the column");
  Column column = prepare_column(column_settings(scene_, options_.seed, floor, scratch_.name().string()));
  progress_.monitors["seed"] = options_.seed;
  progress_.monitors["beads"] = static_cast<double>(column.position.size() / 3);
  progress_.monitors["floor_beads"] = static_cast<double>(floor.size() / 3);
  progress_.monitors["prepared_packing"] = column.packing;
  progress_.monitors["prepared_height_m"] = column.height;
  progress_.monitors["slice_depth_m"] = depth_of(scene_);
  // Of what a bed of exactly the packing asked for would hold.
  progress_.monitors["prepared_solid_share"] = solid_share(scene_, column.position.size() / 3);
  progress_.monitors["preparation_core_seconds"] = core_seconds();
  return column;
}

// The state in which the bed is let go.
void Session::note_release(const CoupledRun& run) {
  const BeadState& rested = run.beads().state();
  const double d = bead_diameter(scene_);
  const granvof::Box& bed = scene_.bed->box;
  const Vector inner_lower{bed.lower[0] + 3 * d, bed.lower[1] + 3 * d, 0.0};
  const Vector inner_upper{bed.upper[0] - 3 * d, bed.upper[1] - 6 * d, depth_of(scene_)};
  const bool room = inner_upper[0] > inner_lower[0] + 3 * d && inner_upper[1] > inner_lower[1] + 3 * d;
  if (room && scene_.dimensions == 2) {
    progress_.monitors["released_packing"] = packing_inside(rested.position, inner_lower, inner_upper, d);
    say_if_missed(progress_.monitors["released_packing"]);
  } else {
    say_if_missed(progress_.monitors["prepared_packing"]);
  }
  progress_.monitors["released_height_m"] = bed_top(rested, d);
  progress_.monitors["released_rms_speed_m_s"] = bead_rms_speed(rested);
  progress_.monitors["released_excess_base_pressure_Pa"] = excess_base_pressure(run, gridded_);
}

// A preparation gets near a packing, not to it: the friction that it is settled with sets it, and that of the
// run moves it.
void Session::say_if_missed(double packing) {
  const double asked = scene_.reference->packing;
  if (std::abs(packing / asked - 1.0) <= packing_tolerance) return;
  const std::string meaning = fmt::format(
      "reference.packing asks for {:.4g}; released at {:.4g}, with {:.4g} of the solid that it would hold",
      asked, packing, progress_.monitors["prepared_solid_share"]);
  progress_.warnings.push_back({"released_packing", 0.0, packing, asked, meaning});
  line_.end();
  fmt::print(stderr, "demvof: {}: warning: {}\n", scene_.name, meaning);
}

void Session::record() {
  const std::string scratch = scratch_.name().string();
  const std::vector<double> floor = floor_beads(scene_, options_.seed);
  BeadState beads;
  beads.position = prepare(floor).position;

  const FluidSettings fluid = fluid_settings(scene_, scratch);
  CouplingSettings coupling;
  coupling.fluid_dt = scene_.reference->fluid_dt;
  coupling.drag = scene_.model.drag;
  coupling.drag_law = scene_.model.drag_law;
  coupling.coarse_graining = scene_.reference->coarse_graining;
  coupling.predict_pressure = scene_.solid.density < 1.5 * scene_.liquid.density;
  if (scene_.gate) coupling.closed_gate = gate_face(gridded_);
  CoupledRun run(coupling, bead_settings(scene_, scratch), beads, floor, fluid, initial_alpha(scene_, fluid));
  progress_.cells = static_cast<std::int64_t>(run.solid_fraction().size());

  const double hold = scene_.gate ? scene_.reference->hold : 0.0;
  progress_.monitors["hold_s"] = hold;
  GateKeeper gate(run, gridded_, options_.gate_closed);
  Recording recording(run, gridded_, writer_, progress_, hold);
  const auto after_step = [&] {
    now_ = recording.now();
    line_.update(now_, -hold, scene_.times.end);
    granvof::throw_if_stopped();
  };
  const double half = 0.5 * bead_dt(scene_);
  recording.advance_to_release(half, after_step);
  note_release(run);
  gate.release();
  recording.begin();
  while (!recording.done()) {
    const bool wrote_row = recording.advance();
    if (recording.now() > half) gate.follow(recording.now());
    if (wrote_row) {
      bring_up_to_date();
      writer_.write_progress(progress_);
    }
    after_step();
  }
}

// Exit code 0 where it finished, else 1.
int Session::end(granvof::ExitState state, const std::string& reason) {
  bring_up_to_date();
  line_.end();
  const bool finished = state == granvof::ExitState::finished;
  const std::string at = finished ? "" : fmt::format("at t = {:.6g} s: {}", now_, reason);
  if (!finished) fmt::print(stderr, "demvof: {} {}; {}\n", scene_.name, at, nothing_to_resume);
  try {
    writer_.finish(progress_, {state, at});
    return finished ? 0 : 1;
  } catch (const granvof::OutputError& error) {
    if (finished) fmt::print(stderr, "demvof: {}: {}\n", scene_.name, error.what());
    writer_.give_up(progress_, finished ? error.what() : at);
    return 1;
  }
}

int Session::work() {
  try {
    const MpiSession session;
    record();
    return end(granvof::ExitState::finished, "");
  } catch (const granvof::StopRequested& stop) {
    return end(granvof::ExitState::stopped, stop.what());
  } catch (const std::exception& problem) {
    return end(granvof::ExitState::failed, problem.what());
  }
}

int Session::go() {
  try {
    writer_.write_progress(progress_);  // run.json must not show an old end while this goes on
  } catch (const std::exception& problem) {
    return end(granvof::ExitState::failed, problem.what());
  }
  const WorkEnd done = work_in_own_process([this] { return work(); });
  if (done.code) return *done.code;
  const std::string reason = reason_of(done, scratch_.name());
  fmt::print(stderr, "demvof: {}: {}; {}\n", scene_.name, reason, nothing_to_resume);
  writer_.note_end_of_copy(reason);
  return 1;
}

}  // namespace

int record_scene(const Scene& scene, const RecordOptions& options) {
  check_scene(scene);
  granvof::listen_to_stop_signals();
  return Session(scene, options).go();
}

}  // namespace demvof
