#include "solver/output/run_writer.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <stdexcept>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "solver/output/build_info.hpp"
#include "solver/output/open_file.hpp"
#include "solver/output/output_error.hpp"

namespace granvof {

namespace {

namespace fs = std::filesystem;

constexpr const char* series_name = "series.csv";
constexpr const char* checkpoint_name = "checkpoint.h5";
constexpr const char* record_name = "run.json";
constexpr double roundoff = 1e-9;  // times that differ by less are the same

// What a run leaves in its directory beside run.json and its fields, and drafts of a run that was killed.
constexpr std::array owned_names = {checkpoint_name, series_name, "run.log"};

void remove_owned(const fs::path& directory) {
  for (const char* name : owned_names) {
    for (const fs::path& file : {directory / name, directory / (std::string(name) + ".tmp")}) {
      std::error_code error;
      fs::remove(file, error);
      if (error) throw OutputError("replace", file, error.message());
    }
  }
  FieldsFile::remove(directory);
}

// Whether there is anything but the draft of a run that was killed in its first moment.
bool holds_anything(const fs::path& directory) {
  return std::any_of(fs::directory_iterator(directory), fs::directory_iterator(),
                     [](const auto& entry) { return entry.path().filename() != "run.json.tmp"; });
}

// Times of `asked` up to `last` [s].
std::span<const double> up_to(const std::vector<double>& asked, double last) {
  return {asked.begin(), std::upper_bound(asked.begin(), asked.end(), last)};
}

// Why `existing` is another run than that of `scene`; empty if it is not.
std::string difference(const ExistingRun& existing, const Scene& scene, const RunStart& start) {
  if (existing.program != start.program) return fmt::format("it is a run of {}", existing.program);
  if (existing.scene != scene.name)
    return fmt::format("it is a run of the scene {}, this is {}", existing.scene, scene.name);
  std::string changed;
  for (const CaseChange& change : case_changes(existing.resolved_case, scene.resolved))
    if (!may_change_on_resume(change.key)) changed += (changed.empty() ? "" : "; ") + change_text(change);
  if (!changed.empty()) return "it is a run of another case: " + changed;
  if (existing.case_hash != scene.hash)
    return fmt::format("it is of a case with hash {}, this case has {}", existing.case_hash, scene.hash);
  return "";
}

// One program writes into a directory at a time; the lock ends with the program.
Descriptor lock_directory(const fs::path& directory) {
  Descriptor lock(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!lock.valid()) throw OutputError("write to", directory, std::generic_category().message(errno));
  if (::access(directory.c_str(), W_OK) != 0)
    throw OutputError("write to", directory, std::generic_category().message(errno));
  if (::flock(lock.get(), LOCK_EX | LOCK_NB) != 0) {
    throw OutputError(
        "write to", directory,
        errno == EWOULDBLOCK
            ? "another run is writing there"
            : fmt::format("two runs could write there at once, its file system gives no locks ({}); give a "
                          "directory on another",
                          std::generic_category().message(errno)));
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

bool is_name_of_a_run(const std::string& name) {
  const std::string whole = name.ends_with(".tmp") ? name.substr(0, name.size() - 4) : name;
  return whole == record_name || whole == "fields.h5" || whole == "fields.xdmf" || name == "fields" ||
         std::find(owned_names.begin(), owned_names.end(), whole) != owned_names.end();
}

void remove_run(const fs::path& directory) {
  remove_owned(directory);
  for (const fs::path& file : {directory / record_name, directory / (std::string(record_name) + ".tmp")}) {
    std::error_code error;
    fs::remove(file, error);
    if (error) throw OutputError("remove", file, error.message());
  }
}

// Throws OutputError if the directory is in use by another run.
RunWriter::RunWriter(fs::path directory, Scene scene, RunStart start, std::span<const Column> monitors)
    : directory_(std::move(directory)),
      lock_(lock_directory(directory_)),
      locked_(path_by_descriptor(lock_, directory_)),
      scene_(std::move(scene)),
      record_{std::move(start), iso_date_now(), {}},
      columns_(series_columns(monitors)) {}

// What is done by the path of the lock, with the name that the user gave in its errors.
template <typename Action>
auto RunWriter::by_given_name(const Action& action) const {
  try {
    return action();
  } catch (const OutputError& error) {
    const auto named = [this](std::string text) {
      const std::string locked = locked_.string();
      for (auto at = text.find(locked); at != std::string::npos; at = text.find(locked, at + 1))
        text.replace(at, locked.size(), directory_.string());
      return text;
    };
    throw OutputError(error.action(), named(error.path().string()), named(error.cause()));
  }
}

RunWriter RunWriter::fresh(const fs::path& directory, const Scene& scene, const RunStart& start,
                           std::span<const Column> monitors, bool force) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (error) throw OutputError("create", directory, error.message());
  RunWriter writer(directory, scene, start, monitors);
  writer.by_given_name([&] { writer.check_replaceable(force); });
  return writer;
}

void RunWriter::check_replaceable(bool force) const {
  const auto existing = read_existing_run(locked_ / record_name);
  if (!existing && holds_anything(locked_)) {
    throw OutputError("write to", directory_,
                      "it holds files but no run of granvof; give an empty or new directory");
  }
  if (!existing || force) return;
  std::string lost = difference(*existing, scene_, record_.start);
  if (lost.empty() && existing->time > scene_.times.end * (1.0 + roundoff))
    lost = fmt::format("it is a run that came to t = {:.9g} s, this one ends at {:.9g} s", existing->time,
                       scene_.times.end);
  if (!lost.empty())
    throw OutputError("write to", directory_, lost + "; give another directory, or --force to replace it");
}

ResumedRun RunWriter::resume(const fs::path& directory, const Scene& scene, const RunStart& start,
                             std::span<const Column> monitors) {
  RunWriter writer(directory, scene, start, monitors);
  auto saved = writer.by_given_name([&] { return writer.read_saved(); });
  return {std::move(writer), std::move(saved.checkpoint), std::move(saved.warnings)};
}

RunWriter::SavedState RunWriter::read_saved() {
  const auto existing = read_existing_run(locked_ / record_name);
  const auto checkpoint_file = locked_ / checkpoint_name;
  const bool saved = fs::exists(checkpoint_file);
  if (!existing && (saved || holds_anything(locked_) || fs::is_empty(locked_)))
    throw OutputError("resume", directory_, "it holds no run of granvof");
  if (!existing) return {};
  if (const std::string other = difference(*existing, scene_, record_.start); !other.empty()) {
    throw OutputError("resume", directory_,
                      other + "; only time.end and output that is due later may change");
  }
  if (saved && existing->version != build_info().version) {
    throw OutputError("resume", directory_,
                      fmt::format("it was begun by version {}, this is {}; go on with that, or run it anew",
                                  existing->version, build_info().version));
  }
  if (!saved && existing->has_checkpoint)
    throw OutputError("resume", directory_, "its checkpoint.h5 has gone; run it anew without --resume");
  if (!saved) return {};
  Checkpoint checkpoint = read_checkpoint(checkpoint_file, scene_);
  if (checkpoint.time >= scene_.times.end) {
    throw OutputError("resume", directory_,
                      fmt::format("its checkpoint is of t = {:.9g} s, and the case ends at {:.9g} s",
                                  checkpoint.time, scene_.times.end));
  }
  const auto series = locked_ / series_name;
  SeriesFile::check_unchanged(series, existing->series);
  SeriesFile::rows_until(series, columns_, up_to(scene_.times.row_times, checkpoint.time));
  SeriesFile::check_unchanged(series, {checkpoint.rows.count, {}, {}, checkpoint.rows.sha256});
  FieldsFile::check_instants(locked_, up_to(scene_.times.field_times, checkpoint.time),
                             checkpoint.instants_sha256);
  resume_time_ = checkpoint_time_ = checkpoint.time;
  record_.start_date = existing->record.start_date;
  record_.resumptions = existing->record.resumptions;
  record_.resumptions.push_back({iso_date_now(), checkpoint.time, record_.start.threads,
                                 case_changes(existing->resolved_case, scene_.resolved)});
  return {std::move(checkpoint), existing->warnings};
}

// Whether the directory is still the one that this run has locked.
bool RunWriter::is_in_place() const {
  struct stat ours {
  }, there{};
  return ::fstat(lock_.get(), &ours) == 0 && ::stat(directory_.c_str(), &there) == 0 &&
         ours.st_dev == there.st_dev && ours.st_ino == there.st_ino;
}

void RunWriter::open_beside(const std::function<void(const fs::path&)>& open) const {
  by_given_name([&] { open(locked_); });
}

fs::path RunWriter::checkpoint_path() const {
  return directory_ / checkpoint_name;
}

std::optional<double> RunWriter::checkpoint_time() const {
  std::error_code none;
  return is_in_place() && fs::is_regular_file(locked_ / checkpoint_name, none) ? checkpoint_time_
                                                                               : std::nullopt;
}

void RunWriter::require_in_place() const {
  if (!is_in_place())
    throw OutputError("write to", directory_, "it was removed or replaced while the run went on");
}

void RunWriter::start_writing() {
  require_in_place();
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
  const auto record = locked_ / record_name;
  RunProgress nothing;
  nothing.cells = std::int64_t{1} * scene_.grid.cells[0] * scene_.grid.cells[1] * scene_.grid.cells[2];
  write_beside(record, run_record_text(scene_, record_, nothing, {}, {}));
  remove_owned(locked_);
  rename_into_place(record);
  begun_ = true;
  fields_ = FieldsFile::create(locked_, scene_);
  series_ = SeriesFile::create(locked_ / series_name, columns_);
}

void RunWriter::start_resumed(double time) {
  begun_ = true;
  fields_ = FieldsFile::resume(locked_, scene_, up_to(scene_.times.field_times, time));
  series_ = SeriesFile::resume(locked_ / series_name, columns_, up_to(scene_.times.row_times, time));
}

void RunWriter::write_series_row(double time, std::span<const Value> monitors, const Scalars& scalars) {
  std::vector<Value> row{time};
  row.insert(row.end(), monitors.begin(), monitors.end());
  row.insert(row.end(), scalars.begin(), scalars.end());
  by_given_name([&] {
    start_writing();
    series_->append(row);
  });
}

void RunWriter::write_fields(const CellFields& fields) {
  by_given_name([&] {
    start_writing();
    fields_->append(fields);
  });
}

void RunWriter::write_checkpoint(const CheckpointView& state, const RunProgress& progress) {
  by_given_name([&] {
    bring_files_up_to_date();
    CheckpointView with_rows = state;
    const SeriesFacts rows = series_->facts();
    with_rows.rows = {rows.rows, rows.sha256};
    with_rows.instants_sha256 = fields_->sha256(state.time);
    granvof::write_checkpoint(locked_ / checkpoint_name, scene_, with_rows);
    checkpoint_time_ = state.time;
    write_record(progress, {});
  });
}

void RunWriter::write_progress(const RunProgress& progress) {
  by_given_name([&] {
    start_writing();
    write_record(progress, {});
  });
}

void RunWriter::finish(const RunProgress& progress, const RunExit& exit) {
  by_given_name([&] {
    bring_files_up_to_date();
    // A run that may go on keeps its instants apart; where joining fails the linked form stays, just as
    // readable.
    if (exit.state == ExitState::finished && fields_->join())
      fields_sha256_ = digest_of_file(locked_ / "fields.h5");
    write_record(progress, exit);
  });
}

// series.csv and the list of the instants, on the disk.
void RunWriter::bring_files_up_to_date() {
  start_writing();
  series_->flush_to_disk();
  fields_->check_still_there();
  fields_->bring_up_to_date();
}

void RunWriter::give_up(const RunProgress& progress, const std::string& reason, ExitKind kind) noexcept {
  if (!begun_ || !is_in_place()) return;  // nothing of this run is there, and what is there is another's
  const RunExit exit{ExitState::failed, reason, kind};
  try {
    replace_record(run_record_text(scene_, record_, progress, files(), exit));
    if (fields_) fields_->bring_up_to_date();
  } catch (const std::exception&) {
    return;  // the caller has said on stderr what is wrong
  }
}

void RunWriter::note_end_of_copy(const std::string& reason) noexcept {
  if (!is_in_place()) return;
  try {
    const auto text = ended_record_text(read_file(locked_ / record_name), {ExitState::failed, reason});
    if (text) replace_record(*text);
  } catch (const std::exception&) {
    return;  // as above
  }
}

// On a full disk too.
void RunWriter::replace_record(const std::string& text) {
  try {
    write_file_atomically(locked_ / record_name, text);
  } catch (const OutputError&) {
    overwrite_file(locked_ / record_name, text);
  }
}

FilesWritten RunWriter::files() const {
  return {series_ ? series_->facts() : SeriesFacts{}, fields_ ? fields_->instants() : 0, fields_sha256_,
          checkpoint_time_};
}

void RunWriter::write_record(const RunProgress& progress, const RunExit& exit) {
  const std::string text = run_record_text(scene_, record_, progress, files(), exit);
  require_in_place();  // as late as can be: what is put in its place until then is another's
  write_file_atomically(locked_ / record_name, text);
}

}  // namespace granvof
