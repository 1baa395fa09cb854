#include "compare/program/study_commands.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <functional>
#include <map>

#include <fmt/format.h>

#include "compare/checks/table.hpp"
#include "compare/program/run_command.hpp"
#include "compare/study/ablate.hpp"
#include "compare/study/advise_scene.hpp"
#include "compare/study/budget.hpp"
#include "compare/study/charts.hpp"
#include "compare/study/runner.hpp"
#include "compare/study/study_file.hpp"
#include "solver/output/atomic_file.hpp"
#include "solver/output/run_record.hpp"
#include "solver/scene/load_scene.hpp"

namespace granvof::compare {
namespace {

namespace fs = std::filesystem;

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

// "5%" or "0.05". Throws std::runtime_error, which names the option.
double read_share(const std::string& option, const std::string& text) {
  const bool percent = text.ends_with('%');
  const std::string number = percent ? text.substr(0, text.size() - 1) : text;
  double value = 0.0;
  const auto parsed = std::from_chars(number.data(), number.data() + number.size(), value);
  const bool whole = parsed.ec == std::errc() && parsed.ptr == number.data() + number.size();
  if (percent) value /= 100.0;
  if (!whole || !(value > 0.0 && value < 1.0))
    throw std::runtime_error(
        fmt::format("{}: '{}' given; allowed: more than 0 and less than 1, or as 5%", option, text));
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

// Makes nothing: prints what it is asked for and is not there yet, as orders of the run engine.
class PlanningRunner : public Runner {
 public:
  explicit PlanningRunner(CachedRunner& made) : made_(made) {}
  Outcome run(const Job& job) override {
    if (!made_.has(job)) fmt::print("{}\n", order_line(made_.order_of(job)));
    Outcome outcome;
    outcome.failure = "only planned";
    return outcome;
  }
  bool has(const Job& job) override { return made_.has(job); }

 private:
  CachedRunner& made_;
};

// What a run may cost, and what was known before it.
void print_plan(const Plan& plan) {
  fmt::print(stderr, "plan, at most (estimated, on one core):\n");
  for (const PlannedGrid& grid : plan.grids)
    fmt::print(stderr, "  {:.4g} mm: {} run{}, {} kept; {}\n", 1e3 * grid.cell, grid.runs,
               grid.runs == 1 ? "" : "s", grid.kept, duration_text(grid.core_seconds));
  fmt::print(stderr, "  in all {}\n", duration_text(plan.core_seconds()));
}

// The plan of a walk, its finest cells dropped until it is within the budget. Throws std::runtime_error where
// two cell sizes are beyond it.
Plan plan_within(AdviseInput& input, const std::vector<Method>& methods, const std::vector<Part>& parts,
                 std::optional<double> budget, Runner& runner) {
  for (;;) {
    Plan plan = plan_of(input.cells, jobs_of(input, methods, parts), runner);
    if (!budget || plan.core_seconds() <= *budget) return plan;
    if (input.cells.size() == 2) {
      print_plan(plan);
      throw std::runtime_error(
          fmt::format("--budget: {} given; the two coarsest grids may take {}: give more, or coarser --cells",
                      duration_text(*budget), duration_text(plan.core_seconds())));
    }
    fmt::print(stderr, "beyond the budget of {}: {:.4g} mm are left out (in all {})\n",
               duration_text(*budget), 1e3 * input.cells.back(), duration_text(plan.core_seconds()));
    input.cells.pop_back();
  }
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
  std::string metric, tolerance, against, budget;
  std::vector<std::string> metrics;
  std::string change = "5%";
  fs::path kept = "compare/kept/verify/results.json";
  CLI::App* ablate = nullptr;
  CLI::App* advise = nullptr;
  CLI::App* charts = nullptr;
  bool plan_only = false;

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
  void add_plan(CLI::App& command) {
    command.add_flag("--plan", plan_only,
                     "run nothing: print what is to be made, for `granvof-compare run` (docs/run-engine.md)");
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
    const auto rows = metrics_of_scene(read_table(checks), scene.name);
    std::vector<Check> looked_at = metrics.empty() ? rows : std::vector<Check>{};
    std::vector<Quantity> curves;
    const double moved = read_share("--tolerance", change);
    for (const std::string& name : metrics) {
      const Quantity quantity = parse_quantity(name, std::nullopt, rows);
      if (quantity.is_curve)
        curves.push_back(quantity);
      else
        looked_at.push_back(check_of(quantity, moved, rows));
    }
    CachedRunner made(runner);
    if (plan_only) {
      PlanningRunner planned(made);
      for (const Job& job : jobs_of_ablation(case_file, set, chosen_parts(read, parts))) planned.run(job);
      return 0;
    }
    const AblateReport report = granvof::compare::ablate(case_file, set, chosen_parts(read, parts), looked_at,
                                                         records, made, curves, moved);
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
    const Table table = read_table(checks);
    const auto rows = metrics_of_scene(table, scene.name);
    AdviseInput input{
        case_file,
        set,
        parse_quantity(metric, std::nullopt, rows),
        read_share("--tolerance", tolerance),
        cells.empty() ? cells_to_advise(chart ? chart->grids : std::vector<double>{}, scene) : cells,
        records,
        rows,
        {}};
    std::sort(input.cells.begin(), input.cells.end(), std::greater<>());
    require_different_grids(input);
    if (chart) input.panels = chart->panels;
    if (!against.empty()) input.against = references.at(against);
    input.like = like_scenes(scene, input.quantity, table, read_known_rows(kept), cases);
    std::optional<double> limit;
    if (!budget.empty()) limit = read_duration(budget);
    const auto methods = methods_to_advise(read, chart);
    CachedRunner made(runner);
    print_plan(plan_within(input, methods, read.parts, limit, made));
    std::optional<BudgetedRunner> kept_to;
    if (limit) kept_to.emplace(made, *limit);
    Runner& used = kept_to ? static_cast<Runner&>(*kept_to) : made;
    const AdviseReport report = advise_scene(input, methods, read.parts, used);
    const fs::path directory = out.empty() ? fs::path("out/advise") : out;
    write(directory, scene.name + ".json", advise_json(report));
    fmt::print("{}", advise_text(report));
    if (kept_to && kept_to->left_out() > 0)
      fmt::print("{} runs left out: the budget was spent\n", kept_to->left_out());
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
    PlanningRunner planned(made);
    std::vector<ChartResult> results;
    for (const Chart& chart : read.charts)
      if (scenes.empty() || std::find(scenes.begin(), scenes.end(), chart.case_name) != scenes.end())
        results.push_back(
            make_chart(chart, read, cases, records, plan_only ? static_cast<Runner&>(planned) : made));
    if (plan_only) return 0;
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
  options_->add_plan(*options_->ablate);
  options_->ablate->add_option("--part", options_->parts, "only these parts (may be given again)")
      ->allow_extra_args(false);
  options_->ablate
      ->add_option(
          "--metric", options_->metrics,
          "look at this metric (NAME, NAME@AT) or curve, in any scene (may be given again; default: the rows "
          "of the table of checks)")
      ->allow_extra_args(false);
  options_->ablate
      ->add_option(
          "--tolerance", options_->change,
          "what a metric without a row may change by, of the full model's value or of the curve's range")
      ->capture_default_str();

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
      ->add_option(
          "--cells", options_->cells,
          "cell sizes [m]; the smallest only confirms (default: those of the chart, none below a grain)")
      ->check(CLI::PositiveNumber)
      ->delimiter(',');
  options_->advise
      ->add_option("--against", options_->against,
                   "reference: DEM, theory or finest (default: the first of these that there is)")
      ->check(CLI::IsMember(references));

  options_->advise->add_option(
      "--budget", options_->budget,
      "CPU time that the runs may take, as 90s, 10min or 2h: fine grids are left out, or it "
      "is refused");
  options_->advise
      ->add_option("--kept", options_->kept, "results that tell the model's error in scenes with a record")
      ->capture_default_str();
  options_->advise->add_option("--cases", options_->cases, "case files of those scenes")
      ->capture_default_str();

  options_->charts =
      app.add_subcommand("charts", "error against cost: all methods on all grids of the study");
  options_->add_runner(*options_->charts);
  options_->add_plan(*options_->charts);
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
