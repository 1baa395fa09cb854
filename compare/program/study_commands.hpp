// The commands of granvof-compare that make runs: ablate, advise and charts.
#pragma once

#include <memory>

#include <CLI/CLI.hpp>

namespace granvof::compare {

class StudyCommands {
 public:
  explicit StudyCommands(CLI::App& app);
  // Whether one of them was asked for, and its exit code. run() throws what its parts throw.
  bool parsed() const;
  int run();

 private:
  struct Options;
  std::shared_ptr<Options> options_;
};

}  // namespace granvof::compare
