// run.json: what ran, on what, what it cost, and how it ended.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solver/output/case_changes.hpp"
#include "solver/output/series_file.hpp"
#include "solver/scene/parts.hpp"
#include "solver/scene/scene.hpp"

namespace granvof {

// Version of the layout of a run directory; raised by a change that an older reader would misread.
inline constexpr int output_contract_version = 1;

enum class ExitState { running, finished, failed, stopped };

// A term of the energy ledger of the program, as its readers need it: how a column of series.csv counts.
struct LedgerTerm {
  std::string name;  // of the column
  std::string part;  // of the model, whose work it is
  std::string kind;  // stored, dissipated, outside, numerical, part, residual
  int sign = 0;      // of the column in the sum of changes and losses that vanishes but for the residual
  bool never_gains = false;
  std::string label, meaning, measured_in;
};

// Why a run failed or was stopped, for programs: `exit.kind` of run.json, whose names are those of name_of().
enum class ExitKind {
  step_collapse,     // no step above dt_min was accepted
  not_finite,        // the same, and the last one tried gave a field that is not finite
  alarm,             // a monitor passed a limit beyond which there is no result
  output,            // its output could not be written
  error,             // anything else
  signal,            // it was asked to end
  cpu_limit,         // by the limit of its CPU time (SIGXCPU)
  wall_clock_limit,  // by the limit it was given itself (--stop-after)
};
std::string_view name_of(ExitKind kind);

// What is known before the first step.
struct RunStart {
  std::string program;  // "granvof" or "demvof"
  std::string command;  // the command line
  int ranks = 1;
  int threads = 1;                      // of each rank
  std::vector<LedgerTerm> ledger;       // empty: the program keeps none
  std::vector<const Part*> parts = {};  // of the model that act in the scene, as the program has them
};

// A monitor that passed its limit.
struct Warning {
  std::string monitor;
  double time = 0.0;   // of the first passing [s]
  double value = 0.0;  // the worst
  double limit = 0.0;
  std::string meaning;
};

// What is known while it goes on, over all resumed parts of the run.
struct RunProgress {
  std::int64_t steps = 0;
  std::int64_t refused_steps = 0;
  std::int64_t cells = 0;
  double simulated_time = 0.0;             // [s]
  double wall_seconds = 0.0;               // of the time loop
  double core_seconds = 0.0;               // CPU time of the time loop, all threads and ranks
  std::map<std::string, double> cost;      // part of the time step -> wall seconds
  double solid_volume_error = 0.0;         // largest relative change of the solid volume [-]
  double liquid_volume_error = 0.0;        // [-]
  double solid_fraction_max = 0.0;         // largest f_s that ever occurred [-]
  std::map<std::string, double> monitors;  // further numbers of the program (iterations, energies, ...)
  std::vector<Warning> warnings;           // monitors that passed their limits
};

struct RunExit {
  ExitState state = ExitState::running;
  std::string reason;  // empty unless failed or stopped
  std::optional<ExitKind> kind =
      std::nullopt;  // none: an error where it failed, a signal where it was stopped
};

struct Resumption {
  std::string date;   // ISO 8601, UTC
  double time = 0.0;  // simulated time from which the run went on [s]
  int threads = 1;
  std::vector<CaseChange> changes;  // of the case, since the part before
};

struct RunRecord {
  RunStart start;
  std::string start_date;  // ISO 8601, UTC
  std::vector<Resumption> resumptions;
};

// What the run directory holds, for a reader to check what it finds there.
struct FilesWritten {
  SeriesFacts series;
  std::size_t instants = 0;          // of fields.h5
  std::string fields_sha256;         // of fields.h5 once it is one file; empty until then
  std::optional<double> checkpoint;  // time of checkpoint.h5 [s]: what the run can go on from
};

// The text of run.json, sealed (seal.hpp). Numbers that are not finite become null.
std::string run_record_text(const Scene& scene, const RunRecord& record, const RunProgress& progress,
                            const FilesWritten& files, const RunExit& exit);

// A run.json that says "running" with another end: the program that wrote it was ended before it could write
// its own. Nothing where it states an end already, or is no whole run.json.
std::optional<std::string> ended_record_text(const std::string& run_json, const RunExit& exit);

// What resuming and overwriting need of an existing run.json; nullopt if the file is not a granvof run.json.
// Throws OutputError where something in it was changed since it was written.
struct ExistingRun {
  RunRecord record;
  std::string program;
  std::string version;
  std::string scene;
  std::string case_hash;
  std::string resolved_case;
  std::vector<Warning> warnings;
  bool has_checkpoint = false;  // as it says itself
  double time = 0.0;            // how far it came [s]
  SeriesFacts series;           // rows and digest alone
};
std::optional<ExistingRun> read_existing_run(const std::filesystem::path& run_json);

// Now, as ISO 8601 in UTC, to the second.
std::string iso_date_now();

}  // namespace granvof
