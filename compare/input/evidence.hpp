// Whether a run directory holds what its run.json says that was written: a file that was cut, changed or
// mixed with another is no evidence, and must not be judged.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "solver/output/series_file.hpp"

namespace granvof::compare {

// The part "files" of run.json or record.json.
struct StatedSeries {
  std::int64_t rows = 0;
  std::optional<double> end;         // time of the last row [s]; nothing without a row
  std::vector<std::string> columns;  // "name [unit]"
  std::string sha256;
};

struct StatedFields {
  std::int64_t instants = 0;
  std::optional<std::string> sha256;  // nothing where fields.h5 links to a file an instant
};

struct StatedFiles {
  StatedSeries series;
  std::optional<StatedFields> fields;  // nothing: there is no fields.h5
};

// What a series must cover, by its case.
struct Asked {
  double interval = 0.0;  // between rows [s]; 0: unknown, the mean of the rows that there are stands for it
  double end = 0.0;       // [s]
  std::int64_t rows = 0;  // 0: unknown
};

// Rows may be apart by no more than this multiple of the interval: one that is missing leaves a gap of two.
// The rest is for recorders that write at the end of a step.
inline constexpr double widest_gap = 1.5;

// Throws OutputError naming file and difference unless `series`, read from `file`, has the stated columns,
// rows and end; the columns that are known have their unit; time ascends strictly from 0 to the end asked
// for (the last row may be missing by rounding), without a gap.
void require_series(const Series& series, const std::filesystem::path& file, const StatedSeries& stated,
                    const Asked& asked);

// The interval between the rows of a sound series [s].
double interval_of(const Series& series, const Asked& asked);

// Throws OutputError unless the file has that digest.
void require_digest(const std::filesystem::path& file, const std::string& sha256);

// Throws OutputError unless fields.h5 of `directory` is as stated: there or not, digest, number of instants
// in ascending order, not after `end` [s].
void require_fields(const std::filesystem::path& directory, const std::optional<StatedFields>& stated,
                    double end);

}  // namespace granvof::compare
