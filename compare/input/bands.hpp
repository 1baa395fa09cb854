// How far a DEM-VOF record moves with what the continuum does not have: seed, fluid grid, depth of the slice.
// Measured by reference/bands on the scenes that were recorded more than once (the canary; seeds also of s1
// and s2), kept in reference/results/bands.json.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace granvof::compare {

class Bands {
 public:
  // What moved a record: another seed, fluid grid or depth of the slice. (Another floor is another scene, and
  // beads for many grains another method: neither is an uncertainty.)
  enum class Kind { seed, grid, depth };

  void add(const std::string& scene, const std::string& column, Kind kind, double rms);
  bool empty() const { return columns_.empty(); }
  // Of a column ("front_dense [m]") of a record of `scene`, rms over the run in the column's unit: the
  // largest difference of each kind, taken together as the root of the sum of squares. Where the scene itself
  // was recorded so, its own difference stands; where it was not, the largest of any scene.
  std::optional<double> of(std::string_view scene, std::string_view column) const;

 private:
  using ByScene = std::map<std::string, double, std::less<>>;
  std::map<std::string, std::array<ByScene, 3>, std::less<>> columns_;
};

// Empty where `records` has no bands.json. Throws OutputError for a damaged file.
Bands read_bands(const std::filesystem::path& records);

}  // namespace granvof::compare
