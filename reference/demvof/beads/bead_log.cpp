#include "reference/demvof/beads/bead_log.hpp"

#include <system_error>

#include <fmt/format.h>

#include "solver/output/atomic_file.hpp"
#include "solver/output/output_error.hpp"

namespace demvof {

std::filesystem::path bead_log(const std::filesystem::path& scratch, pid_t process) {
  return scratch / fmt::format("liggghts-{}.log", process);
}

std::string last_bead_error(const std::filesystem::path& scratch, pid_t process) {
  const auto log = bead_log(scratch, process);
  std::string text;
  try {
    text = granvof::read_file(log);
  } catch (const granvof::OutputError&) {
    return "";
  }
  std::error_code ignored;
  std::filesystem::remove(log, ignored);
  const auto begin = text.rfind("ERROR");
  return begin == std::string::npos ? "" : text.substr(begin, text.find('\n', begin) - begin);
}

}  // namespace demvof
