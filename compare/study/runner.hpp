// Runs of one case under overrides, made by the program granvof and kept for later.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compare/engine/engine.hpp"
#include "compare/input/run.hpp"
#include "compare/study/cache_lock.hpp"

namespace granvof::compare {

struct Job {
  std::filesystem::path case_file;
  std::vector<std::string> set;  // overrides "key=value"
};

// How a job ended. With `run` it finished and can be measured; without, `failure` says why not.
struct Outcome {
  std::optional<Run> run;
  std::string failure;
  bool refused = false;           // the case itself was refused: no run was started
  std::optional<RunFacts> facts;  // where run.json could be read
  double core_seconds =
      0.0;  // CPU time of the time loop, the least of `repeats`, without start-up and output
  double simulated_seconds = 0.0;  // how far it came
  double work_unit_seconds = 0.0;  // of the calibration kernel, timed before and after (mean)
  int repeats = 0;
  double noise =
      0.0;  // relative uncertainty of the cost: spread of the repeats, and of the kernel's timings [-]
  bool kept = false;  // taken from the cache

  // [core-s per simulated s]; 0 where nothing was simulated.
  double cost() const { return simulated_seconds > 0.0 ? core_seconds / simulated_seconds : 0.0; }
  // Work units per simulated second.
  double work() const { return work_unit_seconds > 0.0 ? cost() / work_unit_seconds : 0.0; }
};

class Runner {
 public:
  virtual ~Runner() = default;
  virtual Outcome run(const Job& job) = 0;
  // Whether run() would give back a kept run, or refuse the case, without starting one.
  virtual bool has(const Job& job) = 0;
};

// A run cheaper than cheap_run (compare/engine/order.hpp) is timed so often.
inline constexpr int timings_of_a_cheap_run = 3;

struct RunnerOptions {
  std::filesystem::path program;  // granvof
  std::filesystem::path cache;    // run directories, one a job, below CACHE/SCENE/
  double timeout = 3600.0;        // wall-clock seconds after which a run is ended and counts as failed
  bool any_version = false;  // also take what another version of the program, or of the case, left for the
                             // same case and overrides; what is shown names that version
  int timings = timings_of_a_cheap_run;
  bool progress = true;  // a line on stderr for every run that is made
};

// A run that somebody stopped is no result: run() throws.
// Runs are made by the run engine, timed: one at a time. A job is identified by its resolved case and the
// program; what was made is not made again (compare/engine/made.hpp). The cache is locked while the runner
// lives. Throws std::runtime_error where the program cannot be started, or another study works in the cache.
class CachedRunner : public Runner {
 public:
  explicit CachedRunner(RunnerOptions options);
  Outcome run(const Job& job) override;
  bool has(const Job& job) override;
  const std::string& version() const { return version_; }

  // What run() has the engine make, for somebody else to make; the case must be accepted.
  Order order_of(const Job& job) const;

 private:
  Order order_of(const Job& job, const Scene& scene) const;
  std::optional<Outcome> kept(const Job& job, const Scene& scene, const Order& order) const;
  Outcome make(const Scene& scene, const Order& order);

  RunnerOptions options_;
  // Before the cache is made and locked: nothing is written where the program is none.
  std::string version_;   // as `granvof --version` states it
  std::string identity_;  // of the program
  CacheLock lock_;
  Engine engine_;
};

}  // namespace granvof::compare
