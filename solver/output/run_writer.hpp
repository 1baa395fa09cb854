// The run directory: series.csv, fields.h5, fields.xdmf, run.json and checkpoint.h5; run.log is
// run/run_log.hpp's.
//
// Nothing in the directory is touched before the first write of any kind; a run that fails while it is being
// set up leaves an earlier run as it was. Every file on disk is complete at every moment (series.csv up to
// its last newline), so that a full disk or a kill costs at most what was being written.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "solver/output/atomic_file.hpp"
#include "solver/output/checkpoint.hpp"
#include "solver/output/extract.hpp"
#include "solver/output/fields_file.hpp"
#include "solver/output/run_record.hpp"
#include "solver/output/series_file.hpp"
#include "solver/scene/scene.hpp"

namespace granvof {

// Whether a run, or one that was killed, leaves a file or a folder of this name in its directory.
bool is_name_of_a_run(const std::string& name);
// Removes them, and of the folder of instants what is an instant. Throws OutputError.
void remove_run(const std::filesystem::path& directory);

struct ResumedRun;

class RunWriter {
 public:
  // A run from the beginning. `monitors` are the program's own columns, between time and the scalars of
  // extract.hpp. Throws OutputError if `directory` cannot be made or written, is in use by another run, holds
  // files but no run, or, without `force`, a run that this one would not give again: of another program,
  // scene or case but for its end and its output.
  static RunWriter fresh(const std::filesystem::path& directory, const Scene& scene, const RunStart& start,
                         std::span<const Column> monitors, bool force = false);
  // The run of `directory` continued from its checkpoint: later rows and instants are removed; from its
  // beginning where it was ended before its first checkpoint. Throws OutputError if the directory holds no
  // run or that of another case or program, if anything of the case has changed but what may
  // (case_changes.hpp), or if rows or instants up to the checkpoint are not those that the case asks for.
  static ResumedRun resume(const std::filesystem::path& directory, const Scene& scene, const RunStart& start,
                           std::span<const Column> monitors);

  // A row of series.csv; `monitors` in the order of the columns given at the start.
  void write_series_row(double time, std::span<const Value> monitors, const Scalars& scalars);
  // An instant of fields.h5, fields.xdmf rewritten.
  void write_fields(const CellFields& fields);
  // series.csv flushed, checkpoint.h5 replaced, run.json brought up to date. Rows and instants due up to the
  // time of the state must have been written.
  void write_checkpoint(const CheckpointView& state, const RunProgress& progress);
  // run.json alone, state "running": the first call of a run that goes on or begins.
  void write_progress(const RunProgress& progress);
  // The last call: fields.h5 joined if the run finished, run.json with its exit state.
  void finish(const RunProgress& progress, const RunExit& exit);
  // Instead of finish() where that or another call has thrown: run.json says why, if it can be written at
  // all.
  void give_up(const RunProgress& progress, const std::string& reason,
               ExitKind kind = ExitKind::error) noexcept;
  // Where a copy of this process wrote on, and was ended before it could say how: run.json, as the copy left
  // it, with this end, unless it states one.
  void note_end_of_copy(const std::string& reason) noexcept;

  std::filesystem::path checkpoint_path() const;
  // Calls `open` with a path to the directory that this run has locked, whatever stands under its name by
  // now: for a file that another writes there. Throws what it throws, an OutputError with the name of the
  // directory.
  void open_beside(const std::function<void(const std::filesystem::path&)>& open) const;
  // Time of the checkpoint on the disk [s]; none yet, or none any more, none.
  std::optional<double> checkpoint_time() const;

 private:
  RunWriter(std::filesystem::path directory, Scene scene, RunStart start, std::span<const Column> monitors);
  struct SavedState {
    std::optional<Checkpoint> checkpoint;
    std::vector<Warning> warnings;
  };
  void check_replaceable(bool force) const;
  SavedState read_saved();
  template <typename Action>
  auto by_given_name(const Action& action) const;
  void start_writing();
  bool is_in_place() const;
  void require_in_place() const;
  void start_fresh();
  void start_resumed(double time);
  void bring_files_up_to_date();
  void write_record(const RunProgress& progress, const RunExit& exit);
  void replace_record(const std::string& text);
  FilesWritten files() const;

  std::filesystem::path directory_;  // as given: for messages
  Descriptor lock_;
  std::filesystem::path locked_;  // the same by what the lock holds: for every file
  Scene scene_;
  RunRecord record_;
  std::vector<Column> columns_;
  std::optional<double> resume_time_, checkpoint_time_;
  std::string fields_sha256_;
  bool begun_ = false;  // run.json is that of this run
  std::optional<SeriesFile> series_;
  std::optional<FieldsFile> fields_;
};

struct ResumedRun {
  RunWriter writer;
  std::optional<Checkpoint> checkpoint;  // none: the run begins anew
  std::vector<Warning> warnings;         // that the earlier parts raised
};

// All columns of a series.csv: time, the program's monitors, the scalars.
std::vector<Column> series_columns(std::span<const Column> monitors);

}  // namespace granvof
