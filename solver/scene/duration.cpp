#include "solver/scene/duration.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace granvof {
namespace {

struct Unit {
  std::string_view name;
  double seconds;
};
constexpr std::array units{Unit{"h", 3600.0}, Unit{"min", 60.0}, Unit{"m", 60.0}, Unit{"s", 1.0}};

bool is_letter(char c) {
  return c >= 'a' && c <= 'z';
}

// Of the whole text; 0 where it is none.
double seconds_in(std::string_view text) {
  double sum = 0.0, last_unit = 0.0;
  while (!text.empty()) {
    double value = 0.0;
    const auto parsed =
        std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
    text.remove_prefix(static_cast<std::size_t>(parsed.ptr - text.data()));
    const auto* end_of_name = std::find_if_not(text.begin(), text.end(), is_letter);
    const std::string_view name(text.begin(), static_cast<std::size_t>(end_of_name - text.begin()));
    const auto* unit =
        std::find_if(units.begin(), units.end(), [&](const Unit& u) { return u.name == name; });
    if (parsed.ec != std::errc() || !std::isfinite(value) || value < 0.0 || unit == units.end()) return 0.0;
    if (last_unit > 0.0 && unit->seconds >= last_unit) return 0.0;
    last_unit = unit->seconds;
    sum += value * unit->seconds;
    text.remove_prefix(name.size());
  }
  return sum;
}

}  // namespace

double read_duration(std::string_view text) {
  const double seconds = seconds_in(text);
  if (seconds > 0.0) return seconds;
  throw std::invalid_argument(
      fmt::format("'{}' given; allowed: a time with its unit, as 90s, 10min, 2h or 3h50m", text));
}

std::string duration_text(double seconds) {
  if (seconds < 100.0) return fmt::format("{:.2g} s", seconds);
  return seconds < 6000.0 ? fmt::format("{:.0f} min", seconds / 60.0)
                          : fmt::format("{:.2g} h", seconds / 3600.0);
}

}  // namespace granvof
