// The run directory: series.csv, fields.h5, fields.xdmf, run.json and checkpoint.h5.
//
// Nothing in the directory is touched before the first write of any kind; a run that fails while it is being
// set up leaves an earlier run as it was. Every file on disk is complete at every moment (series.csv up to
// its last newline), so that a full disk or a kill costs at most what was being written.
#pragma once

#include <filesystem>
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

class RunWriter {
 public:
  // A run from the beginning. `monitors` are the program's own columns, between time and the scalars of
  // extract.hpp. Throws OutputError if `directory` cannot be made or written, is in use by another run, or
  // holds files but no run.
  static RunWriter fresh(const std::filesystem::path& directory, const Scene& scene, const RunStart& start,
                         std::span<const Column> monitors);
  // The run of `directory` continued from a checkpoint of time `time` [s]: later rows and instants are
  // removed. Throws OutputError also if the directory holds a run of another case or program. A row and an
  // instant due at the time of a checkpoint must be written before it.
  static RunWriter resume(const std::filesystem::path& directory, const Scene& scene, const RunStart& start,
                          std::span<const Column> monitors, double time);

  // A row of series.csv; `monitors` in the order of the columns given at the start.
  void write_series_row(double time, std::span<const Value> monitors, const Scalars& scalars);
  // An instant of fields.h5, fields.xdmf rewritten.
  void write_fields(const CellFields& fields);
  // series.csv flushed, checkpoint.h5 replaced, run.json brought up to date.
  void write_checkpoint(const CheckpointView& state, const RunProgress& progress);
  // run.json alone, state "running". A fresh run's first write makes it by itself; a resumed run calls this
  // first.
  void write_progress(const RunProgress& progress);
  // The last call: fields.h5 joined if the run finished, run.json with its exit state.
  void finish(const RunProgress& progress, const RunExit& exit);

  std::filesystem::path checkpoint_path() const { return directory_ / "checkpoint.h5"; }

 private:
  RunWriter(std::filesystem::path directory, Scene scene, RunStart start, std::span<const Column> monitors,
            std::optional<double> resume_time);
  void start_writing();
  void start_fresh();
  void start_resumed(double time);
  void write_record(const RunProgress& progress, const RunExit& exit) const;

  std::filesystem::path directory_;
  Scene scene_;
  RunRecord record_;
  std::vector<Column> columns_;
  std::optional<double> resume_time_;
  Descriptor lock_;
  std::optional<SeriesFile> series_;
  std::optional<FieldsFile> fields_;
};

// All columns of a series.csv: time, the program's monitors, the scalars.
std::vector<Column> series_columns(std::span<const Column> monitors);

}  // namespace granvof
