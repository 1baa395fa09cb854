// Opening a file for reading, whatever takes its name meanwhile.
#pragma once

#include <cstdint>
#include <filesystem>

#include "solver/output/atomic_file.hpp"

namespace granvof {

// A regular file and nothing else, of at most `largest` bytes; waits for nobody. Throws OutputError.
Descriptor open_file(const std::filesystem::path& path, std::uintmax_t largest = UINTMAX_MAX);

// A path to what is open, whatever stands under its name by now; `name` where the system has no /proc.
std::filesystem::path path_by_descriptor(const Descriptor& open, const std::filesystem::path& name);

}  // namespace granvof
