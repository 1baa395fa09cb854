// `granvof report DIR...`: hands over to compare/show, which makes film, plots and a page of a run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace granvof {

// compare/show beside the program: of the source tree that it was built in, or where it was installed to.
// Throws std::runtime_error that says where it was looked for.
std::filesystem::path find_report_maker(const std::filesystem::path& program);

// Becomes that program; returns only by throwing std::runtime_error where it cannot be started.
[[noreturn]] void make_report(const std::vector<std::string>& directories);

}  // namespace granvof
