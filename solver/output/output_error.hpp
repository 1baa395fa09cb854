// The one exception of the output library: which file, and why it could not be written or read.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace granvof {

class OutputError : public std::runtime_error {
 public:
  // `action` is "write", "read", "replace", ...; what() reads "cannot <action> <path>: <cause>".
  OutputError(const std::string& action, const std::filesystem::path& file, const std::string& why)
      : std::runtime_error("cannot " + action + " " + file.string() + ": " + why),
        action_(action),
        path_(file),
        cause_(why) {}

  const std::string& action() const { return action_; }
  const std::filesystem::path& path() const { return path_; }
  const std::string& cause() const { return cause_; }

 private:
  std::string action_;
  std::filesystem::path path_;
  std::string cause_;
};

}  // namespace granvof
