#include "reference/demvof/program/scratch_folder.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

#include <fcntl.h>
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

}  // namespace

ScratchFolder::ScratchFolder(const fs::path& path) {
  try {
    const fs::path folder = fs::absolute(path);
    make(folder);
    open_ = granvof::Descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (!open_.valid() || ::access(folder.c_str(), W_OK | X_OK) != 0)
      throw granvof::OutputError("use the scratch folder", path, std::strerror(errno));
    name_ = is_plain(folder.string()) ? folder : granvof::path_by_descriptor(open_, folder);
  } catch (const fs::filesystem_error& error) {
    remove_what_is_empty();
    throw granvof::OutputError("make the scratch folder", path, error.code().message());
  } catch (const granvof::OutputError&) {
    remove_what_is_empty();
    throw;
  }
}

ScratchFolder::~ScratchFolder() {
  remove_what_is_empty();
}

void ScratchFolder::make(const fs::path& path) {
  if (fs::exists(path)) return;
  if (path.has_parent_path() && path.parent_path() != path) make(path.parent_path());
  if (fs::create_directory(path)) made_.push_back(path);
}

void ScratchFolder::remove_what_is_empty() {
  std::error_code ignored;
  for (auto folder = made_.rbegin(); folder != made_.rend(); ++folder) fs::remove(*folder, ignored);
}

}  // namespace demvof
