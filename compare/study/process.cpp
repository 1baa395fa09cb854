#include "compare/study/process.hpp"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "solver/output/own_process.hpp"

namespace granvof::compare {

namespace {

// Starts the program so that it is asked to end when this one ends, however that happens: a run that nobody
// waits for would hold its directory against the next.
pid_t start(const std::vector<char*>& arguments, const std::filesystem::path& log) {
  int failure[2];  // errno of a start that failed; closed by one that succeeds
  if (pipe2(failure, O_CLOEXEC) != 0) throw std::runtime_error(std::string("pipe: ") + std::strerror(errno));
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child == 0) {
    // Only calls that are safe between fork and exec.
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(127);
    const int in = open("/dev/null", O_RDONLY);
    const int out = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (in >= 0 && out >= 0 && dup2(in, STDIN_FILENO) >= 0 && dup2(out, STDOUT_FILENO) >= 0 &&
        dup2(out, STDERR_FILENO) >= 0)
      execv(arguments[0], arguments.data());
    const int error = errno;
    [[maybe_unused]] const ssize_t told = write(failure[1], &error, sizeof error);
    _exit(127);
  }
  const int not_forked = errno;
  close(failure[1]);
  int error = child < 0 ? not_forked : 0;
  if (child > 0 && read(failure[0], &error, sizeof error) > 0) waitpid(child, nullptr, 0);
  close(failure[0]);
  if (error != 0)
    throw std::runtime_error(std::string("cannot start ") + arguments[0] + ": " + std::strerror(error));
  return child;
}

}  // namespace

Ended run_program(const std::vector<std::string>& command, const std::filesystem::path& log, double timeout) {
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& part : command) arguments.push_back(const_cast<char*>(part.c_str()));
  arguments.push_back(nullptr);

  expect_to_be_told_of_ends();
  const pid_t child = start(arguments, log);

  using Clock = std::chrono::steady_clock;
  const auto deadline = Clock::now() + std::chrono::duration<double>(timeout);
  Ended ended;
  int status = 0;
  for (;;) {
    const pid_t done = waitpid(child, &status, WNOHANG);
    if (done == child) break;
    if (done < 0 && errno != EINTR)
      throw std::runtime_error("lost sight of " + command.front() + ": " + std::strerror(errno));
    if (!ended.timed_out && Clock::now() > deadline) {
      ended.timed_out = true;
      kill(child, SIGKILL);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  ended.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return ended;
}

}  // namespace granvof::compare
