#include "compare/input/evidence.hpp"

#include <cmath>
#include <set>

#include <fmt/format.h>

#include "compare/input/is_there.hpp"
#include "solver/output/digest.hpp"
#include "solver/output/extract.hpp"
#include "solver/output/fields_file.hpp"
#include "solver/output/output_error.hpp"

namespace granvof::compare {
namespace {

namespace fs = std::filesystem;

constexpr double rounding = 1e-6;  // of the length of a run: records keep nine digits

// "" for a column that is not ours alone to define: programs add monitors of their own.
std::string_view unit_of(std::string_view name) {
  if (name == "time") return "s";
  for (const ScalarEntry& entry : scalar_table())
    if (entry.name == name) return entry.unit;
  return "";
}

void require_columns(const Series& series, const fs::path& file, const StatedSeries& stated) {
  if (series.columns.empty() || series.columns.front().name != "time")
    throw OutputError("use", file, "its first column is not 'time [s]'");
  std::set<std::string> names;
  for (std::size_t c = 0; c < series.columns.size(); ++c) {
    const Column& column = series.columns[c];
    if (!names.insert(column.name).second)
      throw OutputError("use", file, fmt::format("the column '{}' is given twice", column.name));
    const auto unit = unit_of(column.name);
    if (!unit.empty() && column.unit != unit)
      throw OutputError(
          "use", file,
          fmt::format("the column '{}' is in '{}', expected '{}'", column.name, column.unit, unit));
    if (c < stated.columns.size() && column_header(column) != stated.columns[c])
      throw OutputError("use", file,
                        fmt::format("column {} is '{}', written was '{}'", c + 1, column_header(column),
                                    stated.columns[c]));
  }
  if (series.columns.size() != stated.columns.size())
    throw OutputError(
        "use", file,
        fmt::format("it has {} columns, written were {}", series.columns.size(), stated.columns.size()));
}

std::vector<double> times_of(const Series& series, const fs::path& file) {
  std::vector<double> times;
  for (const auto& row : series.rows) {
    if (!row.front()) throw OutputError("use", file, fmt::format("row {} has no time", times.size() + 1));
    if (!times.empty() && *row.front() <= times.back())
      throw OutputError("use", file,
                        fmt::format("time does not ascend from row {} to row {}: {} s, {} s", times.size(),
                                    times.size() + 1, times.back(), *row.front()));
    times.push_back(*row.front());
  }
  return times;
}

}  // namespace

double interval_of(const Series& series, const Asked& asked) {
  if (asked.interval > 0.0 || series.rows.size() < 2) return asked.interval;
  return (*series.rows.back().front() - *series.rows.front().front()) /
         static_cast<double>(series.rows.size() - 1);
}

void require_series(const Series& series, const fs::path& file, const StatedSeries& stated,
                    const Asked& asked) {
  require_columns(series, file, stated);
  const auto times = times_of(series, file);
  if (static_cast<std::int64_t>(times.size()) != stated.rows)
    throw OutputError("use", file,
                      fmt::format("it has {} whole rows, written were {}", times.size(), stated.rows));
  if (asked.rows > 0 && stated.rows != asked.rows)
    throw OutputError("use", file, fmt::format("it has {} rows, asked for were {}", stated.rows, asked.rows));
  if (times.size() < 2) throw OutputError("use", file, fmt::format("it has {} rows", times.size()));
  const double slack = rounding * asked.end;
  if (!stated.end || std::abs(times.back() - *stated.end) > slack)
    throw OutputError(
        "use", file,
        fmt::format("it ends at {} s, written was up to {} s", times.back(), stated.end.value_or(0.0)));
  const double interval = interval_of(series, asked);
  if (times.front() < -slack || times.front() > 0.5 * interval)
    throw OutputError("use", file, fmt::format("it begins at {} s", times.front()));
  for (std::size_t i = 1; i < times.size(); ++i)
    if (times[i] - times[i - 1] > widest_gap * interval)
      throw OutputError(
          "use", file,
          fmt::format("there is nothing between {} s and {} s, asked for was a row every {:.6g} s",
                      times[i - 1], times[i], interval));
  if (times.back() < asked.end - interval - slack)
    throw OutputError("use", file,
                      fmt::format("it ends at {} s, the case at {:.9g} s", times.back(), asked.end));
}

void require_digest(const fs::path& file, const std::string& stated) {
  if (digest_of_file(file) != stated)
    throw OutputError("use", file, "it is not the file that was written (its SHA-256 is another)");
}

void require_fields(const fs::path& directory, const std::optional<StatedFields>& stated, double end) {
  const auto file = directory / "fields.h5";
  if (!stated) {
    if (is_there(file)) throw OutputError("use", file, "nothing is said of it");
    return;
  }
  if (stated->sha256) require_digest(file, *stated->sha256);
  const auto times = read_field_times(file);
  if (static_cast<std::int64_t>(times.size()) != stated->instants)
    throw OutputError("use", file,
                      fmt::format("it has {} instants, written were {}", times.size(), stated->instants));
  for (std::size_t i = 0; i < times.size(); ++i)
    if ((i > 0 && times[i] <= times[i - 1]) || times[i] > end * (1.0 + rounding))
      throw OutputError("use", file, fmt::format("the instant {} is of {} s", i, times[i]));
}

}  // namespace granvof::compare
