#include "solver/run/run_case.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <ctime>

#include <omp.h>
#include <spdlog/spdlog.h>

#include "solver/output/build_info.hpp"
#include "solver/output/output_error.hpp"
#include "solver/output/output_schedule.hpp"
#include "solver/output/run_writer.hpp"
#include "solver/output/stop_signals.hpp"
#include "solver/run/alarms.hpp"
#include "solver/run/closing_line.hpp"
#include "solver/run/cut.hpp"
#include "solver/run/memory_demand.hpp"
#include "solver/run/monitor_table.hpp"
#include "solver/run/progress_line.hpp"
#include "solver/run/run_log.hpp"
#include "solver/run/snapshot.hpp"
#include "solver/run/time_loop.hpp"
#include "solver/scene/duration.hpp"

namespace granvof {
namespace {

double core_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

std::vector<Column> monitor_columns() {
  std::vector<Column> columns;
  for (const MonitorEntry& monitor : monitors_of_a_step())
    columns.push_back({monitor.name, monitor.unit, monitor.meaning});
  for (const EnergyTerm& term : energy_terms) columns.push_back({term.name, "J", term.meaning});
  return columns;
}

std::vector<LedgerTerm> ledger_terms() {
  std::vector<LedgerTerm> terms;
  for (const EnergyTerm& term : energy_terms)
    terms.push_back({term.name, term.part.name, name_of(term.kind), term.sign, term.never_gains, term.label,
                     term.meaning, term.measured_in});
  return terms;
}

int processes_of(const RunOptions& options) {
  return options.processes == nullptr ? 1 : options.processes->size();
}

// What the processes do that do not lead.
int follow(const Scene& scene, const Communicator& processes) {
  try {
    return TimeLoop(scene, &processes).follow();
  } catch (const std::exception& error) {
    spdlog::error("{}: process {}: {}", scene.name, processes.rank(), error.what());
    processes.abort(1);
    return 1;
  }
}

// One run: what is done with the steps of the time loop.
class Run {
 public:
  Run(const Scene& scene, const RunOptions& options)
      : scene_(scene),
        options_(options),
        loop_(scene, options.processes),
        start_energy_(loop_.now().energy),
        alarms_(scene, start_energy_),
        writer_(open_writer()),
        progress_line_(options.progress, scene) {}

  int go();  // to the end; the exit code

 private:
  using Ending = TimeLoop::Ending;

  RunWriter open_writer();
  int steps();

  // What the time loop is observed by, in this order.
  std::optional<Ending> write_what_is_due();
  std::optional<Ending> raise_alarms();
  std::optional<Ending> end_of_scene() const;
  std::optional<Ending> write_checkpoint_in_time();
  std::optional<Ending> show_progress();
  std::optional<Ending> asked_to_stop() const;

  // Rows and fields after the state before the last step, at the start those of the start.
  void write_output(bool at_start, const std::vector<DueOutput>& due_now);
  void log_traffic() const;
  RunSoFar so_far() const { return {loop_, scene_, start_energy_}; }
  RunProgress progress() const;
  int finish(const Ending& ending);
  int give_up(ExitKind kind, const std::string& reason);
  std::string what_is_left() const;

