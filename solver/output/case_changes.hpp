// What differs between two resolved cases, key by key.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace granvof {

struct CaseChange {
  std::string key;  // "numerics.cfl"
  std::string was;  // as in the resolved case; empty where it had no such key
  std::string is;
};

// In the order of the new case; keys that only the old one has come last.
std::vector<CaseChange> case_changes(std::string_view before, std::string_view now);

// Whether a run may be taken up again with another value of that key: its end, its output (what of it is due
// later), and what the program does not read. Anything else would make it two runs in one.
bool may_change_on_resume(std::string_view key);

// "numerics.cfl was 0.4, is 0.2"
std::string change_text(const CaseChange& change);

}  // namespace granvof
