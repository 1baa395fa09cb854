#include "compare/checks/verdict.hpp"

#include <algorithm>
#include <cmath>

namespace granvof::compare {
namespace {

// How far `deviation` lies on the wrong side of the reference, before any tolerance.
double excess_of(double deviation, Relation relation) {
  switch (relation) {
    case Relation::equal:
      return std::abs(deviation);
    case Relation::at_most:
      return std::max(deviation, 0.0);
    case Relation::at_least:
      return std::max(-deviation, 0.0);
  }
  return std::abs(deviation);
}

}  // namespace

std::string_view name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::agrees:
      return "agrees";
    case Verdict::within_band:
      return "within band";
    case Verdict::differs:
      return "differs";
    case Verdict::expected_failure:
      return "expected failure";
    case Verdict::reported:
      return "reported only";
    case Verdict::not_run:
      return "not run";
    case Verdict::stale:
      return "stale";
    case Verdict::error:
      return "error";
  }
  return "differs";
}

double absolute_tolerance(const Tolerance& tolerance, double reference) {
  return tolerance.relative ? tolerance.value * std::abs(reference) : tolerance.value;
}

Judgement judge(double value, double reference, double band, const Check& check) {
  Judgement judgement;
  judgement.deviation = value - reference;
  const double excess = excess_of(judgement.deviation, check.relation);
  const double tolerance = absolute_tolerance(check.tolerance, reference);
  judgement.distance = std::max(excess - tolerance, 0.0);
  if (judgement.distance == 0.0)
    judgement.verdict = Verdict::agrees;
  else if (excess <= band)
    judgement.verdict = Verdict::within_band;
  else
    judgement.verdict = Verdict::differs;

  if (check.expected_failure && judgement.verdict == Verdict::differs &&
      judgement.distance <= check.expected_failure->distance) {
    judgement.verdict = Verdict::expected_failure;
  } else {
    // A declared failure that passes is as unexpected as an undeclared failure.
    judgement.unexpected = check.expected_failure.has_value() || judgement.verdict == Verdict::differs;
  }
  judgement.unexpected = judgement.unexpected && check.asserted;
  if (!check.asserted && judgement.verdict == Verdict::differs) judgement.verdict = Verdict::reported;
  return judgement;
}

}  // namespace granvof::compare
