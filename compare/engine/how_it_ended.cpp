#include "compare/engine/how_it_ended.hpp"

#include <csignal>
#include <exception>
#include <regex>

#include <fmt/format.h>

#include "compare/input/run.hpp"
#include "solver/output/atomic_file.hpp"

namespace granvof::compare {
namespace {

constexpr int exit_code_of_bad_input = 2;

// The last line of the log, without the stamps before it.
std::string last_words(const std::filesystem::path& log) {
  std::error_code unknown;
  std::string text = std::filesystem::exists(log, unknown) ? without_end(read_file(log)) : "";
  const auto begin = text.find_last_of('\n');
  if (begin != std::string::npos) text.erase(0, begin + 1);
  static const std::regex stamps(R"(^(\[[^\]]*\] *)+)");
  return std::regex_replace(text, stamps, "");
}

std::optional<RunFacts> facts_of_this_run(const std::filesystem::path& directory,
                                          const std::optional<std::filesystem::file_time_type>& earlier) {
  const auto file = directory / "run.json";
  const auto written = time_of(file);
  if (!written || written == earlier) return std::nullopt;
  try {
    return read_facts(file);
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

bool somebody_ended(int code) {
  return code == 128 + SIGTERM || code == 128 + SIGINT || code == 128 + SIGHUP;
}

}  // namespace

std::optional<std::filesystem::file_time_type> time_of(const std::filesystem::path& file) {
  std::error_code missing;
  const auto time = std::filesystem::last_write_time(file, missing);
  return missing ? std::nullopt : std::optional(time);
}

std::filesystem::path log_of(const std::filesystem::path& directory) {
  return directory.string() + ".log";
}

void note_how_it_ended(Ending& ending, const Ended& process, const Limits& limits,
                       const std::optional<std::filesystem::file_time_type>& earlier) {
  ending.process = process;
  const std::string said = last_words(log_of(ending.directory));
  const auto fail = [&](std::string_view kind, std::string message) {
    ending.kind = kind;
    ending.message = std::move(message);
  };
  const auto with_code = [&] {
    return fmt::format("exit code {}: {}", process.code, said.empty() ? "no message" : said);
  };
  if (process.timed_out)
    return fail(ending::time_limit,
                fmt::format("ended after {:g} s of wall-clock time", limits.wall_seconds));
  if (process.code == exit_code_of_bad_input) return fail(ending::bad_input, said);
  if (process.code == 128 + SIGXCPU)
    return fail(ending::cpu_limit, fmt::format("not done after {:g} core-s", limits.cpu_seconds));
  if (somebody_ended(process.code)) return fail(ending::signal, with_code());
  const auto facts = facts_of_this_run(ending.directory, earlier);
  if (!facts || facts->kind == ending::running)
    return fail(ending::crashed, process.code == 0 ? "it ended and left no run.json" : with_code());
  if (facts->kind != ending::finished)
    return fail(facts->kind, facts->reason.empty() ? with_code() : facts->reason);
  if (process.code != 0) return fail("error", with_code());
  ending.kind = ending::finished;
  ending.message.clear();
}

}  // namespace granvof::compare
