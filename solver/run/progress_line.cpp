#include "solver/run/progress_line.hpp"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

namespace granvof {

void ProgressLine::show(const RunProgress& progress, double dt, int newton, int linear) {
  if (!on_) return;
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < std::chrono::milliseconds(500)) return;
  last_ = now;
  const double start = -scene_.times.hold;
  const double share = (progress.simulated_time - start) / (scene_.times.end - start);
  const double wall = std::chrono::duration<double>(now - started_).count();
  const double left = share > 0.0 ? wall / share * (1.0 - share) : 0.0;
  fmt::print(stderr,
             "\r{}: t {:.4f} s  dt {:.2e} s  {:3.0f} %  {:.0f} s left  Newton {} linear {}  volume errors: "
             "solid {:.1e} "
             "liquid {:.1e}\033[K",
             scene_.name, progress.simulated_time, dt, 100.0 * share, left, newton, linear,
             progress.solid_volume_error, progress.liquid_volume_error);
  std::fflush(stderr);
}

void ProgressLine::clear() const {
  if (on_) fmt::print(stderr, "\r\033[K");
}

}  // namespace granvof
