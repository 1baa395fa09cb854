#include "compare/checks/whole_curve.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "compare/input/uncertainty.hpp"
#include "compare/metrics/run_out.hpp"

namespace granvof::compare {

CurveApart apart_from_record(const Check& check, const MetricEntry& metric, const Run& run,
                             const std::vector<LoadedRun>& variants, const Bands& bands) {
  CurveApart apart;
  apart.band = check.reference.band;
  if (variants.empty()) apart.note = fmt::format("no record of '{}'", *check.reference.record);
  const Window window = *check.parameters.window;
  std::vector<Curve> curves;
  for (const LoadedRun& variant : variants) {
    if (!variant.run) {
      apart.note = variant.reason;
      apart.without = variant.state == RunState::stale ? Verdict::stale : Verdict::error;
      return apart;
    }
    curves.push_back(metric.curve(*variant.run));
    if (const Curve inside = clip(curves.back(), window); inside.size() < 2) {
      apart.note = fmt::format("{}: no {} in the window", variant.run->directory.string(), metric.name);
      return apart;
    }
    apart.band = std::max(apart.band, record_uncertainty(check.metric, *variant.run, bands).value_or(0.0));
  }
  if (curves.empty()) return apart;
  for (std::size_t i = 0; i < curves.size(); ++i)
    for (std::size_t j = i + 1; j < curves.size(); ++j)
      apart.band = std::max(apart.band, 0.5 * rms_distance(curves[i], curves[j], window).value_or(0.0));
  apart.usable = true;
  apart.distance.value = rms_distance(metric.curve(run), mean_curve(curves), window);
  if (!apart.distance.value) apart.distance.note = "undefined: the two curves do not cover the window";
  return apart;
}

}  // namespace granvof::compare
