#include "solver/scene/regular_file.hpp"

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace granvof {

RegularFile open_regular(const std::filesystem::path& path) {
  const auto reason = [](int error) { return std::generic_category().message(error); };
  const std::string other = "it is a device or a pipe";
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (file < 0) return {-1, 0, errno == ENXIO ? other : reason(errno)};  // ENXIO: a socket
  struct stat status {};
  std::string fault;
  if (::fstat(file, &status) != 0) fault = reason(errno);
  if (fault.empty() && !S_ISREG(status.st_mode)) fault = S_ISDIR(status.st_mode) ? reason(EISDIR) : other;
  if (fault.empty()) return {file, static_cast<std::uintmax_t>(status.st_size), ""};
  ::close(file);
  return {-1, 0, fault};
}

}  // namespace granvof
