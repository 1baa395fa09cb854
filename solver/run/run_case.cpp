#include "solver/run/run_case.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>

#include <omp.h>
#include <spdlog/spdlog.h>

#include "solver/output/output_error.hpp"
#include "solver/output/output_schedule.hpp"
#include "solver/output/run_writer.hpp"
#include "solver/output/stop_signals.hpp"
#include "solver/run/alarms.hpp"
#include "solver/run/checkpoint_state.hpp"
#include "solver/run/memory_demand.hpp"
#include "solver/run/monitors.hpp"
#include "solver/run/progress_line.hpp"
#include "solver/run/snapshot.hpp"
#include "solver/run/step_control.hpp"
#include "solver/run/time_step.hpp"

namespace granvof {
namespace {

double core_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

std::vector<Column> monitor_columns() {
  std::vector<Column> columns{
      {"dt", "s", "last time step"},
      {"newton", "-", "Newton iterations of the last step"},
      {"linear", "-", "iterations of the coupled pressure solver in the last step"},
      {"friction_iterations", "-", "iterations of the friction solver in the last step"},
      {"solid_volume_error", "-", "largest relative change of the solid volume so far"},
      {"liquid_volume_error", "-",
       "largest relative change of the liquid volume so far, outflow accounted for"}};
  for (const EnergyTerm& term : energy_terms) columns.push_back({term.name, "J", term.meaning});
  return columns;
}

std::vector<LedgerTerm> ledger() {
  std::vector<LedgerTerm> terms;
  for (const EnergyTerm& term : energy_terms)
    terms.push_back({term.name, name_of(term.kind), term.sign, term.never_gains, term.label, term.meaning,
                     term.measured_in});
  return terms;
}

// One run: everything that lives from the first step to the last.
class Run {
 public:
  Run(const Scene& scene, const RunOptions& options)
      : scene_(scene),
        options_(options),
        grid_(scene),
        boundary_(grid_, communicator_),
        step_(grid_, scene, boundary_, communicator_),
        control_(grid_, scene),
        now_(initial_state(grid_, scene, boundary_)),
        next_(grid_),
        monitors_(grid_, scene, now_),
        start_energy_(now_.energy),
        alarms_(scene, start_energy_),
        writer_(open_writer()),
        progress_line_(options.progress, scene) {}

  int go();  // to the end; the exit code

 private:
  RunWriter open_writer();
  int loop();
  bool advance();  // one accepted step; false if the run cannot go on, see trouble_
  // Rows and fields between that state and the present one.
  void write_output(const State& earlier, const std::vector<DueOutput>& due_now);
  void step_back();  // to the state before the last step
  void checkpoint();
  RunProgress progress() const;
  enum class LastStep { kept, undone };
  int finish(ExitState state, const std::string& reason, LastStep last_step = LastStep::kept);
  int give_up(const std::string& reason);
  std::string what_is_left() const;

