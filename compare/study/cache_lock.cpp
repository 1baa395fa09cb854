#include "compare/study/cache_lock.hpp"

#include <algorithm>
#include <cerrno>
#include <stdexcept>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include "compare/engine/process.hpp"
#include "solver/output/output_error.hpp"
#include "solver/output/run_record.hpp"

namespace granvof::compare {
namespace {

constexpr std::size_t longest_command = 200;  // in a message

std::string own_command() {
  std::string command;
  try {
    command = read_file("/proc/self/cmdline");
  } catch (const OutputError&) {
    return "";
  }
  std::replace(command.begin(), command.end(), '\0', ' ');
  return command.substr(0, longest_command);
}

}  // namespace

CacheLock::CacheLock(const std::filesystem::path& cache) {
  const auto path = cache / "lock";
  file_ = Descriptor(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
  if (!file_.valid()) throw OutputError("write", path, std::generic_category().message(errno));
  if (::flock(file_.get(), LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK) throw OutputError("lock", path, std::generic_category().message(errno));
    const std::string holder = without_end(read_file(path));
    throw std::runtime_error(fmt::format("{} is in use: {}; wait for its end, or give another --cache",
                                         cache.string(), holder.empty() ? "another study has it" : holder));
  }
  const std::string text =
      fmt::format("process {} since {}: {}\n", ::getpid(), iso_date_now(), own_command());
  if (::ftruncate(file_.get(), 0) != 0)
    throw OutputError("write", path, std::generic_category().message(errno));
  write_all(file_, text, path);
}

}  // namespace granvof::compare
