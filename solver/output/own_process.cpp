#include "solver/output/own_process.hpp"

#include <cerrno>
#include <csignal>

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace granvof {
namespace {

[[noreturn]] void work_and_end(const char* directory, const std::function<void()>& work, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // it ended before it could be watched
  if (::chdir(directory) != 0) ::_exit(1);
  // A copy of the lock of a directory would hold it a moment longer than the program that has it.
  ::close_range(STDERR_FILENO + 1, ~0U, 0);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  try {
    work();
    ::_exit(0);
  } catch (...) {
    ::_exit(1);
  }
}

}  // namespace

void expect_to_be_told_of_ends() {
  std::signal(SIGCHLD, SIG_DFL);
}

bool succeeds_in_own_process(const std::filesystem::path& directory, const std::function<void()>& work) {
  expect_to_be_told_of_ends();
  const pid_t parent = ::getpid(), child = ::fork();
  if (child < 0) return false;
  if (child == 0) work_and_end(directory.c_str(), work, parent);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return false;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace granvof
