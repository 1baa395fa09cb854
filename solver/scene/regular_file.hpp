// How a file is opened that others have made.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace granvof {

// What a name was opened as.
struct RegularFile {
  int descriptor = -1;      // to be closed by the caller; -1 where there is a fault
  std::uintmax_t size = 0;  // [bytes]
  std::string fault;        // why it is no file that can be read; empty where it is one
};

// Opens a regular file for reading and nothing else, and waits for nobody: what a name stands for is asked of
// what was opened, since it may be another's a moment after a question by name.
RegularFile open_regular(const std::filesystem::path& path);

}  // namespace granvof
