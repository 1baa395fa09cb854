#include "reference/demvof/program/scratch_folder.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "solver/output/open_file.hpp"
#include "solver/output/output_error.hpp"

namespace demvof {

namespace {

namespace fs = std::filesystem;

// Letters of a name that every program takes as they stand.
bool is_plain(const std::string& name) {
  return std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("/._-+").find(c) != std::string_view::npos;
  });
}

constexpr std::string_view beginning = "demvof-";  // of the name of a run's own folder
constexpr int most_attempts = 100;                 // to make it

granvof::Descriptor opened(const fs::path& folder) {
  return granvof::Descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
}

bool is_locked_now(const granvof::Descriptor& folder) {
  return ::flock(folder.get(), LOCK_EX | LOCK_NB) == 0;
}

// A file system without locks fails in another way.
bool is_held_by_another(const granvof::Descriptor& folder) {
  return !is_locked_now(folder) && errno == EWOULDBLOCK;
}

bool is_called(const granvof::Descriptor& folder, const fs::path& name) {
  struct stat here {
  }, there{};
  return ::fstat(folder.get(), &here) == 0 && ::lstat(name.c_str(), &there) == 0 &&
         here.st_dev == there.st_dev && here.st_ino == there.st_ino;
}

// What is left of runs that were killed, which nobody holds any more.
void remove_what_dead_ones_left(const fs::path& folder) {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    if (!entry.path().filename().string().starts_with(beginning)) continue;
    const granvof::Descriptor left = opened(entry.path());
    if (left.valid() && is_locked_now(left)) fs::remove_all(entry.path(), ignored);
  }
}

}  // namespace

ScratchFolder::ScratchFolder(const fs::path& path) {
  try {
    const fs::path folder = fs::absolute(path);
    make(folder);
    remove_what_dead_ones_left(folder);
    make_own(folder, path);
    name_ = is_plain(own_.string()) ? own_ : granvof::path_by_descriptor(open_, own_);
  } catch (const fs::filesystem_error& error) {
    remove_what_was_made();
    throw granvof::OutputError("make the scratch folder", path, error.code().message());
  } catch (const granvof::OutputError&) {
    remove_what_was_made();
    throw;
  }
}

ScratchFolder::~ScratchFolder() {
  remove_what_was_made();
}

// Between its making and its lock another start may take it for one that was left, and remove it; an end, the
// folder around it.
void ScratchFolder::make_own(const fs::path& folder, const fs::path& given) {
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    make(folder);
    std::string name = folder / fmt::format("{}XXXXXX", beginning);
    if (::mkdtemp(name.data()) == nullptr) {
      if (errno == ENOENT) continue;
      break;
    }
    own_ = name;
    open_ = opened(own_);
    if (open_.valid() && !is_held_by_another(open_) && is_called(open_, own_)) return;
  }
  throw granvof::OutputError("use the scratch folder", given, std::strerror(errno));
}

void ScratchFolder::make(const fs::path& path) {
  if (fs::exists(path)) return;
  if (path.has_parent_path() && path.parent_path() != path) make(path.parent_path());
  if (fs::create_directory(path)) made_.push_back(path);
}

void ScratchFolder::remove_what_was_made() {
  std::error_code ignored;
  if (!own_.empty()) fs::remove_all(own_, ignored);
  for (auto folder = made_.rbegin(); folder != made_.rend(); ++folder) fs::remove(*folder, ignored);
}

}  // namespace demvof
