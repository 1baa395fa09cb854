#include "reference/demvof/beads/messages_into.hpp"

#include <cstdio>

#include <fcntl.h>
#include <unistd.h>

namespace demvof {

MessagesInto::MessagesInto(const std::string& file) {
  const int log = ::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (log < 0) return;
  std::fflush(stderr);
  kept_ = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
  if (kept_ >= 0) ::dup2(log, STDERR_FILENO);
  ::close(log);
}

MessagesInto::~MessagesInto() {
  if (kept_ < 0) return;
  std::fflush(stderr);
  ::dup2(kept_, STDERR_FILENO);
  ::close(kept_);
}

}  // namespace demvof
