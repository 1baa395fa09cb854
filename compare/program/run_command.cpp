#include "compare/program/run_command.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <poll.h>
#include <unistd.h>

#include "compare/engine/engine.hpp"
#include "solver/output/atomic_file.hpp"

namespace granvof::compare {
namespace {

namespace fs = std::filesystem;

// Lines of stdin as they come, so that whoever writes them may wait for endings in between.
class Lines {
 public:
  bool ended() const { return ended_ && text_.empty(); }
  // The next line, if it is there.
  std::optional<std::string> next() {
    read_what_is_there();
    auto end = text_.find('\n');
    if (end == std::string::npos) {
      if (!ended_ || text_.empty()) return std::nullopt;
      end = text_.size();
    }
    std::string line = text_.substr(0, end);
    text_.erase(0, end + 1);
    return line;
  }

 private:
  void read_what_is_there() {
    pollfd in{STDIN_FILENO, POLLIN, 0};
    while (!ended_ && ::poll(&in, 1, 0) > 0) {
      char part[4096];
      const ssize_t got = ::read(STDIN_FILENO, part, sizeof part);
      if (got < 0 && errno != EINTR) throw std::system_error(errno, std::generic_category(), "stdin");
      if (got == 0) ended_ = true;
      if (got > 0) text_.append(part, static_cast<std::size_t>(got));
    }
  }

  std::string text_;
  bool ended_ = false;
};

void tell_start(const std::string& id) {
  fmt::print("{}\n", nlohmann::json{{"started", id}}.dump());
  std::fflush(stdout);
}

}  // namespace

struct RunCommand::Options {
  CLI::App* command = nullptr;
  std::string plan = "-";
  fs::path solver = default_solver(), accounts;
  int jobs = 1, only = 0;
  int line = 0;  // of the plan, read so far
  bool all_finished = true;

  std::optional<Order> read(const std::string& text) {
    ++line;
    if (text.find_first_not_of(" \t\r") == std::string::npos || (only > 0 && line != only))
      return std::nullopt;
    try {
      return read_order(text);
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(
          fmt::format("run: {}, line {}: {}", plan == "-" ? "stdin" : plan, line, error.what()));
    }
  }

  void report(const Ending& ending) {
    all_finished = all_finished && ending.finished();
    fmt::print("{}\n", ending_line(ending));
    std::fflush(stdout);
  }

  // All of a file first: what is wrong with it is said before anything is run.
  void submit_file(Engine& engine) {
    std::istringstream lines(read_file(plan));
    bool any = false;
    for (std::string text; std::getline(lines, text);) {
      if (auto order = read(text)) {
        engine.submit(*std::move(order));
        any = true;
      }
    }
    if (only > line)
      throw std::runtime_error(fmt::format("run: --only {}: {} has {} lines", only, plan, line));
    if (!any) throw std::runtime_error(fmt::format("run: there is no run in {}", plan));
  }
};

fs::path default_solver() {
  std::error_code unknown;
  const fs::path self = fs::read_symlink("/proc/self/exe", unknown);
  return unknown ? fs::path("granvof") : self.parent_path().parent_path() / "solver/granvof";
}

RunCommand::RunCommand(CLI::App& app) : options_(std::make_shared<Options>()) {
  options_->command =
      app.add_subcommand("run", "make the runs of a plan: one JSON object a line (docs/run-engine.md)");
  CLI::App& command = *options_->command;
  command.add_option("plan", options_->plan, "file of the plan; -: stdin, as its lines come")
      ->capture_default_str();
  command.add_option("--solver", options_->solver, "the program granvof")->capture_default_str();
  command.add_option("--jobs", options_->jobs, "runs beside each other; timed ones go alone")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command
      .add_option("--only", options_->only,
                  "this line of the plan alone, counted from 1 (a task of a job array)")
      ->check(CLI::PositiveNumber);
  command.add_option("--accounts", options_->accounts, "CSV that gets a line for every run: what it cost");
}

bool RunCommand::parsed() const {
  return options_->command->parsed();
}

int RunCommand::run() {
  Options& o = *options_;
  Engine engine({{o.solver.string()}, o.jobs, o.accounts});
  std::optional<Lines> stdin_lines;
  if (o.plan == "-")
    stdin_lines.emplace();
  else
    o.submit_file(engine);
  while (!engine.idle() || (stdin_lines && !stdin_lines->ended())) {
    if (stdin_lines)
      while (const auto text = stdin_lines->next())
        if (auto order = o.read(*text)) engine.submit(*std::move(order));
    const std::vector<std::string> before = engine.running();
    const auto ending = engine.look();
    for (const std::string& id : engine.running())
      if (std::find(before.begin(), before.end(), id) == before.end()) tell_start(id);
    if (ending)
      o.report(*ending);
    else if (engine.running() == before)
      std::this_thread::sleep_for(between_looks);
  }
  return o.all_finished ? 0 : 1;
}

}  // namespace granvof::compare
