#include "solver/scene/units.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <utility>

namespace granvof {
namespace {

constexpr std::array<std::pair<std::string_view, Dimension>, 5> symbols{
    {{"kg", {1, 0, 0}}, {"m", {0, 1, 0}}, {"s", {0, 0, 1}}, {"Pa", {1, -1, -2}}, {"J", {1, 2, -2}}}};
constexpr std::array<std::string_view, 5> without_dimension{"", "-", "deg", "degrees", "wall-clock s"};

// Multiplies `to` by one factor such as "m2", to the power `sign`; false where it is none.
bool take_factor(std::string_view factor, int sign, Dimension& to) {
  const std::size_t length = std::min(factor.find_first_of("0123456789"), factor.size());
  const std::string_view name = factor.substr(0, length), digits = factor.substr(length);
  const auto* found = std::ranges::find(symbols, name, [](const auto& symbol) { return symbol.first; });
  if (found == symbols.end()) return false;
  int exponent = 1;
  if (!digits.empty()) {
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
    if (error != std::errc{} || end != digits.data() + digits.size()) return false;
  }
  to.mass += sign * exponent * found->second.mass;
  to.length += sign * exponent * found->second.length;
  to.time += sign * exponent * found->second.time;
  return true;
}

// base^exponent by multiplication alone: exact where base is a power of two.
double power(double base, int exponent) {
  double product = 1.0;
  for (int i = 0; i < std::abs(exponent); ++i) product *= base;
  return exponent < 0 ? 1.0 / product : product;
}

}  // namespace

std::optional<Dimension> dimension_of(std::string_view unit) {
  Dimension dimension;
  if (std::ranges::count(without_dimension, unit) > 0) return dimension;
  int sign = 1;
  while (!unit.empty()) {
    const std::size_t end = std::min(unit.find_first_of(" /"), unit.size());
    if (!take_factor(unit.substr(0, end), sign, dimension)) return std::nullopt;
    if (end == unit.size()) break;
    if (unit[end] == '/') {
      if (sign < 0) return std::nullopt;
      sign = -1;
    }
    unit.remove_prefix(end + 1);
    if (unit.empty()) return std::nullopt;
  }
  return dimension;
}

double UnitFactors::of(const Dimension& dimension) const {
  return power(mass, dimension.mass) * power(length, dimension.length) * power(time, dimension.time);
}

}  // namespace granvof
