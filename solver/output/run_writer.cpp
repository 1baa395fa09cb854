#include "solver/output/run_writer.hpp"

#include <array>
#include <cerrno>
#include <cstdint>
#include <stdexcept>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>

#include "solver/output/output_error.hpp"

namespace granvof {

namespace {

namespace fs = std::filesystem;

constexpr const char* series_name = "series.csv";
constexpr const char* record_name = "run.json";

// Everything that a run leaves in its directory, but run.json.
constexpr std::array owned_names = {"checkpoint.h5", "fields.xdmf", "fields.h5", "fields", series_name};

// One program writes into a directory at a time; the lock ends with the program.
Descriptor lock_directory(const fs::path& directory) {
  Descriptor lock(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!lock.valid()) throw OutputError("write to", directory, std::generic_category().message(errno));
  if (::flock(lock.get(), LOCK_EX | LOCK_NB) != 0) {
    throw OutputError(
        "write to", directory,
        errno == EWOULDBLOCK ? "another run is writing there" : std::generic_category().message(errno));
  }
  return lock;
}

}  // namespace

std::vector<Column> series_columns(std::span<const Column> monitors) {
  std::vector<Column> columns{{"time", "s", "simulated time"}};
  columns.insert(columns.end(), monitors.begin(), monitors.end());
  for (const auto& entry : scalar_table()) {
    columns.push_back({std::string(entry.name), std::string(entry.unit), std::string(entry.description)});
  }
  return columns;
}

RunWriter::RunWriter(fs::path directory, Scene scene, RunStart start, std::span<const Column> monitors,
                     std::optional<double> resume_time)
    : directory_(std::move(directory)),
      scene_(std::move(scene)),
      record_{std::move(start), iso_date_now(), {}},
      columns_(series_columns(monitors)),
      resume_time_(resume_time) {}

RunWriter RunWriter::fresh(const fs::path& directory, const Scene& scene, const RunStart& start,
                           std::span<const Column> monitors) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (error) throw OutputError("create", directory, error.message());
  RunWriter writer(directory, scene, start, monitors, std::nullopt);
  writer.lock_ = lock_directory(directory);
  if (!fs::is_empty(directory) && !read_existing_run(directory / record_name)) {
    throw OutputError("write to", directory,
                      "it holds files but no run of granvof; give an empty or new directory");
  }
  return writer;
}

RunWriter RunWriter::resume(const fs::path& directory, const Scene& scene, const RunStart& start,
                            std::span<const Column> monitors, double time) {
  RunWriter writer(directory, scene, start, monitors, time);
  writer.lock_ = lock_directory(directory);
  const auto existing = read_existing_run(directory / record_name);
  if (!existing) throw OutputError("resume", directory, "it holds no run of granvof");
  if (existing->program != start.program) {
    throw OutputError("resume", directory, fmt::format("it is a run of {}", existing->program));
  }
  if (existing->case_hash != scene.hash) {
    throw OutputError(
        "resume", directory,
        fmt::format("it is of a case with hash {}, this case has {}", existing->case_hash, scene.hash));
  }
  writer.record_.start_date = existing->record.start_date;
  writer.record_.resumptions = existing->record.resumptions;
  writer.record_.resumptions.push_back({iso_date_now(), time});
  return writer;
}

void RunWriter::start_writing() {
  if (series_) return;
  if (resume_time_) {
    start_resumed(*resume_time_);
  } else {
    start_fresh();
  }
}

void RunWriter::start_fresh() {
  // The new run.json is on the disk before anything of an earlier run goes, and takes its name last: a
  // directory whose replacement was cut short is still known as a run.
  const auto record = directory_ / record_name;
  RunProgress nothing;
  nothing.cells = std::int64_t{1} * scene_.grid.cells[0] * scene_.grid.cells[1] * scene_.grid.cells[2];
  write_beside(record, run_record_text(scene_, record_, nothing, {}));
  for (const char* name : owned_names) {
    std::error_code error;
    fs::remove_all(directory_ / name, error);
    if (error) throw OutputError("replace", directory_ / name, error.message());
  }
  rename_into_place(record);
  fields_ = FieldsFile::create(directory_, scene_);
  series_ = SeriesFile::create(directory_ / series_name, columns_);
}

void RunWriter::start_resumed(double time) {
  fields_ = FieldsFile::resume(directory_, scene_, time);
  series_ = SeriesFile::resume(directory_ / series_name, columns_, time);
}

void RunWriter::write_series_row(double time, std::span<const Value> monitors, const Scalars& scalars) {
  start_writing();
  std::vector<Value> row{time};
  row.insert(row.end(), monitors.begin(), monitors.end());
  row.insert(row.end(), scalars.begin(), scalars.end());
  series_->append(row);
}

void RunWriter::write_fields(const CellFields& fields) {
  start_writing();
  fields_->append(fields);
}

void RunWriter::write_checkpoint(const CheckpointView& state, const RunProgress& progress) {
  start_writing();
  series_->flush_to_disk();
  granvof::write_checkpoint(checkpoint_path(), scene_, state);
  write_record(progress, {});
}

void RunWriter::write_progress(const RunProgress& progress) {
  start_writing();
  write_record(progress, {});
}

void RunWriter::finish(const RunProgress& progress, const RunExit& exit) {
  start_writing();
  series_->flush_to_disk();
  // A run that may go on keeps its instants apart; where joining fails the linked form stays, just as
  // readable.
  if (exit.state == ExitState::finished) fields_->join();
  write_record(progress, exit);
}

void RunWriter::write_record(const RunProgress& progress, const RunExit& exit) const {
  write_file_atomically(directory_ / record_name, run_record_text(scene_, record_, progress, exit));
}

}  // namespace granvof
