// A program that stands in for granvof.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace granvof::compare::test {

// At `path`: says its version, and for a run does `body`, a shell script; $out is the run directory, and each
// run adds a line with its arguments to the file `calls` beside it.
inline void write_stand_in(const std::filesystem::path& path, const std::string& body,
                           const std::string& version = "granvof 1.0 (abc)") {
  std::ofstream(path) << "#!/bin/sh\nif [ \"$1\" = --version ]; then echo '" << version << "'; exit; fi\n"
                      << "echo \"$@\" >> " << (path.parent_path() / "calls").string()
                      << "\nwhile [ $# -gt 0 ]; do [ \"$1\" = --out ] && out=$2; shift; done\n"
                      << body << "\n";
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
}

// The lines of `calls`.
inline std::vector<std::string> calls_beside(const std::filesystem::path& path) {
  std::ifstream in(path.parent_path() / "calls");
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

}  // namespace granvof::compare::test
