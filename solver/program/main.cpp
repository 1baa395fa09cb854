// The program granvof: run, check, report, sweep, restate and keys. Exit codes: 0 done, 1 the run failed or
// was stopped by a signal, 2 bad input, 3 the run was stopped at its wall-clock limit (--stop-after).
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include "solver/output/atomic_file.hpp"
#include "solver/output/build_info.hpp"
#include "solver/output/empty_values.hpp"
#include "solver/output/output_error.hpp"
#include "solver/output/own_stack.hpp"
#include "solver/output/standard_streams.hpp"
#include "solver/parallel/processes.hpp"
#include "solver/plausibility/plausibility.hpp"
#include "solver/program/hand_over.hpp"
#include "solver/program/start_picture.hpp"
#include "solver/run/memory_demand.hpp"
#include "solver/run/run_case.hpp"
#include "solver/scene/cost_estimate.hpp"
#include "solver/scene/duration.hpp"
#include "solver/scene/load_scene.hpp"
#include "solver/scene/parts.hpp"
#include "solver/scene/printable.hpp"
#include "solver/scene/restate.hpp"

namespace {

constexpr int bad_input = 2;
constexpr std::size_t longest_message = 1500;  // bytes; it holds the name of a directory
constexpr int most_threads = 256;

struct Arguments {
  std::string case_file;
  std::vector<std::string> overrides;
  granvof::RunOptions run;
  granvof::UnitFactors factors;
  std::string picture;
  std::vector<std::string> directories;
  std::vector<std::string> metrics;  // of a sweep
  std::string jobs;                  // likewise, at a time
};

void add_case(CLI::App& command, Arguments& arguments) {
  command.add_option("case", arguments.case_file, "Case file (TOML)")->required()->type_name("CASE");
  command.add_option("--set", arguments.overrides, "Replace a key of the case; may be given again")
      ->type_name("TABLE.KEY=VALUE")
      ->allow_extra_args(false);
}

std::string command_line(int argc, char** argv) {
  std::string line = argv[0];
  for (int i = 1; i < argc; ++i) line += std::string(" ") + argv[i];
  return line;
}

granvof::Scene load(const Arguments& arguments) {
  granvof::Scene scene = granvof::load_scene(arguments.case_file, arguments.overrides);
  for (const granvof::Implausible& finding : granvof::plausibility(scene))
    fmt::print(stderr, "{}: warning: {}\n", scene.name, granvof::text_of(finding));
  return scene;
}

int run(Arguments& arguments) {
  granvof::RunOptions& options = arguments.run;
  const granvof::Scene scene = options.processes == nullptr
                                   ? load(arguments)
                                   : granvof::load_alike(*options.processes, [&] { return load(arguments); });
  if (options.out.empty()) options.out = std::filesystem::path("out") / "runs" / scene.name;
  options.progress = isatty(STDERR_FILENO) != 0;
  return granvof::run_case(scene, options);
}

// All but `run` is done by one process.
void require_alone(const CLI::App& app, const granvof::Communicator* processes) {
  for (const CLI::App* command : app.get_subcommands())
    if (processes != nullptr && command->get_name() != "run")
      throw granvof::CaseError(
          fmt::format("granvof: {}: got {} processes, allowed: one; start it without mpirun",
                      command->get_name(), processes->size()));
}

std::string names_of(const std::vector<const granvof::Part*>& parts) {
  std::string text;
  for (const granvof::Part* part : parts) {
    const std::string equations = granvof::text_of_equations(part->equations);
    text += fmt::format("{}{}{}{}", text.empty() ? "" : "; ", part->name, equations.empty() ? "" : " ",
                        equations);
  }
  return text.empty() ? "nothing" : text;
}

int check(const Arguments& arguments) {
  const granvof::Scene scene = load(arguments);
  if (!arguments.picture.empty()) {
    granvof::require_own_file(arguments.picture, "<svg");
    granvof::write_file_atomically(arguments.picture, granvof::picture_of_start(scene));
  }
  const auto& cells = scene.grid.cells;
  const granvof::CostEstimate cost = granvof::estimate_cost(scene);
  fmt::print("# {}: {} x {} x {} cells, {:.6g} s; physics {}\n", scene.name, cells[0], cells[1], cells[2],
             scene.times.end, scene.hash);
  fmt::print("# estimated: {:.2g} steps, {:.2g} s on one core, {:.2g} MB; motion up to {:.2g} m/s\n",
             cost.steps, cost.core_seconds, 1e-6 * granvof::memory_demand(scene), cost.fastest);
  const granvof::PartsOfModel parts = granvof::parts_of_model(scene);
  fmt::print("# model: {}\n# not in this scene: {}\n\n{}", names_of(parts.act), names_of(parts.rest),
             scene.resolved);
  return 0;
}

int restate(const Arguments& arguments) {
  const granvof::Scene scene = load(arguments);
  const granvof::UnitFactors& f = arguments.factors;
  fmt::print("# {}: mass x {}, length x {}, time x {}\n\n{}", scene.name, f.mass, f.length, f.time,
             granvof::restated_case(scene, f));
  return 0;
}

[[noreturn]] void sweep(const Arguments& arguments) {
  std::vector<std::string> words{arguments.case_file, "--solver=" + granvof::own_program().string()};
  for (const std::string& axis : arguments.overrides) words.push_back("--set=" + axis);
  for (const std::string& metric : arguments.metrics) words.push_back("--metric=" + metric);
  if (!arguments.jobs.empty()) words.push_back("--jobs=" + arguments.jobs);
  if (!arguments.run.out.empty()) words.push_back("--out=" + arguments.run.out.string());
  granvof::hand_over("sweep", "sweep", words);
}

int keys() {
  fmt::print("{}", granvof::keys_reference());
  return 0;
}

// What is wrong with a duration, for a person; empty where nothing is.
std::string duration_fault(const std::string& text) {
  try {
    granvof::read_duration(text);
    return "";
  } catch (const std::invalid_argument& fault) {
    return fault.what();
  }
}

// One line; a misspelt subcommand is named, where the library only says that one is required.
std::string failure_text(const CLI::App* app, const CLI::Error& error) {
  const std::vector<std::string> left = app->remaining();
  const bool misspelt = app->get_subcommands().empty() && !left.empty();
  const std::string what =
      misspelt ? fmt::format("got {}, allowed: run, check, report, sweep, restate, keys", left.front())
               : error.what();
  return fmt::format("granvof: {} (granvof --help says what is allowed)\n",
                     granvof::case_file::printable(what, longest_message));
}

int parse_and_run(int argc, char** argv, const granvof::Communicator* processes) {
  CLI::App app{"A continuum solver for gas-liquid-solid flow."};
  app.name("granvof");
  app.set_version_flag("--version", granvof::version_text("granvof"));
  app.require_subcommand(1);
  app.failure_message(failure_text);

  Arguments arguments;
  arguments.run.command = command_line(argc, argv);
  arguments.run.processes = processes;
  CLI::App& run_command = *app.add_subcommand("run", "Run a case and write its results");
  add_case(run_command, arguments);
  std::string out;
  run_command.add_option("--out", out, "Run directory, by default out/runs/NAME")->type_name("DIR");
  run_command.add_option("--threads", arguments.run.threads, "Threads")
      ->capture_default_str()
      ->check(CLI::Range(1, most_threads))
      ->type_name("N");
  CLI::Option* resume =
      run_command.add_flag("--resume", arguments.run.resume, "Go on from the run directory's checkpoint");
  run_command
      .add_flag("--force", arguments.run.force,
                "Replace a run of another case, or one that came further, in the run directory")
      ->excludes(resume);
  std::string stop_after;
  run_command
      .add_option("--stop-after", stop_after,
                  "Stop after so much wall-clock time, as 45s or 3h50m: checkpoint, exit code 3")
      ->type_name("TIME")
      ->check([](const std::string& text) { return duration_fault(text); });
  CLI::App& check_command =
      *app.add_subcommand("check", "Check a case and print it in full, defaults filled in");
  add_case(check_command, arguments);
  check_command
      .add_option("--picture", arguments.picture,
                  "Draw the start: tank, liquid, bed, gate, sides, grid (SVG)")
      ->type_name("FILE");
  CLI::App& report_command =
      *app.add_subcommand("report", "Film, plots and a page of runs: DIR/report/report.html");
  report_command.add_option("directory", arguments.directories, "Run directories")
      ->required()
      ->type_name("DIR");
  CLI::App& sweep_command = *app.add_subcommand(
      "sweep", "Run a case with every combination of values: a table and a plot, in DIR/NAME");
  add_case(sweep_command, arguments);
  sweep_command.get_option("--set")
      ->description("Values of a key, parted by commas; again for more keys")
      ->type_name("TABLE.KEY=VALUE,...");
  sweep_command
      .add_option("--metric", arguments.metrics,
                  "Column of series.csv, its last value; may be given again (front_dense)")
      ->type_name("COLUMN")
      ->allow_extra_args(false);
  sweep_command
      .add_option("--jobs", arguments.jobs, "Runs beside each other (1: each alone, its cost is measured)")
      ->check(CLI::Range(1, most_threads))
      ->type_name("N");
  sweep_command.add_option("--out", out, "By default out/sweep")->type_name("DIR");
  CLI::App& restate_command = *app.add_subcommand(
      "restate", "Print a case in full in other units: the same dimensionless problem, the same steps");
  add_case(restate_command, arguments);
  const CLI::Validator within_reason(
      [](const std::string& given) {
        double value = 0.0;
        const bool read = CLI::detail::lexical_cast(given, value);
        return read && value >= 1e-30 && value <= 1e30 ? std::string()
                                                       : given + " given, allowed: a number in [1e-30, 1e30]";
      },
      "FACTOR");
  const auto add_factor = [&](const char* name, double& factor, const char* help) {
    restate_command.add_option(name, factor, help)->capture_default_str()->check(within_reason);
  };
  add_factor("--mass", arguments.factors.mass, "Factor of every mass: 1000 for grams");
  add_factor("--length", arguments.factors.length, "Factor of every length: 0.01 for a model of 1 to 100");
  add_factor("--time", arguments.factors.time, "Factor of every time: 1000 for milliseconds");
  CLI::App& keys_command =
      *app.add_subcommand("keys", "Print the reference table of a case's keys (Markdown)");

  granvof::refuse_empty_values(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : bad_input;
  }
  require_alone(app, processes);
  arguments.run.out = out;
  if (!stop_after.empty()) arguments.run.stop_after = granvof::read_duration(stop_after);
  if (keys_command.parsed()) return keys();
  if (check_command.parsed()) return check(arguments);
  if (report_command.parsed()) granvof::hand_over("report", "show", arguments.directories);
  if (sweep_command.parsed()) sweep(arguments);
  if (restate_command.parsed()) return restate(arguments);
  return run(arguments);
}

// Messages are stderr's: stdout holds what was asked for.
void send_messages_to_stderr() {
  spdlog::set_default_logger(spdlog::stderr_color_mt("granvof"));
}

int say(const std::exception& error, int code) {
  fmt::print(stderr, "granvof: {}\n", granvof::case_file::printable(error.what(), longest_message));
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  granvof::prepare_standard_streams();
  if (!granvof::has_stack("granvof")) return bad_input;
  send_messages_to_stderr();
  // Of several processes the lowest speaks.
  std::unique_ptr<granvof::Communicator> processes;
  try {
    processes = granvof::launched_processes();
    if (processes != nullptr && processes->rank() > 0) granvof::keep_silent();
    const int code = parse_and_run(argc, argv, processes.get());
    granvof::require_stdout_written();
    return code;
  } catch (const granvof::CaseError& error) {  // a line for each fault, made printable where it was found
    fmt::print(stderr, "{}\n", error.what());
    return bad_input;
  } catch (const granvof::OutputError& error) {
    return say(error, bad_input);
  } catch (const std::filesystem::filesystem_error& error) {  // such as a link to itself
    return say(error, bad_input);
  } catch (const std::exception& error) {
    return say(error, 1);
  }
}
