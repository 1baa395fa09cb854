#include "reference/demvof/program/record_scene.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <optional>

#include <fmt/format.h>

#include "reference/demvof/program/progress.hpp"
#include "reference/demvof/program/scene_setup.hpp"
#include "reference/demvof/program/snapshot.hpp"
#include "solver/output/output_error.hpp"
#include "solver/output/output_schedule.hpp"
#include "solver/output/run_writer.hpp"

namespace demvof {

namespace {

using granvof::Scene;

double core_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

std::vector<granvof::Column> monitor_columns() {
  return {
      {"fluid_step", "s", "length of the last fluid step"},
      {"bead_front", "m", "x left of which 99.5 % of the beads have their centres"},
      {"bead_speed_rms", "m/s", "rms speed of the beads"},
      {"floor_slip", "-",
       "mean u_x of the lowest layer of beads over that of the next, beyond the initial bed"},
      {"excess_base_pressure", "Pa", "floor pressure under the initial bed beyond the liquid's own weight"},
      {"fluid_speed_max", "m/s", "largest speed of the continuous phase"},
      {"liquid_volume_change", "-", "relative change of the liquid volume since the start"}};
}

// The face of the fluid cells on which the gate stands.
int gate_face(const Scene& scene) {
  return static_cast<int>(std::lround(scene.gate->position / scene.grid.spacing[0]));
}

// Moves the gate for both sides.
class GateKeeper {
 public:
  GateKeeper(CoupledRun& run, const Scene& scene, bool stays)
      : run_(run), scene_(scene), present_(scene.gate.has_value()), stays_(stays) {
    if (!present_) return;
    face_ = gate_face(scene);
    run_.set_gate_edge(face_, 0.0);
  }
  void release() {
    if (!present_ || stays_) return;
    if (scene_.reference->release == granvof::ReferenceRelease::instant) {
      run_.beads().remove_gate();
      run_.remove_gate();
      present_ = false;
    } else {
      run_.beads().raise_gate(scene_.gate->speed);
      bead_plate_ = true;
    }
  }
  void follow(double time) {
    if (!present_ || stays_) return;
    const double edge = scene_.gate->speed * time;
    if (bead_plate_ && edge > scene_.bed->box.upper[1] + 4.0 * bead_diameter(scene_)) {
      run_.beads().remove_gate();
      bead_plate_ = false;
    }
    if (edge > scene_.tank[1]) {
      run_.remove_gate();
      present_ = false;
      return;
    }
    run_.set_gate_edge(face_, edge);
  }

 private:
  CoupledRun& run_;
  const Scene& scene_;
  bool present_ = false, stays_ = false, bead_plate_ = false;
  int face_ = 0;
};

// One recording in progress: its outputs, what it costs, and what it conserves.
class Recording {
 public:
  Recording(CoupledRun& run, const Scene& scene, granvof::RunWriter& writer)
      : run_(run), scene_(scene), writer_(writer), liquid_start_(run.fluid().liquid_volume()) {}

  void row(double time) {
    const BeadState& beads = run_.beads().state();
    // A scene without liquid has none to lose.
    const double change = liquid_start_ > 0.0 ? run_.fluid().liquid_volume() / liquid_start_ - 1.0 : 0.0;
    const std::vector<granvof::Value> monitors{
        last_step_,
        bead_front(beads),
        bead_rms_speed(beads),
        floor_slip(beads, bead_diameter(scene_), scene_.bed->box.upper[0]),
        excess_base_pressure(run_, scene_),
        run_.fluid().largest_speed(),
        change};
    const granvof::CellFields fields = snapshot(run_, scene_, time);
    progress.liquid_volume_error = std::max(progress.liquid_volume_error, std::abs(change));
    writer_.write_series_row(time, monitors, granvof::extract_scalars(fields, scene_));
  }
  void fields(double time) { writer_.write_fields(snapshot(run_, scene_, time)); }
  void step(double longest) {
    last_step_ = run_.step(longest);
    ++progress.steps;
    for (const double f : run_.solid_fraction()) {
      progress.solid_fraction_max = std::max(progress.solid_fraction_max, f);
    }
  }

  granvof::RunProgress progress;

