#include "solver/program/hand_over.hpp"

#include <cerrno>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

namespace granvof {

namespace fs = std::filesystem;

fs::path own_program() {
  return fs::read_symlink("/proc/self/exe");
}

fs::path find_script(const fs::path& program, const std::string& command, const std::string& script) {
  const fs::path directory = program.parent_path();
  const fs::path installed = directory.parent_path() / "share/granvof/compare" / script;
  if (fs::exists(installed)) return installed;
  // BUILD/solver/granvof, with BUILD anywhere in the tree.
  for (fs::path above = directory; above != above.parent_path(); above = above.parent_path())
    if (const fs::path in_tree = above / "compare" / script; fs::exists(in_tree)) return in_tree;
  throw std::runtime_error(
      fmt::format("{}: compare/{}, which makes it, is neither {} nor in a directory above {}; `make "
                  "install` installs it",
                  command, script, installed.string(), directory.string()));
}

void hand_over(const std::string& command, const std::string& script, std::vector<std::string> words) {
  const fs::path file = find_script(own_program(), command, script);
  words.insert(words.begin(), file.string());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  ::execv(file.c_str(), arguments.data());
  throw std::runtime_error(fmt::format("{}: {} cannot be started: {}", command, file.string(),
                                       std::generic_category().message(errno)));
}

}  // namespace granvof
