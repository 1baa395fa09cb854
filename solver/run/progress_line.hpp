// The line that tells a person how far a run is. Quiet unless it was switched on (stderr is a terminal).
#pragma once

#include <chrono>

#include "solver/output/run_record.hpp"
#include "solver/scene/scene.hpp"

namespace granvof {

class ProgressLine {
 public:
  ProgressLine(bool on, const Scene& scene) : on_(on), scene_(scene) {}
  // At most twice a second.
  void show(const RunProgress& progress, double dt, int newton, int linear);
  void clear() const;

 private:
  bool on_;
  const Scene& scene_;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now(), last_{};
};

}  // namespace granvof
