// Where anything may come in: each reader takes any bytes at all, and either takes them or refuses them as
// its header says. The fuzzer makes the bytes (fuzz_inputs.cpp); what it found worth keeping is a test
// (test_corpus.cpp).
#pragma once

#include <span>
#include <string_view>

namespace granvof::fuzz {

struct Entry {
  const char* name;
  // Returns where the reader did as it promises; throws what it should not have thrown, or Broken.
  void (*take)(std::string_view bytes);
};

std::span<const Entry> entries();

// nullptr where there is none of that name.
const Entry* find_entry(std::string_view name);

}  // namespace granvof::fuzz
