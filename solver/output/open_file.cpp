#include "solver/output/open_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include "solver/output/output_error.hpp"
#include "solver/scene/regular_file.hpp"

namespace granvof {

Descriptor open_file(const std::filesystem::path& path, std::uintmax_t largest) {
  const RegularFile opened = open_regular(path);
  Descriptor file(opened.descriptor);
  if (!opened.fault.empty()) throw OutputError("read", path, opened.fault);
  if (opened.size > largest)
    throw OutputError("read", path, fmt::format("it has {} bytes, more than {}", opened.size, largest));
  return file;
}

std::filesystem::path path_by_descriptor(const Descriptor& open, const std::filesystem::path& name) {
  const std::string path = fmt::format("/proc/self/fd/{}", open.get());
  return ::access(path.c_str(), F_OK) == 0 ? std::filesystem::path(path) : name;
}

}  // namespace granvof
