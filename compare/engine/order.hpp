// One run that is to be made, and how it ended; as lines of JSON between programs.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "compare/engine/process.hpp"

namespace granvof::compare {

struct Order {
  std::string id;  // for whoever reads the endings
  std::filesystem::path case_file;
  std::vector<std::string> set;           // overrides "key=value"
  std::filesystem::path directory;        // of the run; its messages go to DIRECTORY.log
  std::vector<std::string> program = {};  // that is run instead of the engine's: words before "run CASE"
  int threads = 1;
  Limits limits = {};
  // Its cost is what it is made for: nothing runs beside it, and work units are timed before and after.
  bool timed = false;
  int timings = 1;  // a timed run cheaper than cheap_run is made so often
  bool keep =
      false;  // where the same program made the same run, that is taken, and one cut short gone on with
  // The directory is the engine's own: a run that is there goes before, whole or not. Where there is anything
  // else nothing is run.
  bool clear = false;
};

inline constexpr double cheap_run = 2.0;  // [core-s]: the cost of a second is mostly noise

// Kinds of an ending: those of `exit.kind` in run.json (solver/output/run_record.hpp), and what the run
// itself cannot tell.
namespace ending {
inline constexpr std::string_view running = "running";  // it goes on, or could not say how it ended
inline constexpr std::string_view finished = "finished";
inline constexpr std::string_view signal = "signal";          // somebody stopped it
inline constexpr std::string_view time_limit = "time limit";  // killed after Limits::wall_seconds
inline constexpr std::string_view cpu_limit = "CPU limit";    // after Limits::cpu_seconds
inline constexpr std::string_view bad_input = "bad input";    // nothing was run
inline constexpr std::string_view crashed = "crashed";        // ended without saying so in run.json
}  // namespace ending

struct Ending {
  std::string id;
  std::filesystem::path directory;
  std::string kind;
  std::string message;  // why it did not finish, one line; empty where it did
  Ended process;        // of the last timing
  bool kept = false;    // it was there already
  bool resumed = false;
  int beside = 0;  // runs that went on at the same time, at most
  // Of a timed run, one value each timing: CPU time of the time loop; and the work units, before and after
  // each.
  std::vector<double> core_seconds, work_units;

  bool finished() const { return kind == ending::finished; }
};

// Throws std::invalid_argument, which says what is wrong with the line.
Order read_order(std::string_view json_line);
std::string order_line(const Order& order);
std::string ending_line(const Ending& ending);

}  // namespace granvof::compare
