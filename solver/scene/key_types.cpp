#include "solver/scene/key_types.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace granvof::case_file {

std::string Bounds::text() const {
  if (std::isinf(lower) && std::isinf(upper)) return "";
  if (std::isinf(upper)) return fmt::format(" {} {}", lower_open ? ">" : ">=", lower);
  if (std::isinf(lower)) return fmt::format(" {} {}", upper_open ? "<" : "<=", upper);
  return fmt::format(" in {}{}, {}{}", lower_open ? '(' : '[', lower, upper, upper_open ? ')' : ']');
}

double as_number(const Value& value) {
  if (const auto* i = std::get_if<std::int64_t>(&value)) return static_cast<double>(*i);
  if (const auto* x = std::get_if<double>(&value)) return *x;
  return std::numeric_limits<double>::quiet_NaN();
}

bool beyond_doubles(const Value& value) {
  const auto beyond = [](double x) { return std::isfinite(x) && !of_a_size(x); };
  const auto* list = std::get_if<std::vector<double>>(&value);
  return list ? std::any_of(list->begin(), list->end(), beyond) : beyond(as_number(value));
}

bool read_value(double& to, const Value& from, const Bounds& bounds) {
  to = as_number(from);
  return bounds.holds(to);
}

bool read_value(int& to, const Value& from, const Bounds& bounds) {
  const double x = as_number(from);  // 2.0 is the integer 2
  if (x != std::round(x) || std::fabs(x) > std::numeric_limits<int>::max()) return false;
  to = static_cast<int>(x);
  return bounds.holds(to);
}

bool read_value(bool& to, const Value& from, const Bounds&) {
  const auto* b = std::get_if<bool>(&from);
  if (b) to = *b;
  return b != nullptr;
}

bool read_value(std::string& to, const Value& from, const Bounds&) {
  const auto* s = std::get_if<std::string>(&from);
  if (s) to = *s;
  return s && !s->empty();
}

bool read_value(std::vector<double>& to, const Value& from, const Bounds& bounds) {
  const auto* list = std::get_if<std::vector<double>>(&from);
  if (list) to = *list;
  return list && std::all_of(list->begin(), list->end(), [&](double x) { return bounds.holds(x); });
}

bool read_value(std::vector<int>& to, const Value& from, const Bounds& bounds) {
  const auto* list = std::get_if<std::vector<double>>(&from);
  if (!list) return false;
  to.clear();
  for (const double x : *list) {
    if (!bounds.holds(x) || x != std::round(x) || std::abs(x) > std::numeric_limits<int>::max()) return false;
    to.push_back(static_cast<int>(x));
  }
  return true;
}

std::string allowed_text(const std::string& type, const Bounds& bounds, const std::string& unit) {
  const std::string unit_text = unit.empty() || unit == "-" ? "" : " [" + unit + "]";
  if (type == "true or false") return type;
  if (type == "text") return "text in quotes, not empty";
  if (type.starts_with("list")) {
    return "a " + type + (bounds.text().empty() ? "" : ", each" + bounds.text()) + unit_text;
  }
  return (type == "integer" ? "an " : "a ") + type + bounds.text() + unit_text;
}

}  // namespace granvof::case_file
