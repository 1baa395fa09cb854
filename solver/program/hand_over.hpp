// `granvof report` and `granvof sweep` hand over to a program of compare: film, plots and a page of a run; a
// case with every combination of values.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace granvof {

// Of the process that this is.
std::filesystem::path own_program();

// compare/SCRIPT beside the program: of the source tree that it was built in, or where it was installed to.
// Throws std::runtime_error that says for which `command`, and where it was looked for.
std::filesystem::path find_script(const std::filesystem::path& program, const std::string& command,
                                  const std::string& script);

// Becomes that program; returns only by throwing std::runtime_error where it cannot be started.
[[noreturn]] void hand_over(const std::string& command, const std::string& script,
                            std::vector<std::string> words);

}  // namespace granvof
