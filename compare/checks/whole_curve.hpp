// A curve judged as a whole: how far it is from that of a record, over a window.
#pragma once

#include <string>
#include <vector>

#include "compare/checks/check.hpp"
#include "compare/checks/registry.hpp"
#include "compare/checks/verdict.hpp"
#include "compare/input/bands.hpp"
#include "compare/input/records.hpp"

namespace granvof::compare {

struct CurveApart {
  Measured distance;  // root-mean-square, in the unit of the metric
  double band = 0.0;  // half the largest distance between two variants, and what `bands` say of the quantity
  bool usable = false;                 // the record is there, and all its variants are
  Verdict without = Verdict::not_run;  // the verdict where it is not
  std::string note;
};

// Between metric.curve of `run` and the mean of the record's variants, over the window of the check.
CurveApart apart_from_record(const Check& check, const MetricEntry& metric, const Run& run,
                             const std::vector<LoadedRun>& variants, const Bands& bands);

}  // namespace granvof::compare
