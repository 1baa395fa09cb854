// granvof-compare: judges runs by the table of checks, and studies what a scene needs. Exit code 0: nothing
// unexpected; 1: an unexpected verdict, or a run that failed; 2: bad input.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <map>
#include <stdexcept>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "compare/checks/evaluate.hpp"
#include "compare/checks/table.hpp"
#include "compare/input/name.hpp"
#include "compare/lay/lay.hpp"
#include "compare/output/write.hpp"
#include "compare/program/run_command.hpp"
#include "compare/program/study_commands.hpp"
#include "solver/output/atomic_file.hpp"
#include "solver/output/build_info.hpp"
#include "solver/output/empty_values.hpp"
#include "solver/output/output_error.hpp"
#include "solver/output/own_stack.hpp"
#include "solver/output/run_record.hpp"
#include "solver/output/series_file.hpp"
#include "solver/output/standard_streams.hpp"
#include "solver/scene/load_scene.hpp"
#include "solver/scene/printable.hpp"

namespace {

using namespace granvof;
using namespace granvof::compare;

constexpr std::size_t longest_message = 1500;  // bytes; it holds the name of a directory

struct Options {
  Paths paths{"out/runs", "cases", "reference/results"};
  std::filesystem::path table = "compare/checks.toml";
  std::filesystem::path out = "out/verify";
  Frequency frequency = Frequency::verify;
  Canary canary;
  std::vector<std::string> left_out;
  bool as_orders = false;

