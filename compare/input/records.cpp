#include "compare/input/records.hpp"

#include <algorithm>
#include <exception>

#include <fmt/format.h>

#include "compare/input/is_there.hpp"
#include "solver/scene/printable.hpp"

namespace granvof::compare {
namespace {

LoadedRun load_record(const std::filesystem::path& directory, const Scene& scene) {
  LoadedRun loaded;
  loaded.directory = directory;
  loaded.state = RunState::refused;
  try {
    loaded.facts = read_facts(directory / "record.json");
    if (loaded.facts->case_hash != scene.reference_hash) {
      loaded.state = RunState::stale;
      loaded.reason = fmt::format("the record {} is of case {}, the case is now {}", directory.string(),
                                  loaded.facts->case_hash, scene.reference_hash);
      return loaded;
    }
    // A record's rows and end are as its recorder was asked, of which the hash knows nothing.
    const auto& files = loaded.facts->files;
    const double stated_end = files ? files->series.end.value_or(0.0) : 0.0;
    const Asked asked{0.0, loaded.facts->number("simulated_time").value_or(stated_end)};
    Series series = read_evidence(directory, *loaded.facts, asked);
    const double interval = interval_of(series, asked);
    loaded.run =
        Run{directory.filename().string(), directory, scene, *loaded.facts, std::move(series), interval};
    if (loaded.facts->grid) loaded.run->scene.grid = *loaded.facts->grid;  // of the record, not of our run
    loaded.state = RunState::usable;
  } catch (const std::exception& error) {
    loaded.reason = fmt::format("refused: {}", case_file::printable(error.what(), longest_reason));
  }
  return loaded;
}

// In the order of their names; none where nothing has the name.
std::vector<std::filesystem::path> folders_in(const std::filesystem::path& directory) {
  std::vector<std::filesystem::path> folders;
  if (!is_there(directory)) return folders;
  for (const auto& entry : std::filesystem::directory_iterator(directory)) folders.push_back(entry.path());
  std::sort(folders.begin(), folders.end());
  return folders;
}

// A series without its record.json is a record that has lost it: it is refused, not left out.
bool holds_record(const std::filesystem::path& folder) {
  return is_there(folder / "record.json") || is_there(folder / "series.csv");
}

}  // namespace

std::vector<LoadedRun> load_records(const std::filesystem::path& records, std::string_view name,
                                    const Scene& scene) {
  std::vector<std::filesystem::path> variants;
  for (const auto& folder : folders_in(records / name))
    if (folder.extension() != ".part" && holds_record(folder)) variants.push_back(folder);
  if (variants.empty() && holds_record(records / name)) variants.push_back(records / name);
  std::vector<LoadedRun> loaded;
  loaded.reserve(variants.size());
  for (const auto& variant : variants) loaded.push_back(load_record(variant, scene));
  return loaded;
}

std::vector<LoadedRun> load_peers(const std::filesystem::path& records, std::string_view case_name,
                                  const Scene& scene) {
  std::vector<std::filesystem::path> programs;
  for (const auto& folder : folders_in(records / "peers"))
    if (holds_record(folder / case_name)) programs.push_back(folder);
  std::vector<LoadedRun> loaded;
  loaded.reserve(programs.size());
  for (const auto& program : programs) {
    loaded.push_back(load_record(program / case_name, scene));
    if (loaded.back().run) loaded.back().run->id = program.filename().string();
  }
  return loaded;
}

}  // namespace granvof::compare
