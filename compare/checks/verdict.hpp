// From a value and its reference to a verdict.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "compare/checks/check.hpp"

namespace granvof::compare {

enum class Verdict {
  agrees,            // within the tolerance
  within_band,       // beyond the tolerance, but inside the reference's own uncertainty
  differs,           // beyond both
  expected_failure,  // differs, as declared, and no further than declared
  reported,          // differs, in a row that is not asserted
  not_run,           // no run, no record, or it did not reach its end
  stale,             // the run or record belongs to another state of its case
  error              // the run, a record or a file it takes is damaged
};

std::string_view name_of(Verdict verdict);

struct Judgement {
  Verdict verdict = Verdict::not_run;
  double deviation = 0.0;  // value - reference
  double distance = 0.0;   // how far the value is beyond the tolerance (0 inside), in the metric's unit
  bool unexpected =
      false;  // turns the exit code: a failure not declared, a declared one that passes or got worse
};

// The tolerance in the metric's unit, >= 0.
double absolute_tolerance(const Tolerance& tolerance, double reference);

// `band` is the half width of the reference's uncertainty, >= 0. Value and reference are finite.
Judgement judge(double value, double reference, double band, const Check& check);

}  // namespace granvof::compare
