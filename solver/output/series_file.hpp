// series.csv: one row per output time, "name [unit]" as header, an empty field where a value is undefined.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "solver/output/atomic_file.hpp"

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

// Appends rows; a row is written in one piece, and what a failed write left behind is cut off again.
class SeriesFile {
 public:
  // Starts an empty file with its header. Throws OutputError.
  static SeriesFile create(const std::filesystem::path& path, std::span<const Column> columns);
  // Goes on with an existing file: rows later than `last_time` [s] and a torn last row are removed.
  // Throws OutputError if the file cannot be read or its header is another.
  static SeriesFile resume(const std::filesystem::path& path, std::span<const Column> columns,
                           double last_time);

  // One value per column; throws std::invalid_argument for a wrong count, NaN or infinity, OutputError if not
  // written.
  void append(std::span<const Value> row);
  void flush_to_disk();

 private:
  SeriesFile(std::filesystem::path path, std::size_t columns);

  std::filesystem::path path_;
  std::size_t columns_ = 0;
  Descriptor file_;
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
