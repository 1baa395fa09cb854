#include "reference/demvof/program/watched_work.hpp"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "reference/demvof/beads/bead_log.hpp"
#include "reference/demvof/program/exit_code.hpp"
#include "solver/output/atomic_file.hpp"
#include "solver/output/own_process.hpp"
#include "solver/output/stop_signals.hpp"
#include "solver/scene/printable.hpp"

namespace demvof {

namespace {

using granvof::Descriptor;

// How long a signal or an end may stay unnoticed: signals do not break off a wait.
constexpr auto between_looks = std::chrono::milliseconds(10);
constexpr std::size_t longest_reason = 500;  // bytes

// The byte in the pipe says that the work came to its own end.
[[noreturn]] void work_and_end(const std::function<int()>& work, const Descriptor& result, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // it ended before it could be watched
  const auto code = static_cast<unsigned char>(exit_code_of(work));
  std::fflush(nullptr);
  if (::write(result.get(), &code, 1) != 1) ::_exit(1);
  ::_exit(code);
}

int wait_for(pid_t child) {
  int status = 0, passed_on = 0;
  while (::waitpid(child, &status, WNOHANG) == 0) {
    if (const int signal = granvof::stop_signal(); signal != passed_on) {
      ::kill(child, signal);
      passed_on = signal;
    }
    std::this_thread::sleep_for(between_looks);
  }
  return status;
}

std::string how_it_ended(int status) {
  if (WIFEXITED(status)) return fmt::format("exit code {}", WEXITSTATUS(status));
  return fmt::format("signal {} ({})", WTERMSIG(status), ::strsignal(WTERMSIG(status)));
}

}  // namespace

WorkEnd work_in_own_process(const std::function<int()>& work) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    return {std::nullopt, fmt::format("no pipe could be made: {}", std::strerror(errno)), 0};
  const Descriptor read_end(ends[0]);
  Descriptor write_end(ends[1]);
  std::fflush(nullptr);  // what is in a buffer would be written twice
  granvof::expect_to_be_told_of_ends();
  const pid_t parent = ::getpid(), child = ::fork();
  if (child < 0) return {std::nullopt, fmt::format("no process could be made: {}", std::strerror(errno)), 0};
  if (child == 0) work_and_end(work, write_end, parent);
  write_end.close();
  const int status = wait_for(child);
  unsigned char code = 0;
  if (::read(read_end.get(), &code, 1) == 1) return {code, "", child};
  return {std::nullopt, how_it_ended(status), child};
}

std::string reason_of(const WorkEnd& end, const std::filesystem::path& scratch) {
  const std::string said = last_bead_error(scratch, end.process);
  return fmt::format("{} ended the program with {}{}{}", said.empty() ? "LIGGGHTS or OpenFOAM" : "LIGGGHTS",
                     end.how, said.empty() ? "" : ": ", granvof::case_file::printable(said, longest_reason));
}

}  // namespace demvof
