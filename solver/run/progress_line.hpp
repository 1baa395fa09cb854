// The line that tells a person how far a run is, with a plot of its front. Quiet unless it was switched on
// (stderr is a terminal).
#pragma once

#include <chrono>
#include <span>
#include <string>
#include <vector>

#include "solver/output/extract.hpp"
#include "solver/output/run_record.hpp"
#include "solver/scene/scene.hpp"

namespace granvof {

// The way of the front [m] from the first row to the last in bars of a character, and where it is; empty
// before there are two rows.
std::string front_plot(std::span<const double> fronts);
// The parts side by side, as many as fit into a terminal of that width; the first always, those that are
// empty not at all. A line that wraps could not be overwritten.
std::string side_by_side(std::span<const std::string> parts, int columns);

class ProgressLine {
 public:
  ProgressLine(bool on, const Scene& scene) : on_(on), scene_(scene) {}
  // A row of series.csv has been written; what of it is plotted is empty where there are no grains.
  void add(const Scalars& row);
  // At most twice a second.
  void show(const RunProgress& progress, double dt, int newton, int linear);
  void clear() const;

 private:
  bool on_;
  const Scene& scene_;
  std::vector<double> fronts_;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now(), last_{};
};

}  // namespace granvof
