// What a run must not do silently: bounds on its monitors, and the first time each was passed.
//
// A solver that fails loudly costs an afternoon, one that is wrong silently costs a paper. Every accepted
// step is held against these limits; the first passing warns on stderr, and run.json lists all with their
// worst value. A run that has more energy in motion than it was ever given is stopped.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "solver/output/run_record.hpp"
#include "solver/run/monitors.hpp"

namespace granvof {

// Energy that a run turned over [J], which its errors are shares of: all dissipation, numerical included by
// magnitude, what is in motion and what was carried out in all. A scene at rest turns nothing over, hence at
// least a share of what it stores (a pool whose level trembles by 0.04 mm/s, as the sharpened interface does
// after ten seconds, moves 1e-9 of it) and of the bed's own energy.
double energy_turnover(const Scene& scene, const EnergyTerms& start, const EnergyTerms& now);

// What numerics, and the work of solid pressure that nothing pays for, gave the flow so far, as a share of
// what it was given otherwise: by its stores, the walls and the sides [-]. What was created is in motion, or
// was dissipated, too: a share of that would never pass a half. A flow that does next to nothing counts by a
// hundredth of the bed's own energy.
double energy_created(const Scene& scene, const EnergyTerms& now);

// What numerics took from the flow so far, as a share of all that became of its energy: dissipated, in
// motion, carried out, or taken so [-]. Next to nothing counts as above.
double energy_destroyed(const Scene& scene, const EnergyTerms& now);

struct StepCounts {
  std::int64_t steps = 0, unconverged_friction = 0, refused = 0;
};

// What alarms look at, after an accepted step.
struct Watched {
  const Scene& scene;
  const EnergyTerms& start;
  const State& state;
  double turnover;  // energy_turnover() of the state [J]
  const Monitors& monitors;
  const StepCounts& counts;
};

struct Alarm {
  const char* monitor;
  const Part& part;  // of whose work it speaks
  const char* meaning;
  double (*value)(const Watched&);
  double (*limit)(const Watched&);  // which the value must not exceed
  // What a warning adds to the meaning, of the step that passed the limit first.
  std::string (*detail)(const Watched&) = nullptr;
};

class Alarms {
 public:
  Alarms(const Scene& scene, const EnergyTerms& start);

  // Every alarm there is, but the one that stops a run: see check().
  static std::span<const Alarm> list();

  // After an accepted step. Returns why the run must stop, or nothing.
  std::string check(const State& s, const Monitors& monitors, const StepCounts& counts);

  const std::vector<Warning>& raised() const { return raised_; }
  // Those of the earlier parts of a resumed run.
  void restore(std::vector<Warning> raised) { raised_ = std::move(raised); }

 private:
  void watch(const Alarm& alarm, const Watched& watched);

  const Scene& scene_;
  EnergyTerms start_;
  std::vector<Warning> raised_;
};

}  // namespace granvof
