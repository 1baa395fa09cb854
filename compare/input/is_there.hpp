// Whether something has a name, be it a link that leads nowhere.
#pragma once

#include <filesystem>

namespace granvof::compare {

// For files that may be left out: what is there is read, or refused with the reason; std::filesystem::exists
// would take a link to nothing for nothing. Throws std::filesystem::filesystem_error where the folder cannot
// be looked into.
inline bool is_there(const std::filesystem::path& path) {
  return std::filesystem::exists(std::filesystem::symlink_status(path));
}

}  // namespace granvof::compare
