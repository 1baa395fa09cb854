#include "solver/output/series_file.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "solver/output/output_error.hpp"

namespace granvof {

namespace {

std::string header_line(std::span<const Column> columns) {
  std::string line;
  for (const auto& column : columns) {
    if (!line.empty()) line += ',';
    line += column_header(column);
  }
  return line + '\n';
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> fields;
  for (;;) {
    const auto comma = line.find(',');
    fields.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

std::optional<double> parse_number(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

Column parse_header(std::string_view field) {
  const auto open = field.rfind(" [");
  if (open == std::string_view::npos || !field.ends_with(']')) return {std::string(field), "", ""};
  return {std::string(field.substr(0, open)), std::string(field.substr(open + 2, field.size() - open - 3)),
          ""};
}

// Complete lines only: what follows the last newline is a torn row.
std::vector<std::string_view> complete_lines(std::string_view text) {
  std::vector<std::string_view> lines;
  for (auto end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
    lines.push_back(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  return lines;
}

}  // namespace

std::string column_header(const Column& column) {
  return column.name + " [" + column.unit + "]";
}

SeriesFile::SeriesFile(std::filesystem::path path, std::span<const Column> columns)
    : path_(std::move(path)), file_(::open(path_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC)) {
  if (!file_.valid()) throw OutputError("write", path_, std::generic_category().message(errno));
  for (const Column& column : columns) columns_.push_back(column_header(column));
}

SeriesFile SeriesFile::create(const std::filesystem::path& path, std::span<const Column> columns) {
  const std::string header = header_line(columns);
  write_file_atomically(path, header);
  SeriesFile file(path, columns);
  file.count(header);
  return file;
}

std::string SeriesFile::rows_until(const std::filesystem::path& path, std::span<const Column> columns,
                                   std::span<const double> times) {
  const std::string header = header_line(columns);
  const std::string text = read_file(path);
  if (!text.starts_with(header)) {
    throw OutputError("resume", path,
                      "its columns are not those of this program; it was written by another version");
  }
  std::string kept = header;
  const auto lines = complete_lines(std::string_view(text).substr(header.size()));
  for (std::size_t row = 0; row < times.size(); ++row) {
    const auto time = row < lines.size() ? parse_number(split(lines[row]).front()) : std::nullopt;
    if (time != times[row]) {
      throw OutputError(
          "resume", path,
          fmt::format("row {} should be of t = {} s, the case asks for it before the checkpoint, and {} (an "
                      "output.series_interval that is left out goes with time.end: give the one it had)",
                      row + 1, times[row], time ? fmt::format("is of {} s", *time) : "is not there"));
    }
    kept.append(lines[row]).append("\n");
  }
  return kept;
}

void SeriesFile::check_unchanged(const std::filesystem::path& path, const SeriesFacts& stated) {
  if (stated.sha256.empty()) return;  // the run had not got so far
  const std::string text = read_file(path);
  const auto lines = complete_lines(text);
  const auto count = static_cast<std::size_t>(stated.rows) + 1;
  if (lines.size() < count) return;
  Digest digest;
  for (std::size_t line = 0; line < count; ++line) {
    digest.add(lines[line]);
    digest.add("\n");
  }
  if (digest.hex() != stated.sha256)
    throw OutputError("resume", path, "it is not what the run has written: it was changed since");
}

SeriesFile SeriesFile::resume(const std::filesystem::path& path, std::span<const Column> columns,
                              std::span<const double> times) {
  const std::string kept = rows_until(path, columns, times);
  write_file_atomically(path, kept);
  SeriesFile file(path, columns);
  file.count(kept);
  file.rows_ = static_cast<std::int64_t>(times.size());
  if (!times.empty()) file.end_ = times.back();
  return file;
}

void SeriesFile::count(std::string_view text) {
  digest_.add(text);
  bytes_ += text.size();
}

void SeriesFile::check_still_there() const {
  struct stat ours {
  }, theirs{};
  const bool known = ::fstat(file_.get(), &ours) == 0 && ::stat(path_.c_str(), &theirs) == 0;
  if (!known || ours.st_dev != theirs.st_dev || ours.st_ino != theirs.st_ino)
    throw OutputError("write", path_, "it was removed or replaced while the run went on");
  if (static_cast<std::uintmax_t>(ours.st_size) != bytes_)
    throw OutputError("write", path_, "somebody else wrote to it while the run went on");
}

void SeriesFile::append(std::span<const Value> row) {
  if (row.size() != columns_.size()) {
    throw std::invalid_argument(
        fmt::format("a row of {} values for {} columns", row.size(), columns_.size()));
  }
  std::string line;
  for (std::size_t c = 0; c < row.size(); ++c) {
    if (c > 0) line += ',';
    if (!row[c]) continue;
    if (!std::isfinite(*row[c])) {
      throw std::invalid_argument(
          fmt::format("{} of a row of {} is {}", columns_[c], path_.string(), *row[c]));
    }
    fmt::format_to(std::back_inserter(line), "{}",
                   *row[c]);  // shortest text that reads back as the same number
  }
  line += '\n';
  check_still_there();
  try {
    write_all(file_, line, path_);
  } catch (const OutputError&) {
    // The row may be half there; if cutting fails too, readers still drop a line without an end.
    [[maybe_unused]] const int cut = ::ftruncate(file_.get(), static_cast<off_t>(bytes_));
    throw;
  }
  count(line);
  ++rows_;
  end_ = row.front();
}

void SeriesFile::flush_to_disk() {
  check_still_there();
  sync(file_, path_);
}

SeriesFacts SeriesFile::facts() const {
  return {rows_, end_, columns_, digest_.hex()};
}

bool Series::has(std::string_view name) const {
  return std::any_of(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; });
}

std::vector<Value> Series::column(std::string_view name) const {
  const auto found =
      std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; });
  if (found == columns.end()) throw std::out_of_range(fmt::format("the series has no column '{}'", name));
  const auto c = static_cast<std::size_t>(found - columns.begin());
  std::vector<Value> values;
  values.reserve(rows.size());
  for (const auto& row : rows) values.push_back(row[c]);
  return values;
}

Series read_series(const std::filesystem::path& path) {
  const std::string text = read_file(path);
  const auto lines = complete_lines(text);
  if (lines.empty()) throw OutputError("read", path, "it has no header line");
  Series series;
  for (const auto field : split(lines.front())) series.columns.push_back(parse_header(field));
  for (std::size_t l = 1; l < lines.size(); ++l) {
    const auto fields = split(lines[l]);
    if (fields.size() != series.columns.size()) {
      throw OutputError("read", path,
                        fmt::format("line {} has {} fields, the header has {}", l + 1, fields.size(),
                                    series.columns.size()));
    }
    auto& row = series.rows.emplace_back();
    for (std::size_t c = 0; c < fields.size(); ++c) {
      if (fields[c].empty()) {
        row.emplace_back();
        continue;
      }
      const auto value = parse_number(fields[c]);
      if (!value) {
        throw OutputError("read", path,
                          fmt::format("line {}, {}: '{}' is not a finite number", l + 1,
                                      series.columns[c].name, fields[c]));
      }
      row.emplace_back(*value);
    }
  }
  return series;
}

}  // namespace granvof
