// The time loop: accepted steps of a scene, one after another. What a run does beside (output, alarms, ends)
// are observers; a test takes steps and measures between them.
//
// Where the tank is cut among processes, the lowest of them leads: it alone calls what changes the loop or
// asks for the whole state, and ends with dismiss(). The others follow().
#pragma once

#include <ctime>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>

#include "solver/output/run_record.hpp"
#include "solver/run/checkpoint_state.hpp"
#include "solver/run/monitors.hpp"
#include "solver/run/step_control.hpp"
#include "solver/run/time_step.hpp"
#include "solver/run/whole_tank.hpp"

namespace granvof {

class TimeLoop {
 public:
  // How a run ends, and whether the last step is no part of what is kept.
  struct Ending {
    RunExit exit;
    bool undo_last_step = false;
  };
  // Looks at the loop after an accepted step; what it returns ends the loop.
  using Observer = std::function<std::optional<Ending>()>;

  // At the start of the scene; it and the communicator (see Grid) must outlive this.
  explicit TimeLoop(const Scene& scene, const Communicator* communicator = nullptr);
  TimeLoop(const TimeLoop&) = delete;
  TimeLoop& operator=(const TimeLoop&) = delete;
  TimeLoop(TimeLoop&&) = delete;
  TimeLoop& operator=(TimeLoop&&) = delete;
  ~TimeLoop() = default;

  // At a checkpoint of the same scene, whatever number of processes wrote it. Throws OutputError where it
  // lacks something.
  void restore(const Checkpoint& saved);

  // Steps until an observer ends them, or none is accepted. Observers are asked in their order, those after
  // one that ends the loop are not.
  Ending run(std::span<const Observer> observers);
  // One accepted step of at most `longest` [s], tried shorter where it is refused; `extra`: sources of a
  // manufactured solution. Returns why none was accepted above dt_min: the state is the one before then.
  std::optional<RunExit> advance(double longest = std::numeric_limits<double>::infinity(),
                                 const BodyAcceleration* extra = nullptr);
  // To the state before the last step, which is forgotten; once after each.
  void step_back();

  // Does what the leading process does, until that dismisses it with the code that this returns.
  int follow();
  // Ends the following of the others; without others nothing.
  void dismiss(int code) const;
  // CPU time of the other processes in the time loop up to now [s].
  double core_seconds_of_others() const;
  // Of a signal that asked any of the processes to end (stop_signals.hpp); 0 where none was.
  int stop_signal_of_any() const;

  // Of the whole tank: where it is not cut, what now() and before() are; else collected by the call.
  const Grid& whole_grid() const { return tank_.grid(); }
  const State& whole_now();
  const State& whole_before();

  const Grid& grid() const { return grid_; }
  const Boundary& boundary() const { return boundary_; }
  // May be changed between steps; fill its ghosts then.
  State& now() { return now_; }
  const State& now() const { return now_; }
  const State& before() const { return next_; }           // the state before the last step
  const StepReport& last_step() const { return last_; }   // accepted or not
  double last_dt() const { return control_.last(); }      // of the last accepted step [s]
  double next_dt() const { return control_.next(now_); }  // that the next step is tried with [s]
  const Monitors& monitors() const { return monitors_; }
  const RunCounters& counters() const { return counters_; }
  std::map<std::string, double> cost() const { return step_.cost().seconds(); }
  // Into the whole state as it is; it must outlive the view.
  CheckpointView checkpoint(const RunProgress& progress);

 private:
  // What the leading process tells the others to do.
  struct Order {
    enum class Kind { advance, step_back, restore, collect_now, collect_before, account, agree, end } kind;
    double longest = 0.0;  // of advance
    int code = 0;          // of end
  };
  bool leads() const { return tank_.is_cut() && grid_.cells.communicator->rank() == 0; }
  void tell(Order order) const;
  std::optional<RunExit> take_step(double longest, const BodyAcceleration* extra);
  void forget_step();
  void restore_from_the_lowest();
  double sum_of_core_seconds() const;
  int highest_stop_signal() const;

  const Scene& scene_;
  Grid grid_;
  Boundary boundary_;
  WholeTank tank_;
  TimeStep step_;
  StepControl control_;
  State now_, next_;  // after a step next_ holds the state before it
  Monitors monitors_;
  RunCounters counters_;
  struct Marks {
    RunCounters counters;
    Monitors::Values monitors{};
    double dt = 0.0;
  } before_;  // those of the state before the last step
  StepReport last_;
  std::clock_t begun_ = std::clock();
  std::optional<State> whole_now_, whole_before_;  // of the leading process, where the tank is cut
};

}  // namespace granvof
