// What LIGGGHTS writes of itself: one file for each process that uses it.
#pragma once

#include <filesystem>
#include <string>

#include <sys/types.h>

namespace demvof {

std::filesystem::path bead_log(const std::filesystem::path& scratch, pid_t process);

// The last error in the log of a process, which is removed; empty where there is no log or no error in it.
std::string last_bead_error(const std::filesystem::path& scratch, pid_t process);

}  // namespace demvof
