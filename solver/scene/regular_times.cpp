#include "solver/scene/regular_times.hpp"

#include <charconv>
#include <cstddef>
#include <string>

#include <fmt/format.h>

namespace granvof {
namespace {

constexpr double roundoff = 1e-9;  // relative: times that differ by less are the same

double as_written(double value) {
  const std::string text = fmt::format("{:.15g}", value);
  double written = value;
  std::from_chars(text.data(), text.data() + text.size(), written);
  return written;
}

}  // namespace

std::vector<double> regular_times(double interval, double end) {
  std::vector<double> times;
  for (std::size_t k = 0; static_cast<double>(k) * interval < end * (1.0 - roundoff); ++k)
    times.push_back(as_written(static_cast<double>(k) * interval));
  times.push_back(end);
  return times;
}

}  // namespace granvof
