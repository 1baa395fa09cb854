// Another program: started, and looked after until it ends.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace granvof::compare {

struct Ended {
  int code = -1;           // exit code, or 128 + signal
  bool timed_out = false;  // ended here, after the wall-clock limit
  double wall_seconds = 0.0;
  double cpu_seconds = 0.0;  // all threads, start-up and output as well
  long kilobytes = 0;        // largest resident size
};

struct Limits {
  double wall_seconds = 0.0;  // after which it is killed; 0: none
  double cpu_seconds = 0.0;   // after which it gets SIGXCPU; 0: none
};

// Asked to end (SIGTERM) when this program ends, however that happens: a run that nobody waits for would hold
// its directory against the next. Killed and waited for where this is destroyed before it has ended.
class Child {
 public:
  // `command`: program and arguments, no shell; its output goes to `log`. Throws std::runtime_error where it
  // cannot be started.
  Child(const std::vector<std::string>& command, const std::filesystem::path& log, const Limits& limits);
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  Child(Child&& other) noexcept;
  Child& operator=(Child&&) = delete;
  ~Child();

  // How it ended; nothing while it goes on. Once it has been told, never again.
  std::optional<Ended> poll();

 private:
  pid_t id_;
  std::string name_;
  Limits limits_;
  bool timed_out_ = false;
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
};

inline constexpr std::chrono::milliseconds between_looks{20};  // whether a program has ended

// What a program said, without the blanks and ends of lines at its end.
std::string without_end(std::string text);

// Runs `command` and waits.
Ended run_program(const std::vector<std::string>& command, const std::filesystem::path& log,
                  const Limits& limits = {});

// What the program says to `--version`. Throws std::runtime_error where it says nothing.
std::string version_of(const std::filesystem::path& program);

}  // namespace granvof::compare
