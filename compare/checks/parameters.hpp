// Parameters of a metric: the one table of what there are.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "compare/input/toml_entry.hpp"
#include "compare/metrics/curve.hpp"

namespace granvof::compare {

struct Parameters {
  std::optional<Window> window;          // of time [s], or of T where the metric says so
  std::optional<double> at;              // an instant, t [s] or T
  std::optional<double> quiet;           // magnitude below which a signal counts as none
  std::optional<double> level;           // of f_s
  std::optional<std::string> published;  // file in cases/published, and
  std::optional<std::string> column;     // the column of it that the metric is compared with
  std::optional<std::string> against;    // id of a second run
  std::optional<std::string> term;       // of the energy, see compare/input/shared_ledger.hpp
  std::optional<std::string> scheme;     // numerical term of the ledger, docs/theory/energy.md
};

// Which of them a metric needs; what is not needed is not allowed. `published` goes with `column`.
struct Needs {
  bool window = false;
  bool at = false;
  bool quiet = false;
  bool level = false;
  bool published = false;
  bool against = false;
  bool term = false;
  bool scheme = false;
};

struct ParameterEntry {
  std::string_view key;  // in the table of checks
  bool Needs::*needed;
  bool (*is_given)(const Parameters&);
  void (*read)(const TomlEntry&, Parameters&);
  std::string (*in_label)(const Parameters&);  // what it adds to a metric's name; nothing: it adds nothing
};
std::span<const ParameterEntry> parameters();

// Whether all that is needed is given.
bool is_complete(const Needs& needs, const Parameters& given);

// "run_out@10", "series_difference-s1-plain": what tells rows of a metric apart by its parameters.
std::string labelled(std::string_view metric, const Parameters& given);

}  // namespace granvof::compare
