#include "solver/program/report.hpp"

#include <cerrno>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

namespace granvof {

namespace fs = std::filesystem;

fs::path find_report_maker(const fs::path& program) {
  const fs::path directory = program.parent_path();
  const fs::path installed = directory.parent_path() / "share/granvof/compare/show";
  if (fs::exists(installed)) return installed;
  // BUILD/solver/granvof, with BUILD anywhere in the tree.
  for (fs::path above = directory; above != above.parent_path(); above = above.parent_path())
    if (const fs::path in_tree = above / "compare/show"; fs::exists(in_tree)) return in_tree;
  throw std::runtime_error(
      fmt::format("report: compare/show, which makes it, is neither {} nor in a directory above {}; `make "
                  "install` installs it",
                  installed.string(), directory.string()));
}

void make_report(const std::vector<std::string>& directories) {
  const fs::path show = find_report_maker(fs::read_symlink("/proc/self/exe"));
  std::vector<std::string> words{show.string()};
  words.insert(words.end(), directories.begin(), directories.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  ::execv(show.c_str(), arguments.data());
  throw std::runtime_error(
      fmt::format("report: {} cannot be started: {}", show.string(), std::generic_category().message(errno)));
}

}  // namespace granvof
