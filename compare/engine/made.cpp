#include "compare/engine/made.hpp"

#include <exception>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "compare/input/run.hpp"
#include "solver/output/atomic_file.hpp"
#include "solver/output/run_record.hpp"
#include "solver/output/run_writer.hpp"
#include "solver/scene/fnv1a.hpp"

namespace granvof::compare {
namespace {

namespace fs = std::filesystem;

constexpr const char* note_file = "made.json";

bool is_cut_short(std::string_view kind) {
  return kind == ending::running || kind == ending::signal || kind == ending::cpu_limit ||
         kind == name_of(ExitKind::wall_clock_limit);
}

// The same again would end so again.
bool is_for_good(std::string_view kind) {
  return kind == ending::finished || kind == name_of(ExitKind::step_collapse) ||
         kind == name_of(ExitKind::not_finite) || kind == name_of(ExitKind::alarm) ||
         kind == name_of(ExitKind::error);
}

std::optional<RunFacts> facts_in(const fs::path& directory) {
  try {
    return fs::exists(directory / "run.json") ? std::optional(read_facts(directory / "run.json"))
                                              : std::nullopt;
  } catch (const std::exception&) {
    return std::nullopt;  // damaged: it says nothing
  }
}

// Whether a finished run is of this case and its files are what its record states: one that was changed since
// would be refused wherever it is read, and is made anew instead.
bool is_whole(const fs::path& directory, const RunFacts& facts, const std::string& resolved_case) {
  if (!facts.files) return true;  // of a program that states nothing of its files
  if (!facts.sealed || facts.resolved_case != resolved_case) return false;
  try {
    require_digest(directory / "series.csv", facts.files->series.sha256);
    if (facts.files->fields && facts.files->fields->sha256)
      require_digest(directory / "fields.h5", *facts.files->fields->sha256);
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace

std::string short_hash(std::string_view text) {
  return fmt::format("{:016x}", fnv1a(text));
}

std::optional<Note> read_note(const fs::path& directory) {
  if (!fs::is_regular_file(directory / note_file)) return std::nullopt;
  try {
    const auto json = nlohmann::json::parse(read_file(directory / note_file));
    return Note{json.at("program"),      json.at("case"),      json.at("set"),
                json.at("kind"),         json.at("message"),   {json.at("wall_limit"), json.at("cpu_limit")},
                json.at("core_seconds"), json.at("work_units")};
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

void write_note(const fs::path& directory, const Note& note) {
  const nlohmann::ordered_json json{{"program", note.program},
                                    {"case", note.case_hash},
                                    {"set", note.set},
                                    {"kind", note.kind},
                                    {"message", note.message},
                                    {"wall_limit", note.limits.wall_seconds},
                                    {"cpu_limit", note.limits.cpu_seconds},
                                    {"core_seconds", note.core_seconds},
                                    {"work_units", note.work_units}};
  write_file_atomically(directory / note_file,
                        json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

void forget_note(const fs::path& directory) {
  if (read_note(directory)) fs::remove(directory / note_file);
}

void clear_made(const fs::path& directory) {
  const fs::file_status there = fs::symlink_status(directory);
  if (!fs::exists(there)) return;
  if (!fs::is_directory(fs::status(directory)))
    throw std::runtime_error(fmt::format("{} is no directory", directory.string()));
  const bool noted = read_note(directory).has_value();
  const auto facts = facts_in(directory);
  // what a run that was killed in its first moment leaves
  const bool begun = fs::exists(directory / "run.json.tmp") && !fs::exists(directory / "run.json");
  const bool of_a_run = noted || begun || (facts && !facts->exit.empty());
  const auto foreign = [=](const std::string& name) {
    return name == note_file ? !noted : !(of_a_run && is_name_of_a_run(name));
  };
  for (const auto& entry : fs::directory_iterator(directory))
    if (const std::string name = entry.path().filename().string(); foreign(name))
      throw std::runtime_error(fmt::format("{} holds {}, which no run has left there; give another directory",
                                           directory.string(), name));
  remove_run(directory);
  forget_note(directory);
  if (fs::is_directory(there) && fs::is_empty(directory)) fs::remove(directory);  // not a link to one
}

bool is_made(const fs::path& directory, const std::string& program, const std::string& resolved_case,
             const Limits& limits) {
  const auto note = read_note(directory);
  if (!note || note->program != program || note->case_hash != short_hash(resolved_case)) return false;
  const auto as_long = [](double then, double now) { return then > 0.0 && now > 0.0 && now <= then; };
  if (note->kind == ending::time_limit) return as_long(note->limits.wall_seconds, limits.wall_seconds);
  if (note->kind == ending::cpu_limit) return as_long(note->limits.cpu_seconds, limits.cpu_seconds);
  if (note->kind != ending::finished) return is_for_good(note->kind);
  const auto facts = facts_in(directory);
  return facts && facts->kind == ending::finished && is_whole(directory, *facts, resolved_case);
}

bool can_be_gone_on_with(const fs::path& directory, const std::string& program,
                         const std::string& resolved_case) {
  const auto facts = facts_in(directory);
  if (!facts || facts->resolved_case != resolved_case || !is_cut_short(facts->kind)) return false;
  const std::string version = fmt::format("granvof {} ({})", facts->version, facts->commit);
  return version == program && fs::exists(directory / "checkpoint.h5");
}

std::optional<double> core_seconds_of(const fs::path& directory) {
  const auto facts = facts_in(directory);
  return facts ? facts->number("core_seconds") : std::nullopt;
}

}  // namespace granvof::compare
