// What is wrong with a case: collected, so that one error names it all.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "solver/scene/case_text.hpp"
#include "solver/scene/draft.hpp"

namespace granvof::case_file {

struct Fault {
  std::string key;  // or a table
  Place place;
  std::string message;  // without the place: "solid.friction: got -0.4, allowed: a number >= 0"
};

class Faults {
 public:
  void add(Fault fault) { list_.push_back(std::move(fault)); }
  // Whether a key is at fault, or its table, or a key of that table.
  bool touch(std::string_view key) const;
  // Throws CaseError if there are any: one line each, in the order of the text, the first few of many.
  void throw_if_any() const;

 private:
  std::vector<Fault> list_;
};

// The fault of a key whose value does not hold: its place, its value, its default or "nothing", and what is
// allowed.
Fault fault_of(const CaseText& text, const Draft& draft, const std::string& name, const std::string& allowed);

}  // namespace granvof::case_file
