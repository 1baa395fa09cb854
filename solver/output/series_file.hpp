// series.csv: one row per output time, "name [unit]" as header, an empty field where a value is undefined.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "solver/output/atomic_file.hpp"
#include "solver/output/digest.hpp"

namespace granvof {

// A column of series.csv: what it is called, its unit ("-" if it has none) and what it means
// (docs/output.md).
struct Column {
  std::string name;
  std::string unit;
  std::string description;
};

using Value = std::optional<double>;

// The header field of a column: "name [unit]".
std::string column_header(const Column& column);

// What a series.csv holds, for run.json.
struct SeriesFacts {
  std::int64_t rows = 0;
  std::optional<double> end;         // time of the last row [s]
  std::vector<std::string> columns;  // as in the header: "name [unit]"
  std::string sha256;                // of the whole file
};

// Appends rows; a row is written in one piece, and what a failed write left behind is cut off again. Throws
// OutputError as soon as the file is not what was written: removed, replaced or cut by somebody else.
class SeriesFile {
 public:
  // Starts an empty file with its header. Throws OutputError.
  static SeriesFile create(const std::filesystem::path& path, std::span<const Column> columns);
  // Goes on with an existing file behind its rows of `times` [s], ascending; later rows and a torn last one
  // are removed. Throws OutputError if the file cannot be read, its header is another, or its first rows are
  // not of these times.
  static SeriesFile resume(const std::filesystem::path& path, std::span<const Column> columns,
                           std::span<const double> times);

  // What resume() would keep of the file, without touching it. Throws as that does.
  static std::string rows_until(const std::filesystem::path& path, std::span<const Column> columns,
                                std::span<const double> times);

  // Throws OutputError where the first rows are not those of `stated` (of run.json): changed since. A file
  // with fewer rows is let off, as a resumption that was killed leaves it; rows_until() says what is missing.
  static void check_unchanged(const std::filesystem::path& path, const SeriesFacts& stated);

  // One value per column, the first one the time; throws std::invalid_argument for a wrong count, NaN or
  // infinity, OutputError if not written.
  void append(std::span<const Value> row);
  void flush_to_disk();
  SeriesFacts facts() const;

 private:
  SeriesFile(std::filesystem::path path, std::span<const Column> columns);
  void count(std::string_view text);  // as written
  void check_still_there() const;

  std::filesystem::path path_;
  std::vector<std::string> columns_;
  Descriptor file_;
  Digest digest_;
  std::uintmax_t bytes_ = 0;
  std::int64_t rows_ = 0;
  std::optional<double> end_;
};

// A whole series.csv in memory.
struct Series {
  std::vector<Column> columns;           // without descriptions
  std::vector<std::vector<Value>> rows;  // rows[i][c]

  bool has(std::string_view name) const;
  // All values of one column. Throws std::out_of_range naming the column if there is none.
  std::vector<Value> column(std::string_view name) const;
};

// Throws OutputError naming file, line and field for a malformed row or a value that is not finite.
// A torn last line (a run killed while writing) is left out.
Series read_series(const std::filesystem::path& path);

}  // namespace granvof
