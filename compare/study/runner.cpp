#include "compare/study/runner.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "compare/study/process.hpp"
#include "compare/study/work_unit.hpp"
#include "solver/output/atomic_file.hpp"
#include "solver/scene/case_error.hpp"
#include "solver/scene/load_scene.hpp"

namespace granvof::compare {
namespace {

namespace fs = std::filesystem;

constexpr const char* note_file = "study.json";  // beside run.json: what the run was made for, and its costs
constexpr double noise_of_one =
    0.1;  // of a cost that was timed once: what the same run differs by on a busy machine
constexpr const char* stopped_from_outside = "stopped by a signal";  // last words of granvof then
constexpr int bad_input = 2;                                         // exit code of granvof

// FNV-1a: names a directory; what is in it is checked against the resolved case itself.
std::string short_hash(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : text) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3ULL;
  }
  return fmt::format("{:016x}", hash);
}

std::string trimmed(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  return text;
}

std::string last_line(const fs::path& log) {
  const std::string text = fs::exists(log) ? trimmed(read_file(log)) : "";
  const auto begin = text.find_last_of('\n');
  return text.empty() ? "no message" : text.substr(begin == std::string::npos ? 0 : begin + 1);
}

// Largest over smallest, less 1 [-].
double spread(const std::vector<double>& values) {
  if (values.empty()) return 0.0;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *low > 0.0 ? *high / *low - 1.0 : 0.0;
}

std::optional<nlohmann::json> read_note(const fs::path& directory) {
  if (!fs::exists(directory / note_file)) return std::nullopt;
  auto note = nlohmann::json::parse(read_file(directory / note_file), nullptr, false);
  if (!note.is_object() || !note.contains("set") || !note.contains("core_seconds")) return std::nullopt;
  return note;
}

// What a finished directory holds, measured against `scene`.
Outcome outcome_of(const fs::path& directory, const nlohmann::json& note, const Scene& scene) {
  Outcome outcome;
  LoadedRun loaded = load_run(directory, scene.name, scene);
  outcome.facts = loaded.facts;
  outcome.run = std::move(loaded.run);
  outcome.failure = note.value("failure", std::string());
  if (!outcome.run && outcome.failure.empty()) outcome.failure = loaded.reason;
  if (!outcome.failure.empty()) outcome.run.reset();
  const auto costs = note.at("core_seconds").get<std::vector<double>>();
  outcome.repeats = static_cast<int>(costs.size());
  if (!costs.empty()) outcome.core_seconds = *std::min_element(costs.begin(), costs.end());
  outcome.work_unit_seconds = note.value("work_unit_seconds", 0.0);
  outcome.noise =
      std::max({spread(costs), note.value("work_unit_spread", 0.0), costs.size() > 1 ? 0.0 : noise_of_one});
  if (outcome.facts) outcome.simulated_seconds = outcome.facts->number("simulated_time").value_or(0.0);
  return outcome;
}

}  // namespace

CachedRunner::CachedRunner(RunnerOptions options) : options_(std::move(options)) {
  if (!fs::exists(options_.program))
    throw std::runtime_error(fmt::format("{} is missing; `make build` builds it", options_.program.string()));
  fs::create_directories(options_.cache);
  lock_.emplace(options_.cache);
  const fs::path log = options_.cache / "version.txt";
  if (run_program({options_.program.string(), "--version"}, log, 60.0).code != 0)
    throw std::runtime_error(fmt::format("{} --version failed", options_.program.string()));
  version_ = trimmed(read_file(log));
  identity_ = version_;
  if (version_.find("-dirty") != std::string::npos || version_.find('(') == std::string::npos)
    identity_ += fmt::format(" {} {}", fs::file_size(options_.program),
                             fs::last_write_time(options_.program).time_since_epoch().count());
}

