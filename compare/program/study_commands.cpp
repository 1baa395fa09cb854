#include "compare/program/study_commands.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <functional>
#include <map>

#include <fmt/format.h>

#include "compare/checks/table.hpp"
#include "compare/study/ablate.hpp"
#include "compare/study/advise_scene.hpp"
#include "compare/study/charts.hpp"
#include "compare/study/runner.hpp"
#include "compare/study/study_file.hpp"
#include "solver/output/atomic_file.hpp"
#include "solver/output/run_record.hpp"
#include "solver/scene/load_scene.hpp"

namespace granvof::compare {
namespace {

namespace fs = std::filesystem;

// Built beside this program.
fs::path default_solver() {
  std::error_code unknown;
  const fs::path self = fs::read_symlink("/proc/self/exe", unknown);
  return unknown ? fs::path("granvof") : self.parent_path().parent_path() / "solver/granvof";
}

void write(const fs::path& directory, const std::string& name, const std::string& text) {
  fs::create_directories(directory);
  write_file_atomically(directory / name, text);
}

// "no LES, no colour" -> those parts. Throws std::runtime_error for a name that is not there.
std::vector<Part> chosen_parts(const Study& study, const std::vector<std::string>& names) {
  if (names.empty()) return study.parts;
  std::vector<Part> chosen;
  for (const std::string& name : names) {
    const auto found =
        std::find_if(study.parts.begin(), study.parts.end(), [&](const Part& p) { return p.name == name; });
    if (found == study.parts.end()) {
      std::string allowed;
      for (const Part& part : study.parts) allowed += (allowed.empty() ? "" : ", ") + part.name;
      throw std::runtime_error(fmt::format("--part: '{}' given; allowed: {}", name, allowed));
    }
    chosen.push_back(*found);
  }
  return chosen;
}

const std::map<std::string, Against> references{
    {"DEM", Against::dem}, {"theory", Against::theory}, {"finest", Against::finest}};

// "5%" or "0.05". Throws std::runtime_error.
double read_tolerance(const std::string& text) {
  const bool percent = text.ends_with('%');
  const std::string number = percent ? text.substr(0, text.size() - 1) : text;
  double value = 0.0;
  const auto parsed = std::from_chars(number.data(), number.data() + number.size(), value);
  const bool whole = parsed.ec == std::errc() && parsed.ptr == number.data() + number.size();
  if (percent) value /= 100.0;
  if (!whole || !(value > 0.0 && value < 1.0))
    throw std::runtime_error(
        fmt::format("--tolerance: '{}' given; allowed: more than 0 and less than 1, or as 5%", text));
  return value;
}

const Chart* chart_of(const Study& study, const std::string& scene) {
  for (const Chart& chart : study.charts)
    if (chart.case_name == scene) return &chart;
  return nullptr;
}

// A grid that is held against itself is always confirmed. Throws std::runtime_error.
void require_different_grids(const AdviseInput& input) {
  if (input.cells.size() < 2) throw std::runtime_error("--cells: give two cell sizes or more");
  std::map<std::array<int, 3>, double> grids;
  for (const double cell : input.cells) {
    std::vector<std::string> set = input.set;
    set.push_back(fmt::format("grid.dx={:.12g}", cell));
    const auto [other, is_new] = grids.emplace(load_scene(input.case_file, set).grid.cells, cell);
    if (!is_new)
      throw std::runtime_error(
          fmt::format("--cells: {:.12g} and {:.12g} given; they make the same grid", other->second, cell));
  }
}

// Those of its chart, else twice, once, half and a quarter of the case's own.
std::vector<double> cells_for(const Chart* chart, const Scene& scene) {
  if (chart) return chart->grids;
  const double cell = scene.grid.spacing[0];
  return {2.0 * cell, cell, 0.5 * cell, 0.25 * cell};
}

}  // namespace

struct StudyCommands::Options {
  RunnerOptions runner{default_solver(), "out/study"};
  fs::path checks = "compare/checks.toml";
  fs::path study = "compare/study.toml";
  fs::path case_file, out;
  fs::path cases = "cases", records = "reference/results";
  std::vector<std::string> set, parts, scenes;
  std::vector<double> cells;
  std::string metric, tolerance, against;
  CLI::App* ablate = nullptr;
  CLI::App* advise = nullptr;
  CLI::App* charts = nullptr;

  void add_runner(CLI::App& command) {
    command.add_option("--solver", runner.program, "the program granvof")->capture_default_str();
    command.add_option("--cache", runner.cache, "runs are kept here, and not made again")
        ->capture_default_str();
    command.add_option("--timeout", runner.timeout, "wall-clock seconds after which a run is ended")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command.add_flag("--any-version", runner.any_version,
                     "take runs of the same case and overrides by other versions of the program too");
    command.add_option("--study", study, "methods and parts of the model")->capture_default_str();
    command.add_option("--records", records, "recorded DEM-VOF results")->capture_default_str();
    command.add_option("--out", out, "where the results go");
  }
  void add_case(CLI::App& command) {
    command.add_option("case", case_file, "case file (TOML)")->required()->type_name("CASE");
    command.add_option("--checks", checks, "the table of checks")->capture_default_str();
    command.add_option("--set", set, "replace a key of the case in all runs")
        ->type_name("TABLE.KEY=VALUE")
        ->allow_extra_args(false);
  }

