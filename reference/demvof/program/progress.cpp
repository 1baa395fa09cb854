#include "reference/demvof/program/progress.hpp"

#include <cmath>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace demvof {

ProgressLine::ProgressLine(bool wanted, std::string name)
    : wanted_(wanted), terminal_(::isatty(STDERR_FILENO) != 0), name_(std::move(name)) {}

void ProgressLine::say(const std::string& what) {
  if (wanted_) fmt::print(stderr, "demvof: {}: {}\n", name_, what);
}

void ProgressLine::update(double now, double start, double end) {
  if (!wanted_) return;
  const auto clock = std::chrono::steady_clock::now();
  if (!begun_) {
    begin_ = last_ = clock;
    begun_ = true;
    return;
  }
  const double interval = terminal_ ? 1.0 : 30.0;
  if (std::chrono::duration<double>(clock - last_).count() < interval) return;
  last_ = clock;
  const double done = (now - start) / (end - start);
  const double spent = std::chrono::duration<double>(clock - begin_).count();
  const double left = done > 0.0 ? spent * (1.0 - done) / done : 0.0;
  fmt::print(stderr, "{}demvof: {}: t = {:.4f} of {:.4f} s, {:.0f} %, about {:.0f} min {:02.0f} s left{}",
             terminal_ ? "\r" : "", name_, now, end, 100.0 * done, std::floor(left / 60.0),
             std::fmod(left, 60.0), terminal_ ? "  " : "\n");
  std::fflush(stderr);
}

void ProgressLine::end() {
  if (wanted_ && terminal_ && begun_) fmt::print(stderr, "\n");
}

}  // namespace demvof