std::optional<Outcome> CachedRunner::kept(const Job& job, const Scene& scene,
                                          const fs::path& directory) const {
  const auto note = read_note(directory);
  if (note && note->value("ended_after", options_.timeout) < options_.timeout) return std::nullopt;
  if (note) return outcome_of(directory, *note, scene);
  if (!options_.any_version) return std::nullopt;
  std::vector<std::pair<fs::file_time_type, fs::path>> earlier;
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(directory.parent_path(), missing)) {
    const auto of_entry = read_note(entry.path());
    if (!of_entry || !fs::exists(entry.path() / "run.json")) continue;
    if (of_entry->at("set") == nlohmann::json(job.set) ||
        read_facts(entry.path() / "run.json").resolved_case == scene.resolved)
      earlier.emplace_back(entry.last_write_time(), entry.path());
  }
  if (earlier.empty()) return std::nullopt;
  const fs::path newest = std::max_element(earlier.begin(), earlier.end())->second;
  // The run is measured as the case it was made of.
  const RunFacts facts = read_facts(newest / "run.json");
  Scene then = scene;
  then.resolved = facts.resolved_case;
  return outcome_of(newest, *read_note(newest), then);
}

Outcome CachedRunner::make(const Job& job, const Scene& scene, const fs::path& directory) const {
  fs::remove_all(directory);
  fs::create_directories(directory.parent_path());
  const fs::path log = directory.string() + ".log";
  std::vector<std::string> command{
      options_.program.string(), "run", job.case_file.string(), "--threads", "1", "--out",
      directory.string()};
  for (const std::string& assignment : job.set) {
    command.emplace_back("--set");
    command.push_back(assignment);
  }
  if (options_.progress) fmt::print(stderr, "running {} {} ...", scene.name, fmt::join(job.set, " "));
  nlohmann::json note{{"case", scene.name}, {"set", job.set}, {"version", version_}};
  std::vector<double> costs, units;
  std::string failure;
  do {
    units.push_back(work_unit_seconds());
    const Ended ended = run_program(command, log, options_.timeout);
    units.push_back(work_unit_seconds());
    if (ended.timed_out) note["ended_after"] = options_.timeout;
    if (ended.timed_out)
      failure = fmt::format("ended after {:g} s of wall-clock time", options_.timeout);
    else if (ended.code == bad_input)  // nothing was run, and the case is not what is wrong
      throw std::runtime_error(last_line(log));
    else if (ended.code == 128 + SIGTERM || ended.code == 128 + SIGINT ||
             last_line(log).find(stopped_from_outside) != std::string::npos)
      throw std::runtime_error(
          fmt::format("the run was stopped from outside, and says nothing: {}", last_line(log)));
    else if (ended.code != 0)
      failure = fmt::format("exit code {}: {}", ended.code, last_line(log));
    std::optional<double> spent;
    if (fs::exists(directory / "run.json")) spent = read_facts(directory / "run.json").number("core_seconds");
    costs.push_back(spent.value_or(0.0));
  } while (failure.empty() && static_cast<int>(costs.size()) < timings_of_a_cheap_run &&
           costs.back() < options_.repeat_below);
  double sum = 0.0;
  for (const double unit : units) sum += unit;
  note["failure"] = failure;
  note["core_seconds"] = costs;
  note["work_unit_seconds"] = sum / static_cast<double>(units.size());
  note["work_unit_spread"] = spread(units);
  fs::create_directories(directory);        // a run that was ended at once has not made it
  fs::remove(directory / "checkpoint.h5");  // nothing goes on from here
  write_file_atomically(directory / note_file, note.dump(1) + "\n");
  Outcome outcome = outcome_of(directory, note, scene);
  if (options_.progress)
    fmt::print(stderr, " {:.3g} core-s{}\n", outcome.core_seconds,
               failure.empty() ? "" : ", FAILED: " + failure);
  return outcome;
}

fs::path CachedRunner::directory_of(const Scene& scene) const {
  return options_.cache / scene.name / short_hash(scene.resolved + "\n" + identity_);
}

bool CachedRunner::has(const Job& job) {
  try {
    const Scene scene = load_scene(job.case_file, job.set);
    return kept(job, scene, directory_of(scene)).has_value();
  } catch (const CaseError&) {
    return true;
  }
}

Outcome CachedRunner::run(const Job& job) {
  Scene scene;
  try {
    scene = load_scene(job.case_file, job.set);
  } catch (const CaseError& error) {
    Outcome refused;
    refused.failure = error.what();
    refused.refused = true;
    return refused;
  }
  const fs::path directory = directory_of(scene);
  if (auto found = kept(job, scene, directory)) {
    found->kept = true;
    return *found;
  }
  return make(job, scene, directory);
}

}  // namespace granvof::compare
