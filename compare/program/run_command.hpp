// The subcommand run: makes the runs of a plan.
#pragma once

#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>

namespace granvof::compare {

// The program granvof built beside this one.
std::filesystem::path default_solver();

class RunCommand {
 public:
  explicit RunCommand(CLI::App& app);
  bool parsed() const;
  // A line of JSON on stdout for every run that starts ({"started": id}) and that ended. Exit code: 0 all
  // finished, 1 one did not. Throws std::runtime_error for a plan that cannot be read.
  int run();

 private:
  struct Options;
  std::shared_ptr<Options> options_;
};

}  // namespace granvof::compare
