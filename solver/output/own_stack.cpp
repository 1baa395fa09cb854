#include "solver/output/own_stack.hpp"

#include <cstdio>

#include <sys/resource.h>
#include <unistd.h>

namespace granvof {

bool has_stack(const char* program) {
  rlimit given{};
  if (::getrlimit(RLIMIT_STACK, &given) != 0 || given.rlim_cur >= least_stack) return true;
  constexpr std::size_t kilobyte = 1024;
  // By the system's own call: the formatting that is used elsewhere takes more of what there is little of.
  ::dprintf(STDERR_FILENO, "%s: a stack of %zu kB (ulimit -s), needed: %zu\n", program,
            static_cast<std::size_t>(given.rlim_cur) / kilobyte, least_stack / kilobyte);
  return false;
}

}  // namespace granvof
