// Somebody else's series (another code, a laboratory) laid beside one of our runs.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compare/input/run.hpp"

namespace granvof::compare {

// One quantity in both, and how far apart the two curves are where they overlap.
struct LaidCurve {
  std::string name;
  std::string unit;
  std::string abscissa;  // "T [-]" or "t [s]"
  Curve ours, theirs;
  Window window;                      // the overlap
  std::optional<double> rms;          // root-mean-square difference over it
  std::optional<double> ours_at_end;  // values at its end
  std::optional<double> theirs_at_end;
  std::optional<double>
      ours_integral;  // time integrals over it, which is how oscillating curves are compared
  std::optional<double> theirs_integral;
};

// Reads a series of others (lay/README.md): a CSV with a header "name [unit]", "time [s]" or "T [-]" and any
// of our columns, or the derived "run_out [-]" and "excess_base_pressure [Pa]". Throws OutputError naming
// file and line, std::invalid_argument naming a column that is unknown or in another unit.
Run read_their_series(const std::filesystem::path& file, const Scene& scene);

// Reads the fields of others (fields.h5 of docs/output.md) and extracts every scalar with the code that
// serves our own runs. Throws OutputError, std::invalid_argument if their box is not the scene's tank.
Run read_their_fields(const std::filesystem::path& file, const Scene& scene);

// Every quantity that both hold. Throws std::invalid_argument if there is none, or if one is too large for
// its differences or areas to be finite.
std::vector<LaidCurve> lay(const Run& ours, const Run& theirs);

// For people, and for the plots.
std::string lay_table(const std::vector<LaidCurve>& curves, const std::string& their_name);
std::string lay_json(const std::vector<LaidCurve>& curves, const Run& ours, const std::string& their_name);

}  // namespace granvof::compare