  const Scene& scene_;
  const RunOptions& options_;
  SerialCommunicator communicator_;
  Grid grid_;
  Boundary boundary_;
  TimeStep step_;
  StepControl control_;
  State now_, next_;  // after a step next_ holds the state before it
  Monitors monitors_;
  EnergyTerms start_energy_;  // of the scene's start, whatever it is resumed from
  Alarms alarms_;
  RunCounters counters_;
  struct Marks {
    RunCounters counters;
    Monitors::Values monitors{};
    double dt = 0.0;
  } before_;  // those of the state before the last step
  StepReport last_;
  std::string trouble_;
  bool begins_ = true;  // not resumed
  RunWriter writer_;
  ProgressLine progress_line_;
  double started_core_ = core_seconds();
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now(),
                                        last_checkpoint_ = started_;
};

RunWriter Run::open_writer() {
  const RunStart start{"granvof", options_.command, 1, options_.threads, ledger()};
  if (!options_.resume)
    return RunWriter::fresh(options_.out, scene_, start, monitor_columns(), options_.force);
  ResumedRun resumed = RunWriter::resume(options_.out, scene_, start, monitor_columns());
  if (!resumed.checkpoint) {
    spdlog::warn("{}: {} has no checkpoint, the run begins anew", scene_.name, options_.out.string());
    return std::move(resumed.writer);
  }
  begins_ = false;
  restore(*resumed.checkpoint, grid_, now_, control_, monitors_, counters_);
  now_.fill_ghosts(boundary_);
  alarms_.restore(std::move(resumed.warnings));
  return std::move(resumed.writer);
}

bool Run::advance() {
  before_ = {counters_, monitors_.values(), control_.last()};
  double dt = control_.next(now_);
  for (;;) {
    last_ = step_.advance(now_, dt, next_);
    if (last_.accepted) {
      trouble_ = monitors_.not_finite(next_);
      if (trouble_.empty()) break;
      last_.refused_because = "the " + trouble_ + " is not finite";
    }
    ++counters_.refused_steps;
    spdlog::debug("t = {:.6g} s: step of {:.3g} s refused: {}", now_.time, dt, last_.refused_because);
    dt = control_.after_refusal(dt);
    if (dt < scene_.numerics.dt_min) {
      trouble_ = fmt::format("step collapse at t = {:.6g} s: {}", now_.time, last_.refused_because);
      return false;
    }
  }
  std::swap(now_, next_);
  control_.accepted(dt);
  monitors_.update(now_, last_.liquid_left, last_.solid_left);
  counters_.newton += last_.pressure.newton;
  counters_.linear += last_.pressure.linear;
  counters_.friction += last_.friction.iterations;
  counters_.unconverged_friction += last_.friction.converged ? 0 : 1;
  ++counters_.steps;
  return true;
}

void Run::step_back() {
  std::swap(now_, next_);
  counters_ = before_.counters;
  monitors_.restore(before_.monitors);
  control_.restore(before_.dt);
}

// The flow knows nothing of its output: no step is cut for it. What falls into a step is interpolated between
// the two states; monitors are those of that step.
void Run::write_output(const State& earlier, const std::vector<DueOutput>& due_now) {
  for (const DueOutput& due : due_now) {
    const CellFields fields = cell_fields(grid_, earlier, now_, due.time);
    if (due.row) {
      std::vector<Value> row{control_.last(),
                             static_cast<double>(last_.pressure.newton),
                             static_cast<double>(last_.pressure.linear),
                             static_cast<double>(last_.friction.iterations),
                             monitors_.solid_volume_error(),
                             monitors_.liquid_volume_error()};
      const EnergyTerms energy = energy_terms_at(earlier, now_, due.time);
      for (const EnergyTerm& term : energy_terms) row.emplace_back(energy.*term.value);
      writer_.write_series_row(due.time, row, extract_scalars(fields, scene_));
    }
    if (due.fields) writer_.write_fields(fields);
  }
}

RunProgress Run::progress() const {
  RunProgress p;
  p.steps = counters_.steps;
  p.refused_steps = counters_.refused_steps;
  p.cells = static_cast<std::int64_t>(grid_.cells.count());
  p.simulated_time = std::min(now_.time, scene_.times.end);
  p.wall_seconds = counters_.wall_seconds +
                   std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
  p.core_seconds = counters_.core_seconds + core_seconds() - started_core_;
  p.cost = step_.cost().seconds();
  p.solid_volume_error = monitors_.solid_volume_error();
  p.liquid_volume_error = monitors_.liquid_volume_error();
  p.solid_fraction_max = monitors_.solid_fraction_max();
  const double steps = std::max<double>(1.0, static_cast<double>(counters_.steps));
  p.monitors = {{"newton_per_step", static_cast<double>(counters_.newton) / steps},
                {"linear_per_step", static_cast<double>(counters_.linear) / steps},
                {"friction_per_step", static_cast<double>(counters_.friction) / steps},
                {"unconverged_friction_solves", static_cast<double>(counters_.unconverged_friction)},
                {"last_dt", control_.last()},
                {"energy_turnover", energy_turnover(scene_, start_energy_, now_.energy)}};
  for (const EnergyTerm& term : energy_terms) p.monitors[term.name] = now_.energy.*term.value;
  p.warnings = alarms_.raised();
  return p;
}

void Run::checkpoint() {
  const RunProgress p = progress();
  writer_.write_checkpoint(checkpoint_view(grid_, now_, control_, monitors_, counters_, p), p);
  last_checkpoint_ = std::chrono::steady_clock::now();
}

int Run::finish(ExitState state, const std::string& reason, LastStep last_step) {
  progress_line_.clear();
  const RunProgress done = progress();
  if (last_step == LastStep::undone) step_back();
  writer_.write_checkpoint(checkpoint_view(grid_, now_, control_, monitors_, counters_, done), done);
  if (state != ExitState::finished) spdlog::error("{}: {}; {}", scene_.name, reason, what_is_left());
  writer_.finish(done, {state, reason});
  return state == ExitState::finished ? 0 : 1;
}

std::string Run::what_is_left() const {
  const auto saved = writer_.checkpoint_time();
  return saved ? fmt::format("--resume goes on from t = {:.6g} s, {}", *saved,
                             writer_.checkpoint_path().string())
               : "there is no checkpoint to go on from";
}

int Run::give_up(const std::string& reason) {
  progress_line_.clear();
  const std::string at = fmt::format("stopped at t = {:.6g} s: {}", now_.time, reason);
  spdlog::error("{}: {}; {}", scene_.name, at, what_is_left());
  writer_.give_up(progress(), at);
  return 1;
}

int Run::go() {
  try {
    writer_.write_progress(progress());  // run.json must not show an old end while this goes on
    if (begins_) write_output(now_, due_output(scene_.times, -1.0, now_.time));
    return loop();
  } catch (const OutputError& error) {
    return give_up(fmt::format("its output cannot be written: {}", error.what()));
  } catch (const std::exception& error) {
    return give_up(error.what());
  }
}

int Run::loop() {
  for (;;) {
    if (const std::string reason = stop_reason(); !reason.empty()) return finish(ExitState::stopped, reason);
    if (!advance()) return finish(ExitState::failed, trouble_);
    write_output(next_, due_output(scene_.times, next_.time, now_.time));
    trouble_ = alarms_.check(now_, monitors_,
                             {counters_.steps, counters_.unconverged_friction, counters_.refused_steps});
    // The state that raised the alarm is no good one.
    if (!trouble_.empty()) return finish(ExitState::failed, trouble_, LastStep::undone);
    // The last step led to or beyond the end. A longer run goes on from before it, as if there had been no
    // end.
    if (now_.time >= scene_.times.end) return finish(ExitState::finished, {}, LastStep::undone);
    const std::chrono::duration<double> since = std::chrono::steady_clock::now() - last_checkpoint_;
    if (scene_.times.checkpoint_interval > 0.0 && since.count() >= scene_.times.checkpoint_interval)
      checkpoint();
    progress_line_.show(progress(), control_.last(), last_.pressure.newton, last_.pressure.linear);
  }
}

}  // namespace

int run_case(const Scene& scene, const RunOptions& options) {
  check_memory(scene);
  omp_set_num_threads(std::max(1, options.threads));
  listen_to_stop_signals();
  return Run(scene, options).go();
}

}  // namespace granvof
