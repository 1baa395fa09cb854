#include "compare/input/published.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "solver/output/atomic_file.hpp"
#include "solver/output/output_error.hpp"

namespace granvof::compare {
namespace {

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, '\t');) fields.push_back(field);
  return fields;
}

double number_of(const std::string& text, const std::filesystem::path& file, int line) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
    throw OutputError("read", file, fmt::format("line {}: '{}' is not a finite number", line, text));
  return value;
}

}  // namespace

Curve read_published(const std::filesystem::path& file, std::string_view name) {
  std::istringstream lines(read_file(file));
  Curve curve;
  std::vector<std::string> header;
  std::size_t column = 0;
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.empty() || line.front() == '#') continue;
    const auto fields = fields_of(line);
    if (header.empty()) {
      header = fields;
      const auto found = std::find_if(header.begin(), header.end(), [&](const std::string& field) {
        return field.substr(0, field.find(" [")) == name;
      });
      if (found == header.end())
        throw OutputError("read", file, fmt::format("line {}: no column '{}'", number, name));
      column = static_cast<std::size_t>(found - header.begin());
      continue;
    }
    if (fields.size() != header.size())
      throw OutputError(
          "read", file,
          fmt::format("line {} has {} fields, the header {}", number, fields.size(), header.size()));
    const double x = number_of(fields[0], file, number);
    if (!curve.empty() && x <= curve.time.back())
      throw OutputError("read", file, fmt::format("line {}: the first column does not ascend", number));
    curve.time.push_back(x);
    curve.value.push_back(number_of(fields[column], file, number));
  }
  return curve;
}

}  // namespace granvof::compare
