// The fuzzer (libFuzzer of clang): GRANVOF_FUZZ names the entry, the arguments are libFuzzer's. ci/fuzz runs
// it.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "compare/tests/fuzz/entries.hpp"

namespace {

const granvof::fuzz::Entry& chosen() {
  static const granvof::fuzz::Entry& entry = []() -> const granvof::fuzz::Entry& {
    const char* name = std::getenv("GRANVOF_FUZZ");
    const auto* found = granvof::fuzz::find_entry(name == nullptr ? "" : name);
    if (found == nullptr) {
      std::fputs("GRANVOF_FUZZ names an entry, one of:\n", stderr);
      for (const auto& each : granvof::fuzz::entries()) std::fprintf(stderr, "%s\n", each.name);
      std::exit(2);
    }
    return *found;
  }();
  return entry;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  chosen().take({reinterpret_cast<const char*>(data), size});
  return 0;
}
