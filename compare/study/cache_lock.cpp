#include "compare/study/cache_lock.hpp"

#include <algorithm>
#include <cerrno>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "compare/engine/process.hpp"
#include "solver/output/output_error.hpp"
#include "solver/output/run_record.hpp"

namespace granvof::compare {
namespace {

constexpr std::size_t longest_command = 200;  // in a message
constexpr std::string_view word_of_holder = "process ";

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

// Whether the open file is still the one of that name: who held it may have removed it meanwhile.
bool is_at(const Descriptor& file, const std::filesystem::path& path) {
  struct stat open {
  }, named{};
  return ::fstat(file.get(), &open) == 0 && ::stat(path.c_str(), &named) == 0 &&
         open.st_dev == named.st_dev && open.st_ino == named.st_ino;
}

}  // namespace

CacheLock::CacheLock(const std::filesystem::path& cache) : path_(cache / "lock") {
  do {
    file_ = Descriptor(::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
    if (!file_.valid()) throw OutputError("write", path_, std::generic_category().message(errno));
    if (::flock(file_.get(), LOCK_EX | LOCK_NB) != 0) {
      if (errno != EWOULDBLOCK) throw OutputError("lock", path_, std::generic_category().message(errno));
      const std::string holder = without_end(read_file(path_));
      throw std::runtime_error(fmt::format("{} is in use: {}; wait for its end, or give another --cache",
                                           cache.string(), holder.empty() ? "another study has it" : holder));
    }
  } while (!is_at(file_, path_));
  const std::string earlier = read_file(path_);
  if (!earlier.empty() && !earlier.starts_with(word_of_holder))
    throw std::runtime_error(
        fmt::format("{} is no lock of a study: remove it, or give another --cache", path_.string()));
  const std::string text =
      fmt::format("{}{} since {}: {}\n", word_of_holder, ::getpid(), iso_date_now(), own_command());
  try {
    if (::ftruncate(file_.get(), 0) != 0)
      throw OutputError("write", path_, std::generic_category().message(errno));
    write_all(file_, text, path_);
  } catch (const OutputError&) {
    ::unlink(path_.c_str());
    throw;
  }
}

// While it is held: nobody else's is removed.
CacheLock::~CacheLock() {
  ::unlink(path_.c_str());
}

}  // namespace granvof::compare
