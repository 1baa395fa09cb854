#include "solver/output/standard_streams.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <stdexcept>

#include <fcntl.h>
#include <unistd.h>

namespace granvof {

namespace {

// The other way round than the stream is used: reading and writing fail, as they do where it is closed.
void fill_closed_streams() {
  constexpr std::array<int, 3> ways = {O_WRONLY, O_RDONLY, O_RDWR};
  for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; ++fd)
    if (::fcntl(fd, F_GETFD) < 0) ::open("/dev/null", ways[static_cast<std::size_t>(fd)]);
}

// Before the libraries begin: OpenFOAM opens a file of its own then, whose number would be that of the
// stream.
[[gnu::section(".preinit_array"), gnu::used]] void (*const before_libraries)() = fill_closed_streams;

}  // namespace

void prepare_standard_streams() {
  std::signal(SIGXFSZ, SIG_IGN);
}

void require_stdout_written() {
  const bool written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  // A disk across the network may say only when a descriptor is closed that it had no room.
  const int copy = written ? ::dup(STDOUT_FILENO) : -1;
  if (!written || (copy >= 0 && ::close(copy) != 0 && errno != EINTR))
    throw std::runtime_error("cannot write to standard output");
}

}  // namespace granvof
