// A coupled run as its output sees it: states between which rows and fields are interpolated, so that no
// step of the fluid is cut for them.
#pragma once

#include <vector>

#include "reference/demvof/coupling/coupled_run.hpp"
#include "reference/demvof/coupling/energy_ledger.hpp"
#include "solver/output/cell_fields.hpp"
#include "solver/output/output_schedule.hpp"
#include "solver/output/run_record.hpp"
#include "solver/output/run_writer.hpp"
#include "solver/output/series_file.hpp"
#include "solver/scene/scene.hpp"

namespace demvof {

// Of the columns of a recording that are its own, beside those of every program.
std::vector<granvof::Column> monitor_columns();

// What is written of one state.
struct Instant {
  std::vector<granvof::Value> monitors;  // as monitor_columns()
  granvof::CellFields fields;
};

// The instant at `time`, earlier.fields.time < time <= later.fields.time [s], linear in time: volumes
// (f_s, alpha f_c), pressure, the velocity of the fluid, momentum and f_s Theta of the beads, monitors. The
// length of the last step is that of the step that led to `later`; a monitor that one of the two has not is
// none.
Instant between(const Instant& earlier, const Instant& later, double time);

// The gate, for beads and fluid.
class GateKeeper {
 public:
  GateKeeper(CoupledRun& run, const granvof::Scene& scene, bool stays);
  void release();
  void follow(double time);  // [s] since the release

 private:
  CoupledRun& run_;
  const granvof::Scene& scene_;
  bool present_ = false, stays_ = false, bead_plate_ = false;
  int face_ = 0;
};

// The face of the fluid cells on which the gate stands.
int gate_face(const granvof::Scene& scene);

// A run that is being recorded; `progress` is kept up to date but for its times and costs.
class Recording {
 public:
  // `hold` [s]: the release is at that time of `run`. All are referred to.
  Recording(CoupledRun& run, const granvof::Scene& scene, granvof::RunWriter& writer,
            granvof::RunProgress& progress, double hold);

  double now() const { return run_.time() - hold_; }  // [s] since the release
  // Steps of equal length to the release, which is an event of the flow; `after_step` after each.
  template <class AfterStep>
  void advance_to_release(double half_a_bead_step, AfterStep&& after_step) {
    while (now() < -half_a_bead_step) {
      count(run_.step(-now()));
      after_step();
    }
  }
  // What is due at the release, from which on energy is counted.
  void begin();
  // One step, as long as the flow allows, and the rows and fields that it passes. True where it wrote a row.
  bool advance();
  bool done() const { return next_ == due_.size() && now() >= scene_.times.end; }

 private:
  void count(double step);
  Instant observe() const;
  bool write(const Instant& instant, const granvof::DueOutput& due);

  CoupledRun& run_;
  const granvof::Scene& scene_;
  granvof::RunWriter& writer_;
  granvof::RunProgress& progress_;
  double hold_;
  EnergyLedger ledger_;
  std::vector<granvof::DueOutput> due_;
  std::size_t next_ = 0;  // of due_
  double liquid_start_;   // [m3]
  double last_step_ = 0.0;
};

}  // namespace demvof