 private:
  CoupledRun& run_;
  const Scene& scene_;
  granvof::RunWriter& writer_;
  double liquid_start_;
  double last_step_ = 0.0;
};

}  // namespace

int record_scene(const Scene& scene, const RecordOptions& options) {
  check_scene(scene);
  const auto clock = std::chrono::steady_clock::now();
  const Scene gridded = with_reference_grid(scene);
  const std::string scratch = options.scratch.string();
  ProgressLine line(options.progress, scene.name);

  granvof::RunWriter writer = granvof::RunWriter::fresh(
      options.out, gridded, {"demvof", options.command, 1, 1}, monitor_columns(), options.force);

  line.say("preparing the column");
  const std::vector<double> floor = floor_beads(scene, options.seed);
  const Column column = prepare_column(column_settings(scene, options.seed, floor, scratch));
  const double preparation = core_seconds();

  const FluidSettings fluid = fluid_settings(scene, scratch);
  CouplingSettings coupling;
  coupling.fluid_dt = scene.reference->fluid_dt;
  coupling.drag = scene.model.drag;
  coupling.coarse_graining = scene.reference->coarse_graining;
  coupling.predict_pressure = scene.solid.density < 1.5 * scene.liquid.density;
  if (scene.gate) coupling.closed_gate = gate_face(gridded);
  BeadState beads;
  beads.position = column.position;
  CoupledRun run(coupling, bead_settings(scene, scratch), beads, floor, fluid, initial_alpha(scene, fluid));
  GateKeeper gate(run, gridded, options.gate_closed);
  Recording recording(run, gridded, writer);
  granvof::RunProgress& progress = recording.progress;
  progress.cells = static_cast<std::int64_t>(run.solid_fraction().size());
  progress.monitors["seed"] = options.seed;
  progress.monitors["beads"] = static_cast<double>(beads.count());
  const std::size_t floor_count = floor.size() / 3;
  progress.monitors["floor_beads"] = static_cast<double>(floor_count);
  progress.monitors["prepared_packing"] = column.packing;
  progress.monitors["prepared_height_m"] = column.height;
  progress.monitors["slice_depth_m"] = depth_of(scene);
  progress.monitors["preparation_core_seconds"] = preparation;

  const double hold = scene.gate ? scene.reference->hold : 0.0;
  double now = -hold;
  const auto bring_up_to_date = [&] {
    progress.simulated_time = now;
    progress.core_seconds = core_seconds();
    progress.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
  };
  const auto advance_to = [&](double target) {
    const double half = 0.5 * bead_dt(scene);
    while (now < target - half) {
      recording.step(target - now);
      now = run.time() - hold;
      if (now > half) gate.follow(now);
      line.update(now, -hold, scene.times.end);
    }
  };

  try {
    advance_to(0.0);
    const BeadState& rested = run.beads().state();
    const double d = bead_diameter(scene);
    const granvof::Box& bed = scene.bed->box;
    const Vector inner_lower{bed.lower[0] + 3 * d, bed.lower[1] + 3 * d, 0.0};
    const Vector inner_upper{bed.upper[0] - 3 * d, bed.upper[1] - 6 * d, depth_of(scene)};
    const bool room = inner_upper[0] > inner_lower[0] + 3 * d && inner_upper[1] > inner_lower[1] + 3 * d;
    if (room && scene.dimensions == 2) {
      progress.monitors["released_packing"] = packing_inside(rested.position, inner_lower, inner_upper, d);
    }
    progress.monitors["released_height_m"] = bed_top(rested, d);
    progress.monitors["hold_s"] = hold;
    progress.monitors["released_rms_speed_m_s"] = bead_rms_speed(rested);
    progress.monitors["released_excess_base_pressure_Pa"] = excess_base_pressure(run, gridded);
    gate.release();

    for (const granvof::DueOutput& due : granvof::due_output(scene.times, -1.0, scene.times.end)) {
      advance_to(due.time);
      if (due.row) {
        recording.row(due.time);
        bring_up_to_date();
        writer.write_progress(progress);
      }
      if (due.fields) recording.fields(due.time);
    }
    bring_up_to_date();
    writer.finish(progress, {granvof::ExitState::finished, ""});
    line.end();
    return 0;
  } catch (const granvof::OutputError&) {
    throw;
  } catch (const std::exception& problem) {
    bring_up_to_date();
    const std::string reason = fmt::format("at t = {:.6g} s: {}", now, problem.what());
    writer.finish(progress, {granvof::ExitState::failed, reason});
    line.end();
    fmt::print(stderr, "demvof: {} failed {}\n", scene.name, reason);
    return 1;
  }
}

}  // namespace demvof