  LeftOut left() const {
    const auto names = [this](const char* name) {
      return std::find(left_out.begin(), left_out.end(), name) != left_out.end();
    };
    return {names("DEM"), names("canary")};
  }
};

const std::map<std::string, Frequency> frequencies{{"verify", Frequency::verify},
                                                   {"short", Frequency::short_},
                                                   {"nightly", Frequency::nightly},
                                                   {"weekly", Frequency::weekly}};

const std::map<std::string, Verdict> canary_verdicts{
    {"agrees", Verdict::agrees}, {"differs", Verdict::differs}, {"not run", Verdict::not_run}};

int print_plan(const Options& options) {
  if (options.as_orders) {
    for (const Order& order : orders_of(read_table(options.table), options.frequency, options.paths))
      fmt::print("{}\n", order_line(order));
    return 0;
  }
  for (const PlannedRun& run : due_runs(read_table(options.table), options.frequency)) {
    fmt::print("{}\t{}", run.id, run.case_name);
    for (const std::string& assignment : run.set) fmt::print("\t{}", assignment);
    fmt::print("\n");
  }
  return 0;
}

int check_runs(const Options& options) {
  const Table table = read_table(options.table);
  Evaluation evaluation = evaluate(table, options.frequency, options.paths, options.left());
  if (!options.canary.note.empty() || options.left().canary)
    evaluation.results.push_back(canary_result(options.canary, options.left()));
  std::filesystem::create_directories(options.out);
  const auto results = options.out / "results.json";
  require_own_file(results, "{\n \"date\"");
  // Kept for the report, which shows what changed since the last comparison.
  if (std::filesystem::exists(results))
    write_file_atomically(options.out / "results.previous.json", read_file(results));
  write_file_atomically(results, results_json(evaluation, options.frequency, iso_date_now()));
  write_file_atomically(options.out / "results.csv", results_csv(evaluation));
  write_file_atomically(options.out / "junit.xml", junit_xml(evaluation));
  write_file_atomically(options.out / "curves.json", curves_json(evaluation));
  fmt::print("{}", terminal_table(evaluation));
  return evaluation.unexpected() == 0 ? 0 : 1;
}

struct LayOptions {
  std::string scene;
  std::filesystem::path series, fields, run, out = "out/lay";
  std::string name;
  std::vector<std::string> set;
};

// The scene named by --scene. Throws CaseError, std::runtime_error where it is a path.
Scene scene_of(const LayOptions& options, const Paths& paths) {
  if (!is_name(options.scene))
    throw std::runtime_error(fmt::format("--scene: '{}' given; it is the name of a case in {}", options.scene,
                                         paths.cases.string()));
  return load_scene(paths.cases / (options.scene + ".toml"), options.set);
}

int lay_beside(const LayOptions& options, const Paths& paths) {
  const Scene scene = scene_of(options, paths);
  const auto directory = options.run.empty() ? paths.runs / options.scene : options.run;
  const LoadedRun ours = load_run(directory, options.scene, scene);
  if (!ours.run) throw std::runtime_error(ours.reason);
  const Run theirs = options.series.empty() ? read_their_fields(options.fields, scene)
                                            : read_their_series(options.series, scene);
  const std::string name = options.name.empty() ? theirs.id : options.name;
  const auto curves = lay(*ours.run, theirs);
  std::filesystem::create_directories(options.out);
  require_own_file(options.out / "lay.json", "{\n \"scene\"");
  write_file_atomically(options.out / "lay.json", lay_json(curves, *ours.run, name));
  fmt::print("{}", lay_table(curves, case_file::printable(name, longest_message)));
  return 0;
}

// A series.csv of fields that are not ours, so that they need to be read only once. Prints the hash of what
// they are a run of: a record keeps it, and goes stale with it.
int extract_series(const LayOptions& options, const Paths& paths) {
  const Scene scene = scene_of(options, paths);
  require_own_file(options.out, "time [s]");
  if (std::filesystem::exists(options.out.parent_path() / "run.json"))
    throw OutputError("write", options.out, "a run is there, whose file it would be; give another directory");
  const Series series = read_their_fields(options.fields, scene).series;
  if (options.out.has_parent_path()) std::filesystem::create_directories(options.out.parent_path());
  SeriesFile file = SeriesFile::create(options.out, series.columns);
  for (const auto& row : series.rows) file.append(row);
  fmt::print("{}\n", scene.reference_hash);
  return 0;
}

void add_common(CLI::App& command, Options& options) {
  command.add_option("--checks", options.table, "the table of checks")->capture_default_str();
  command.add_option("--frequency", options.frequency, "rows due at: verify, short, nightly or weekly")
      ->transform(CLI::CheckedTransformer(frequencies));
}

std::string failure_text(const CLI::App*, const CLI::Error& error) {
  return fmt::format("granvof-compare: {} (granvof-compare --help says what is allowed)\n",
                     case_file::printable(error.what(), longest_message));
}

int parse_and_run(int argc, char** argv) {
  CLI::App app{"Judges runs by the table of checks, and studies what a scene needs"};
  app.require_subcommand(1);
  app.set_version_flag("--version", granvof::version_text("granvof-compare"));
  app.failure_message(failure_text);
  Options options;

  CLI::App* check =
      app.add_subcommand("check", "judge the runs, write results.{json,csv}, junit.xml, curves.json");
  add_common(*check, options);
  check->add_option("--runs", options.paths.runs, "run directories")->capture_default_str();
  check->add_option("--cases", options.paths.cases, "case files")->capture_default_str();
  check->add_option("--records", options.paths.records, "recorded DEM-VOF results")->capture_default_str();
  check->add_option("--canary", options.canary.verdict, "outcome of the reference's canary")
      ->transform(CLI::CheckedTransformer(canary_verdicts));
  check->add_option("--canary-note", options.canary.note,
                    "what it said; without it there is no row of the canary");
  check
      ->add_option("--leave-out", options.left_out,
                   "what may be not run: DEM (rows judged by a record), canary; may be given again")
      ->check(CLI::IsMember({"DEM", "canary"}))
      ->allow_extra_args(false);
  check->add_option("--out", options.out, "where the results go")->capture_default_str();

  CLI::App* plan =
      app.add_subcommand("plan", "print the runs the table needs: id, case and overrides, tab-separated");
  add_common(*plan, options);
  plan->add_flag("--orders", options.as_orders, "as orders of `run`, into --runs");
  plan->add_option("--runs", options.paths.runs, "run directories")->capture_default_str();
  plan->add_option("--cases", options.paths.cases, "case files")->capture_default_str();

  LayOptions laid;
  CLI::App* lay_command =
      app.add_subcommand("lay", "lay a series of others beside a run (compare/lay/README.md)");
  lay_command->add_option("--scene", laid.scene, "case of both, by its name in --cases")->required();
  CLI::Option_group* source = lay_command->add_option_group("theirs");
  source->add_option("--series", laid.series, "their CSV: header 'name [unit]', time [s] or T [-]")
      ->check(CLI::ExistingFile);
  source->add_option("--fields", laid.fields, "their fields.h5")->check(CLI::ExistingFile);
  source->require_option(1);
  lay_command->add_option("--name", laid.name, "what to call them (default: the file's name)");
  lay_command->add_option("--run", laid.run, "our run directory (default: SCENE below --runs)");
  lay_command->add_option("--set", laid.set, "overrides our run was made with")->allow_extra_args(false);
  lay_command->add_option("--runs", options.paths.runs, "run directories")->capture_default_str();
  lay_command->add_option("--cases", options.paths.cases, "case files")->capture_default_str();
  lay_command->add_option("--out", laid.out, "where lay.json goes")->capture_default_str();

  CLI::App* extract = app.add_subcommand("extract", "write the series.csv of a fields.h5 of others");
  extract->add_option("--scene", laid.scene, "case of the fields, by its name in --cases")->required();
  extract->add_option("--fields", laid.fields, "their fields.h5")->required()->check(CLI::ExistingFile);
  extract->add_option("--cases", options.paths.cases, "case files")->capture_default_str();
  extract->add_option("--set", laid.set, "overrides of the case")->allow_extra_args(false);
  extract->add_option("--out", laid.out, "the series.csv")->required();

  RunCommand engine(app);
  StudyCommands study(app);

  refuse_empty_values(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (*extract) return extract_series(laid, options.paths);
  if (engine.parsed()) return engine.run();
  if (study.parsed()) return study.run();
  if (*lay_command) return lay_beside(laid, options.paths);
  return *plan ? print_plan(options) : check_runs(options);
}

}  // namespace

int main(int argc, char** argv) {
  prepare_standard_streams();
  if (!has_stack("granvof-compare")) return 2;
  try {
    const int code = parse_and_run(argc, argv);
    require_stdout_written();
    return code;
  } catch (const CaseError& error) {  // a line for each fault, made printable where it was found
    fmt::print(stderr, "granvof-compare: {}\n", error.what());
  } catch (const std::exception& error) {
    fmt::print(stderr, "granvof-compare: {}\n", case_file::printable(error.what(), longest_message));
  }
  return 2;
}
