#include "compare/engine/process.hpp"

#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include "solver/output/atomic_file.hpp"
#include "solver/output/own_process.hpp"

namespace granvof::compare {
namespace {

using Clock = std::chrono::steady_clock;

constexpr rlim_t grace = 5;  // CPU seconds from SIGXCPU, for the last checkpoint, to SIGKILL

double seconds(const timeval& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

pid_t start(const std::vector<char*>& arguments, const std::filesystem::path& log, double cpu_seconds) {
  expect_to_be_told_of_ends();
  int failure[2];  // errno of a start that failed; closed by one that succeeds
  if (pipe2(failure, O_CLOEXEC) != 0) throw std::runtime_error(std::string("pipe: ") + std::strerror(errno));
  const pid_t parent = getpid();
  const auto most = static_cast<rlim_t>(std::ceil(cpu_seconds));
  const pid_t child = fork();
  if (child == 0) {
    // Only calls that are safe between fork and exec.
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(127);
    const rlimit limit{most, most + grace};
    if (most > 0) setrlimit(RLIMIT_CPU, &limit);
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

pid_t start(const std::vector<std::string>& command, const std::filesystem::path& log, double cpu_seconds) {
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& part : command) arguments.push_back(const_cast<char*>(part.c_str()));
  arguments.push_back(nullptr);
  return start(arguments, log, cpu_seconds);
}

}  // namespace

Child::Child(const std::vector<std::string>& command, const std::filesystem::path& log, const Limits& limits)
    : id_(start(command, log, limits.cpu_seconds)), name_(command.front()), limits_(limits) {}

Child::Child(Child&& other) noexcept
    : id_(std::exchange(other.id_, -1)),
      name_(std::move(other.name_)),
      limits_(other.limits_),
      timed_out_(other.timed_out_),
      begun_(other.begun_) {}

Child::~Child() {
  if (id_ <= 0) return;
  kill(id_, SIGKILL);
  waitpid(id_, nullptr, 0);
}

std::optional<Ended> Child::poll() {
  if (id_ <= 0) return std::nullopt;
  const double spent = std::chrono::duration<double>(Clock::now() - begun_).count();
  int status = 0;
  rusage usage{};
  const pid_t done = wait4(id_, &status, WNOHANG, &usage);
  if (done < 0 && errno != EINTR)
    throw std::runtime_error("lost sight of " + name_ + ": " + std::strerror(errno));
  if (done != id_) {
    if (!timed_out_ && limits_.wall_seconds > 0.0 && spent > limits_.wall_seconds) {
      timed_out_ = true;
      kill(id_, SIGKILL);
    }
    return std::nullopt;
  }
  id_ = -1;
  return Ended{WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), timed_out_, spent,
               seconds(usage.ru_utime) + seconds(usage.ru_stime), usage.ru_maxrss};
}

std::string without_end(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  return text;
}

Ended run_program(const std::vector<std::string>& command, const std::filesystem::path& log,
                  const Limits& limits) {
  Child child(command, log, limits);
  for (;;) {
    if (const auto ended = child.poll()) return *ended;
    std::this_thread::sleep_for(between_looks);
  }
}

std::string version_of(const std::filesystem::path& program) {
  const Descriptor said(memfd_create("version", MFD_CLOEXEC));
  const std::string name = fmt::format("/proc/{}/fd/{}", getpid(), said.get());
  if (run_program({program.string(), "--version"}, name, {60.0, 0.0}).code != 0)
    throw std::runtime_error(fmt::format("{} --version failed", program.string()));
  return without_end(read_file(name));
}

}  // namespace granvof::compare
