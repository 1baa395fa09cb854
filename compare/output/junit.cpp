#include <fmt/format.h>

#include "compare/output/write.hpp"

namespace granvof::compare {
namespace {

// XML knows no other control characters, not even escaped.
bool is_no_xml(char c) {
  return static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n' && c != '\r';
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (is_no_xml(c)) {
      out += fmt::format("\\x{:02x}", c);
      continue;
    }
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string message_of(const Result& result) {
  const auto shown = [](const std::optional<double>& v) {
    return v ? fmt::format("{:.6g}", *v) : std::string("none");
  };
  std::string message =
      fmt::format("{}: value {} {}, reference {} ({}), tolerance {}", name_of(result.judgement.verdict),
                  shown(result.value), result.unit, shown(result.reference), result.check.reference.source,
                  tolerance_text(result.check));
  if (!result.note.empty()) message += "; " + result.note;
  if (result.check.expected_failure)
    message += "; expected failure: " + result.check.expected_failure->reason;
  return escaped(message);
}

}  // namespace

std::string junit_xml(const Evaluation& evaluation) {
  std::string cases;
  int skipped = 0;
  for (const Result& result : evaluation.results) {
    const Verdict verdict = result.judgement.verdict;
    const std::string message = message_of(result);
    const bool skip =
        !result.judgement.unexpected && (verdict == Verdict::not_run || verdict == Verdict::stale);
    skipped += skip ? 1 : 0;
    cases += fmt::format(R"(    <testcase classname="{}" name="{}">)", escaped(result.check.run),
                         escaped(result.check.id));
    if (result.judgement.unexpected)
      cases += fmt::format(R"(<failure message="{}"/>)", message);
    else if (skip)
      cases += fmt::format(R"(<skipped message="{}"/>)", message);
    else
      cases += fmt::format("<system-out>{}</system-out>", message);
    cases += "</testcase>\n";
  }
  return fmt::format(R"(<?xml version="1.0" encoding="UTF-8"?>
<testsuites>
  <testsuite name="granvof-compare" tests="{}" failures="{}" skipped="{}">
{}  </testsuite>
</testsuites>
)",
                     evaluation.results.size(), evaluation.unexpected(), skipped, cases);
}

}  // namespace granvof::compare
