// A case on its way from draft to scene: what the parts of complete() share.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "solver/scene/draft.hpp"
#include "solver/scene/faults.hpp"

namespace granvof::case_file {

inline constexpr double roundoff = 1e-9;  // relative: lengths that differ by less are the same

// Ends a rule, see Completion::rule.
struct Refusal {
  Fault fault;
};

class Completion {
 public:
  Completion(Draft& draft, const CaseText& read, Faults& faults)
      : d(draft), text(read), s(draft.scene), faults_(faults) {}

  // Applies a rule that reads these keys (a table stands for all of its own), unless one of them is at fault
  // already: what it would say is then not known. Its refusal is added to the faults and ends it.
  template <class Apply>
  void rule(std::initializer_list<std::string_view> reads, Apply&& apply) {
    for (const std::string_view key : reads) {
      if (faults_.touch(key)) return;
    }
    try {
      apply();
    } catch (const Refusal& refusal) {
      faults_.add(refusal.fault);
    }
  }

  bool has(const std::string& table) const { return d.tables.contains(table); }
  bool given(const std::string& key) const { return text.entries.contains(key); }
  bool flat() const { return s.dimensions == 2; }
  // Of the text that gives a key: later layers replace earlier ones; -1 where none does.
  int layer_of(const std::string& key) const;

  [[noreturn]] void refuse(const std::string& key, const std::string& allowed) const;
  void only_in_3d(const std::string& key) const;
  void needs(const std::string& table, const std::string& other) const;
  void components(const std::string& key, const std::vector<double>& list) const;
  // Whether lower..upper reaches beyond the tank, rounding apart.
  bool outside(double lower, double upper, int axis) const {
    return lower < -roundoff * s.tank[axis] || upper > s.tank[axis] * (1.0 + roundoff);
  }

  Draft& d;
  const CaseText& text;
  Scene& s;

 private:
  Faults& faults_;
};

// The parts, in this order: each may use what those before it have set.
void complete_walls(Completion& c);
void complete_bed(Completion& c);
void complete_gate(Completion& c);
void complete_obstacles(Completion& c);
void complete_times(Completion& c);
void complete_reference(Completion& c);

}  // namespace granvof::case_file