  const Scene& scene_;
  const RunOptions& options_;
  using Clock = std::chrono::steady_clock;
  Clock::time_point launched_ = Clock::now();
  TimeLoop loop_;
  // The others end when this process does, with the code that it ends with: that of bad input unless it gets
  // to its steps.
  struct Dismissal {
    const TimeLoop& loop;
    int code = 2;
    ~Dismissal() { loop.dismiss(code); }
  } dismissal_{loop_};
  double core_seconds_of_others_ = 0.0;  // when it was last asked
  EnergyTerms start_energy_;             // of the scene's start, whatever it is resumed from
  Alarms alarms_;
  bool begins_ = true;  // not resumed
  RunWriter writer_;
  RunLog log_;
  Scalars last_row_;  // of series.csv
  ProgressLine progress_line_;
  double started_core_ = core_seconds();
  Clock::time_point started_ = Clock::now(), last_checkpoint_ = started_;  // of the steps
};

RunWriter Run::open_writer() {
  const RunStart start{"granvof",        options_.command, processes_of(options_),
                       options_.threads, ledger_terms(),   parts_of_model(scene_).act};
  if (!options_.resume)
    return RunWriter::fresh(options_.out, scene_, start, monitor_columns(), options_.force);
  ResumedRun resumed = RunWriter::resume(options_.out, scene_, start, monitor_columns());
  if (!resumed.checkpoint) {
    spdlog::warn("{}: {} has no checkpoint, the run begins anew", scene_.name, options_.out.string());
    return std::move(resumed.writer);
  }
  begins_ = false;
  loop_.restore(*resumed.checkpoint);
  alarms_.restore(std::move(resumed.warnings));
  return std::move(resumed.writer);
}

// The flow knows nothing of its output: no step is cut for it. What falls into a step is interpolated between
// the two states; monitors are those of that step.
void Run::write_output(bool at_start, const std::vector<DueOutput>& due_now) {
  if (due_now.empty()) return;
  const State& now = loop_.whole_now();
  const State& earlier = at_start ? now : loop_.whole_before();
  for (const DueOutput& due : due_now) {
    const CellFields fields = cell_fields(loop_.whole_grid(), earlier, now, due.time);
    if (due.row) {
      std::vector<Value> row;
      for (const MonitorEntry& monitor : monitors_of_a_step()) row.emplace_back(monitor.value(so_far()));
      const EnergyTerms energy = energy_terms_at(earlier, now, due.time);
      for (const EnergyTerm& term : energy_terms) row.emplace_back(energy.*term.value);
      last_row_ = extract_scalars(fields, scene_);
      writer_.write_series_row(due.time, row, last_row_);
      progress_line_.add(last_row_);
    }
    if (due.fields) writer_.write_fields(fields);
  }
}

RunProgress Run::progress() const {
  const RunCounters& counters = loop_.counters();
  const Monitors& monitors = loop_.monitors();
  const EnergyTerms& energy = loop_.now().energy;
  RunProgress p;
  p.steps = counters.steps;
  p.refused_steps = counters.refused_steps;
  p.cells = static_cast<std::int64_t>(loop_.whole_grid().cells.count());
  p.simulated_time = std::min(loop_.now().time, scene_.times.end);
  p.wall_seconds = counters.wall_seconds + seconds_since(started_);
  p.core_seconds = counters.core_seconds + core_seconds() - started_core_ + core_seconds_of_others_;
  p.cost = loop_.cost();
  p.solid_volume_error = monitors.solid_volume_error();
  p.liquid_volume_error = monitors.liquid_volume_error();
  p.solid_fraction_max = monitors.solid_fraction_max();
  for (const MonitorEntry& monitor : monitors_of_a_run()) p.monitors[monitor.name] = monitor.value(so_far());
  for (const EnergyTerm& term : energy_terms) p.monitors[term.name] = energy.*term.value;
  p.warnings = alarms_.raised();
  return p;
}

int Run::finish(const Ending& ending) {
  progress_line_.clear();
  const RunExit& exit = ending.exit;
  core_seconds_of_others_ = loop_.core_seconds_of_others();
  const RunProgress done = progress();
  if (ending.undo_last_step) loop_.step_back();
  writer_.write_checkpoint(loop_.checkpoint(done), done);
  const bool finished = exit.state == ExitState::finished;
  if (!finished) spdlog::error("{}: {}; {}", scene_.name, exit.reason, what_is_left());
  writer_.finish(done, exit);
  log_traffic();
  if (finished) spdlog::info(closing_line(scene_, done, last_row_, options_.out));
  if (exit.kind == ExitKind::wall_clock_limit) return exit_code_at_wall_clock_limit;
  return finished ? 0 : 1;
}

void Run::log_traffic() const {
  if (options_.processes == nullptr) return;
  const Communicator::Traffic t = options_.processes->traffic();
  const double steps = static_cast<double>(std::max<std::int64_t>(1, loop_.counters().steps));
  spdlog::info(
      "{}: {} processes; the first sent {:.1f} messages of {:.3g} MB in all a step and met the others "
      "{:.1f} times",
      scene_.name, processes_of(options_), static_cast<double>(t.messages) / steps,
      1e-6 * static_cast<double>(t.bytes) / steps, static_cast<double>(t.meetings) / steps);
}

std::string Run::what_is_left() const {
  const auto saved = writer_.checkpoint_time();
  return saved ? fmt::format("--resume goes on from t = {:.6g} s, {}", *saved,
                             writer_.checkpoint_path().string())
               : "there is no checkpoint to go on from";
}

int Run::give_up(ExitKind kind, const std::string& reason) {
  progress_line_.clear();
  const std::string at = fmt::format("stopped at t = {:.6g} s: {}", loop_.now().time, reason);
  spdlog::error("{}: {}; {}", scene_.name, at, what_is_left());
  writer_.give_up(progress(), at, kind);
  return 1;
}

int Run::go() {
  try {
    writer_.write_progress(progress());  // run.json must not show an old end while this goes on
    writer_.open_beside([this](const auto& directory) { log_.open(directory, !begins_); });
    spdlog::info("{}: granvof {}, {} thread{}: {}", scene_.name, build_info().version, options_.threads,
                 options_.threads == 1 ? "" : "s", options_.command);
    if (begins_) write_output(true, due_output(scene_.times, -1.0, loop_.now().time));
    return dismissal_.code = steps();
  } catch (const OutputError& error) {
    return dismissal_.code =
               give_up(ExitKind::output, fmt::format("its output cannot be written: {}", error.what()));
  } catch (const std::exception& error) {
    dismissal_.code = give_up(ExitKind::error, error.what());
    // The others may wait in a step that this one has left.
    if (options_.processes != nullptr) options_.processes->abort(dismissal_.code);
    return dismissal_.code;
  }
}

int Run::steps() {
  // A step at least comes before it is asked to stop: a limit that the start-up alone takes must not hold it
  // for ever.
  const std::array<TimeLoop::Observer, 6> observers{
      [this] { return write_what_is_due(); }, [this] { return raise_alarms(); },
      [this] { return end_of_scene(); },      [this] { return write_checkpoint_in_time(); },
      [this] { return show_progress(); },     [this] { return asked_to_stop(); }};
  return finish(loop_.run(observers));
}

std::optional<TimeLoop::Ending> Run::write_what_is_due() {
  write_output(false, due_output(scene_.times, loop_.before().time, loop_.now().time));
  return std::nullopt;
}

std::optional<TimeLoop::Ending> Run::raise_alarms() {
  const RunCounters& counters = loop_.counters();
  const std::string why = alarms_.check(
      loop_.now(), loop_.monitors(), {counters.steps, counters.unconverged_friction, counters.refused_steps});
  if (why.empty()) return std::nullopt;
  // The state that raised the alarm is no good one.
  return Ending{{ExitState::failed, why, ExitKind::alarm}, true};
}

std::optional<TimeLoop::Ending> Run::end_of_scene() const {
  if (loop_.now().time < scene_.times.end) return std::nullopt;
  // The last step led to or beyond the end. A longer run goes on from before it, as if there had been no end.
  return Ending{{ExitState::finished, {}}, true};
}

std::optional<TimeLoop::Ending> Run::write_checkpoint_in_time() {
  const double interval = scene_.times.checkpoint_interval;
  if (interval > 0.0 && seconds_since(last_checkpoint_) >= interval) {
    core_seconds_of_others_ = loop_.core_seconds_of_others();
    const RunProgress p = progress();
    writer_.write_checkpoint(loop_.checkpoint(p), p);
    last_checkpoint_ = Clock::now();
  }
  return std::nullopt;
}

std::optional<TimeLoop::Ending> Run::show_progress() {
  const PressureReport& pressure = loop_.last_step().pressure;
  progress_line_.show(progress(), loop_.last_dt(), pressure.newton, pressure.linear);
  return std::nullopt;
}

std::optional<TimeLoop::Ending> Run::asked_to_stop() const {
  if (const int signal = loop_.stop_signal_of_any(); signal != 0)
    return Ending{{ExitState::stopped, stop_reason(signal),
                   signal == SIGXCPU ? ExitKind::cpu_limit : ExitKind::signal}};
  if (options_.stop_after && seconds_since(launched_) >= *options_.stop_after)
    return Ending{{ExitState::stopped,
                   fmt::format("stopped after {} (--stop-after)", duration_text(*options_.stop_after)),
                   ExitKind::wall_clock_limit}};
  return std::nullopt;
}

}  // namespace

int run_case(const Scene& scene, const RunOptions& options) {
  check_memory(scene, processes_of(options));
  check_cut(scene, processes_of(options));
  omp_set_num_threads(std::max(1, options.threads));
  listen_to_stop_signals();
  if (options.processes != nullptr && options.processes->rank() > 0) return follow(scene, *options.processes);
  return Run(scene, options).go();
}

}  // namespace granvof
