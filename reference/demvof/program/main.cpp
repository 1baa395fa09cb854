// The program demvof: run, chute, element and hash. Exit codes: 0 done, 1 the run failed, 2 bad input.
#include <cstdio>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <mpi.h>
#include <unistd.h>

#include "reference/demvof/program/exit_code.hpp"
#include "reference/demvof/program/record_chute.hpp"
#include "reference/demvof/program/record_element.hpp"
#include "reference/demvof/program/record_scene.hpp"
#include "solver/output/build_info.hpp"
#include "solver/output/empty_values.hpp"
#include "solver/output/own_stack.hpp"
#include "solver/output/standard_streams.hpp"
#include "solver/scene/load_scene.hpp"
#include "solver/scene/printable.hpp"

namespace {

constexpr int bad_input = 2;
constexpr std::size_t longest_message = 1500;  // bytes

struct Arguments {
  std::string case_file;
  std::vector<std::string> overrides;
  demvof::RecordOptions record;
};

void add_case(CLI::App& command, Arguments& arguments) {
  command.add_option("case", arguments.case_file, "Case file (TOML)")->required()->type_name("CASE");
  command.add_option("--set", arguments.overrides, "Replace a key of the case; may be given again")
      ->type_name("TABLE.KEY=VALUE")
      ->allow_extra_args(false);
}

void add_places(CLI::App& command, Arguments& arguments) {
  command.add_option("--out", arguments.record.out, "Run directory")->type_name("DIR");
  command.add_option("--scratch", arguments.record.scratch, "Folder for intermediate files")
      ->type_name("DIR");
  command.add_option("--seed", arguments.record.seed, "Seed of the beads and the floor");
}

int run(const Arguments& arguments) {
  const granvof::Scene scene = granvof::load_scene(arguments.case_file, arguments.overrides);
  demvof::RecordOptions options = arguments.record;
  options.progress = options.progress || ::isatty(STDERR_FILENO) != 0;
  if (options.out.empty()) options.out = fmt::format("out/reference/{}/seed{}", scene.name, options.seed);
  if (options.scratch.empty()) options.scratch = "out/reference/scratch";
  return demvof::record_scene(scene, options);
}

int chute(const Arguments& arguments) {
  const granvof::Scene scene = granvof::load_scene(arguments.case_file, arguments.overrides);
  demvof::RecordOptions options = arguments.record;
  if (options.out.empty())
    options.out = fmt::format("out/reference/bulk-friction/{}/seed{}", scene.name, options.seed);
  if (options.scratch.empty()) options.scratch = "out/reference/scratch";
  return demvof::record_chute(scene, options);
}

int element(const Arguments& arguments) {
  const granvof::Scene scene = granvof::load_scene(arguments.case_file, arguments.overrides);
  demvof::RecordOptions options = arguments.record;
  options.progress = options.progress || ::isatty(STDERR_FILENO) != 0;
  if (options.out.empty())
    options.out = fmt::format("out/reference/element/{}/seed{}", scene.name, options.seed);
  if (options.scratch.empty()) options.scratch = "out/reference/scratch";
  return demvof::record_element(scene, options);
}

int hash(const Arguments& arguments) {
  const granvof::Scene scene = granvof::load_scene(arguments.case_file, arguments.overrides);
  fmt::print("{} {}\n", scene.reference_hash, scene.hash);
  return 0;
}

int parse_and_run(int argc, char** argv) {
  CLI::App app("Unresolved DEM-VOF with LIGGGHTS and OpenFOAM, the reference of granvof");
  app.require_subcommand(1);
  app.set_version_flag("--version", granvof::version_text("demvof"));
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return fmt::format("demvof: {} (demvof --help says what is allowed)\n",
                       granvof::case_file::printable(error.what(), longest_message));
  });
  Arguments arguments;
  arguments.record.command = fmt::format("{}", fmt::join(std::vector<std::string>(argv, argv + argc), " "));

  CLI::App* run_command = app.add_subcommand("run", "Prepare, hold, release and run one scene with one seed");
  add_case(*run_command, arguments);
  add_places(*run_command, arguments);
  run_command->add_flag("--gate-closed", arguments.record.gate_closed, "Control run: the gate stays closed");
  run_command->add_flag("--force", arguments.record.force,
                        "Replace a run of another case, or one that came further, in the run directory");
  run_command->add_flag("--progress", arguments.record.progress,
                        "Say how far the run is, where stderr is no terminal too");

  CLI::App* chute_command =
      app.add_subcommand("chute", "Measure the bulk friction mu(I) of a case's beads on a dry chute");
  add_case(*chute_command, arguments);
  add_places(*chute_command, arguments);

  CLI::App* element_command = app.add_subcommand(
      "element", "Measure the material of a case's beads in dry tests and write it as a piece of a case");
  add_case(*element_command, arguments);
  add_places(*element_command, arguments);
  element_command->add_flag("--progress", arguments.record.progress,
                            "Say which test runs, where stderr is no terminal too");

  CLI::App* hash_command =
      app.add_subcommand("hash", "Print two hashes: of what the reference depends on, and of the case");
  add_case(*hash_command, arguments);

  granvof::refuse_empty_values(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : bad_input;
  }
  if (*run_command) return run(arguments);
  if (*element_command) return element(arguments);
  return *chute_command ? chute(arguments) : hash(arguments);
}

}  // namespace

int main(int argc, char** argv) {
  granvof::prepare_standard_streams();
  if (!granvof::has_stack("demvof")) return bad_input;
  return demvof::exit_code_of([&] {
    const int code = parse_and_run(argc, argv);
    granvof::require_stdout_written();
    return code;
  });
}