  int run_ablate() {
    const Study read = read_study(study);
    const Scene scene = load_scene(case_file, set);
    const auto metrics = metrics_of_scene(read_table(checks), scene.name);
    CachedRunner made(runner);
    const AblateReport report =
        granvof::compare::ablate(case_file, set, chosen_parts(read, parts), metrics, records, made);
    const fs::path directory = out.empty() ? fs::path("out/ablate") / scene.name : out;
    write(directory, "ablate.csv", ablate_csv(report));
    write(directory, "ablate.json", ablate_json(report));
    fmt::print("{}", ablate_text(report));
    return 0;
  }

  int run_advise() {
    const Study read = read_study(study);
    const Scene scene = load_scene(case_file, set);
    const Chart* chart = chart_of(read, scene.name);
    const auto rows = metrics_of_scene(read_table(checks), scene.name);
    AdviseInput input{case_file,
                      set,
                      parse_quantity(metric, std::nullopt, rows),
                      read_tolerance(tolerance),
                      cells.empty() ? cells_for(chart, scene) : cells,
                      records,
                      rows,
                      {}};
    std::sort(input.cells.begin(), input.cells.end(), std::greater<>());
    require_different_grids(input);
    if (chart) input.panels = chart->panels;
    if (!against.empty()) input.against = references.at(against);
    CachedRunner made(runner);
    const AdviseReport report = advise_scene(input, methods_of(read, chart), read.parts, made);
    const fs::path directory = out.empty() ? fs::path("out/advise") : out;
    write(directory, scene.name + ".json", advise_json(report));
    fmt::print("{}", advise_text(report));
    if (!report.advice.chosen) return 1;
    const std::string name = scene.name + "-advised";
    write(directory, name + ".toml", advised_case(report, directory, name));
    load_scene(directory / (name + ".toml"));  // what it says is accepted
    fmt::print("case: {}\n", (directory / (name + ".toml")).string());
    return 0;
  }

  int run_charts() {
    const Study read = read_study(study);
    for (const std::string& scene : scenes)
      if (!chart_of(read, scene))
        throw std::runtime_error(
            fmt::format("--scene: '{}' given; {} has no chart of it", scene, study.string()));
    CachedRunner made(runner);
    std::vector<ChartResult> results;
    for (const Chart& chart : read.charts)
      if (scenes.empty() || std::find(scenes.begin(), scenes.end(), chart.case_name) != scenes.end())
        results.push_back(make_chart(chart, read, cases, records, made));
    const fs::path directory = out.empty() ? fs::path("out/charts") : out;
    write(directory, "charts.csv", charts_csv(results));
    write(directory, "points.json", charts_json(results, read, iso_date_now()));
    write(directory, "charts.txt", charts_text(results));
    fmt::print("{}", charts_text(results));
    return 0;
  }
};

StudyCommands::StudyCommands(CLI::App& app) : options_(std::make_shared<Options>()) {
  options_->ablate = app.add_subcommand(
      "ablate",
      "run a scene with each part of the model removed: what it does to every metric and to the cost");
  options_->add_case(*options_->ablate);
  options_->add_runner(*options_->ablate);
  options_->ablate->add_option("--part", options_->parts, "only these parts (may be given again)")
      ->allow_extra_args(false);

  options_->advise = app.add_subcommand(
      "advise",
      "the cheapest grid, method and model that meet a tolerance, confirmed by a finer run, as a case");
  options_->add_case(*options_->advise);
  options_->add_runner(*options_->advise);
  options_->advise
      ->add_option("--metric", options_->metric, "a metric (NAME, NAME@AT) or a curve of the study")
      ->required();
  options_->advise->add_option("--tolerance", options_->tolerance, "relative error, as 5% or 0.05")
      ->required();
  options_->advise
      ->add_option("--cells", options_->cells,
                   "cell sizes [m]; the smallest only confirms (default: those of the chart)")
      ->check(CLI::PositiveNumber)
      ->delimiter(',');
  options_->advise
      ->add_option("--against", options_->against,
                   "reference: DEM, theory or finest (default: the first of these that there is)")
      ->check(CLI::IsMember(references));

  options_->charts =
      app.add_subcommand("charts", "error against cost: all methods on all grids of the study");
  options_->add_runner(*options_->charts);
  options_->charts->add_option("--scene", options_->scenes, "only this chart (may be given again)")
      ->allow_extra_args(false);
  options_->charts->add_option("--cases", options_->cases, "case files")->capture_default_str();
}

bool StudyCommands::parsed() const {
  return options_->ablate->parsed() || options_->advise->parsed() || options_->charts->parsed();
}

int StudyCommands::run() {
  if (options_->ablate->parsed()) return options_->run_ablate();
  return options_->advise->parsed() ? options_->run_advise() : options_->run_charts();
}

}  // namespace granvof::compare
