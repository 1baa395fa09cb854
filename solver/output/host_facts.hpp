// The machine a program runs on.
#pragma once

#include <cstdint>
#include <string>

namespace granvof {

struct HostFacts {
  std::string cpu_model;          // empty where the system does not tell
  int cores = 0;                  // that this process may use
  std::int64_t memory_bytes = 0;  // of the machine
  std::string operating_system;   // name and release of the kernel
};

HostFacts host_facts();

}  // namespace granvof
