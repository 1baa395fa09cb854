// Which fault of ci/mutants is in force, in a tree that holds all of them (ci/mutation/cpp.py). Set from
// outside:
//   GRANVOF_MUTANT=1a2b3c4d       the one fault that is in force; none without it
//   GRANVOF_MUTANTS_REACHED=FILE  adds a line to FILE for each place that is reached
#pragma once

// Faults make odd code. Where warnings are errors, those behind this line stay warnings.
#pragma GCC diagnostic warning "-Wall"
#pragma GCC diagnostic warning "-Wextra"
#pragma GCC diagnostic warning "-Wpedantic"
#pragma GCC diagnostic warning "-Wshadow"
#pragma GCC diagnostic warning "-Wconversion"

// Headers have their faults where this is defined (ci/mutation/tree.py).
#define GRANVOF_MUTATION_SWITCH

#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <type_traits>

namespace granvof::mutation {

struct FromEnvironment {
  std::uint32_t active = 0;
  const char* reached = nullptr;
  FromEnvironment() : reached(std::getenv("GRANVOF_MUTANTS_REACHED")) {
    if (const char* name = std::getenv("GRANVOF_MUTANT"))
      active = static_cast<std::uint32_t>(std::strtoul(name, nullptr, 16));
  }
};

// Before every other object of static storage, some of which are computed by code with faults in it.
[[gnu::init_priority(101)]] inline const FromEnvironment environment;

template <std::uint32_t Id>
[[gnu::noinline, gnu::cold]] void note() {
  static std::atomic_flag noted;
  if (noted.test_and_set()) return;
  if (std::FILE* file = std::fopen(environment.reached, "a")) {
    std::fprintf(file, "%08x\n", Id);
    std::fclose(file);
  }
}

// Of what is set when the program starts: no compiler works it out before.
template <std::uint32_t Id>
bool on_at_start() {
  if (environment.reached) [[unlikely]]
    note<Id>();
  return environment.active == Id;
}

// What the compiler works out is without any fault.
template <std::uint32_t Id>
constexpr bool on() {
  if (std::is_constant_evaluated()) return false;
  return on_at_start<Id>();
}

}  // namespace granvof::mutation
