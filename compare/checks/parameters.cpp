#include "compare/checks/parameters.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "compare/input/shared_ledger.hpp"

namespace granvof::compare {
namespace {

// `at` may be a list, of which each row has one: the reader of rows takes it.
void read_with_the_rows(const TomlEntry&, Parameters&) {}

std::string of_instant(const Parameters& p) {
  return p.at ? fmt::format("@{:g}", *p.at) : "";
}
std::string of_text(const std::optional<std::string>& text) {
  return text ? "-" + *text : "";
}

void read_term(const TomlEntry& entry, Parameters& p) {
  p.term = entry.text("term");
  const auto there = shared_terms();
  if (std::ranges::find(there, *p.term) == there.end())
    entry.fail("term", fmt::format("'{}' given; allowed: {}", *p.term, fmt::join(there, ", ")));
}

constexpr std::array table{
    ParameterEntry{"window", &Needs::window, [](const Parameters& p) { return p.window.has_value(); },
                   [](const TomlEntry& e, Parameters& p) { p.window = e.window("window"); }, nullptr},
    ParameterEntry{"at", &Needs::at, [](const Parameters& p) { return p.at.has_value(); }, read_with_the_rows,
                   of_instant},
    ParameterEntry{"quiet", &Needs::quiet, [](const Parameters& p) { return p.quiet.has_value(); },
                   [](const TomlEntry& e, Parameters& p) { p.quiet = e.non_negative("quiet"); }, nullptr},
    ParameterEntry{"level", &Needs::level, [](const Parameters& p) { return p.level.has_value(); },
                   [](const TomlEntry& e, Parameters& p) { p.level = e.number("level"); }, nullptr},
    ParameterEntry{"against", &Needs::against, [](const Parameters& p) { return p.against.has_value(); },
                   [](const TomlEntry& e, Parameters& p) { p.against = e.text("against"); },
                   [](const Parameters& p) { return of_text(p.against); }},
    ParameterEntry{"published", &Needs::published,
                   [](const Parameters& p) { return p.published.has_value(); },
                   [](const TomlEntry& e, Parameters& p) { p.published = e.text("published"); }, nullptr},
    ParameterEntry{"column", &Needs::published, [](const Parameters& p) { return p.column.has_value(); },
                   [](const TomlEntry& e, Parameters& p) { p.column = e.text("column"); },
                   [](const Parameters& p) { return of_text(p.column); }},
    ParameterEntry{"term", &Needs::term, [](const Parameters& p) { return p.term.has_value(); }, read_term,
                   [](const Parameters& p) { return of_text(p.term); }},
    ParameterEntry{"scheme", &Needs::scheme, [](const Parameters& p) { return p.scheme.has_value(); },
                   [](const TomlEntry& e, Parameters& p) { p.scheme = e.text("scheme"); },
                   [](const Parameters& p) { return of_text(p.scheme); }},
};

}  // namespace

std::span<const ParameterEntry> parameters() {
  return table;
}

bool is_complete(const Needs& needs, const Parameters& given) {
  return std::all_of(table.begin(), table.end(), [&](const ParameterEntry& parameter) {
    return !(needs.*parameter.needed) || parameter.is_given(given);
  });
}

std::string labelled(std::string_view metric, const Parameters& given) {
  std::string label(metric);
  for (const ParameterEntry& parameter : table)
    if (parameter.in_label) label += parameter.in_label(given);
  return label;
}

}  // namespace granvof::compare
