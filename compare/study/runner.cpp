#include "compare/study/runner.hpp"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "compare/engine/made.hpp"
#include "solver/scene/case_error.hpp"
#include "solver/scene/load_scene.hpp"

namespace granvof::compare {
namespace {

namespace fs = std::filesystem;

constexpr double noise_of_one =
    0.1;  // of a cost that was timed once: what the same run differs by on a busy machine

// Largest over smallest, less 1 [-].
double spread(const std::vector<double>& values) {
  if (values.empty()) return 0.0;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *low > 0.0 ? *high / *low - 1.0 : 0.0;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

// What a directory holds, measured against `scene`.
Outcome outcome_of(const fs::path& directory, const Note& note, const Scene& scene) {
  Outcome outcome;
  LoadedRun loaded = load_run(directory, scene.name, scene);
  outcome.facts = loaded.facts;
  outcome.run = std::move(loaded.run);
  outcome.failure = note.message;
  if (!outcome.run && outcome.failure.empty()) outcome.failure = loaded.reason;
  if (!outcome.failure.empty()) outcome.run.reset();
  const std::vector<double>& costs = note.core_seconds;
  outcome.repeats = static_cast<int>(costs.size());
  if (!costs.empty()) outcome.core_seconds = *std::min_element(costs.begin(), costs.end());
  outcome.work_unit_seconds = mean(note.work_units);
  outcome.noise = std::max({spread(costs), spread(note.work_units), costs.size() > 1 ? 0.0 : noise_of_one});
  if (outcome.facts) outcome.simulated_seconds = outcome.facts->number("simulated_time").value_or(0.0);
  return outcome;
}

// Made if need be: the cache's directory must be there before it can be locked.
fs::path made(const fs::path& directory) {
  fs::create_directories(directory);
  return directory;
}

}  // namespace

CachedRunner::CachedRunner(RunnerOptions options)
    : options_(std::move(options)),
      version_(version_of(options_.program)),
      identity_(identity_of_program(options_.program, version_)),
      lock_(made(options_.cache)),
      engine_({{options_.program.string()}, 1, options_.cache / "accounts.csv"}) {}

Order CachedRunner::order_of(const Job& job) const {
  return order_of(job, load_scene(job.case_file, job.set));
}

Order CachedRunner::order_of(const Job& job, const Scene& scene) const {
  Order order{fmt::format("{} {}", scene.name, fmt::join(job.set, " ")), job.case_file, job.set,
              options_.cache / scene.name / short_hash(scene.resolved + "\n" + identity_)};
  order.limits.wall_seconds = options_.timeout;
  order.timed = order.keep = order.clear = true;
  order.timings = options_.timings;
  return order;
}

std::optional<Outcome> CachedRunner::kept(const Job& job, const Scene& scene, const Order& order) const {
  const fs::path& directory = order.directory;
  if (is_made(directory, identity_, scene.resolved, order.limits))
    return outcome_of(directory, *read_note(directory), scene);
  if (!options_.any_version) return std::nullopt;
  std::vector<std::pair<fs::file_time_type, fs::path>> earlier;
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(directory.parent_path(), missing)) {
    const auto note = read_note(entry.path());
    if (!note || !fs::exists(entry.path() / "run.json")) continue;
    if (note->set == job.set || read_facts(entry.path() / "run.json").resolved_case == scene.resolved)
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

Outcome CachedRunner::make(const Scene& scene, const Order& order) {
  if (options_.progress) fmt::print(stderr, "running {} ...", order.id);
  const Ending ended = engine_.make(order);
  if (ended.kind == ending::bad_input)  // nothing was run, and the case is not what is wrong
    throw std::runtime_error(ended.message);
  if (ended.kind == ending::signal) {
    forget_note(order.directory);
    throw std::runtime_error(
        fmt::format("the run was stopped from outside, and says nothing: {}", ended.message));
  }
  fs::remove(order.directory / "checkpoint.h5");  // nothing goes on from here
  Outcome outcome = outcome_of(order.directory, read_note(order.directory).value(), scene);
  if (options_.progress)
    fmt::print(stderr, " {:.3g} core-s{}\n", outcome.core_seconds,
               ended.finished() ? "" : ", FAILED: " + ended.message);
  return outcome;
}

bool CachedRunner::has(const Job& job) {
  try {
    const Scene scene = load_scene(job.case_file, job.set);
    return kept(job, scene, order_of(job, scene)).has_value();
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
  const Order order = order_of(job, scene);
  if (auto found = kept(job, scene, order)) {
    found->kept = true;
    return *found;
  }
  return make(scene, order);
}

}  // namespace granvof::compare
