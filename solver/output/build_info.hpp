// What was built, with what; filled in by the build.
#pragma once

#include <string>
#include <string_view>

namespace granvof {

struct BuildInfo {
  std::string_view version;     // of the project, such as "0.1.0"
  std::string_view git_commit;  // output of git describe, empty when built outside a repository
  std::string_view compiler;    // name and version
  std::string_view flags;       // compiler flags, the build type's included
  std::string_view build_type;
};

const BuildInfo& build_info();
// What a program says of itself, as "granvof 0.1.0 (commit)".
std::string version_text(std::string_view program);

}  // namespace granvof
