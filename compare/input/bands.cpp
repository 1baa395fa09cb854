#include "compare/input/bands.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "compare/input/is_there.hpp"
#include "solver/output/atomic_file.hpp"
#include "solver/output/json_fault.hpp"
#include "solver/output/output_error.hpp"

namespace granvof::compare {
namespace {

// What a difference is called that counts, by how its name begins: seed2, cell-3.3mm, slice-4.8mm.
constexpr std::array kinds{std::pair{"seed", Bands::Kind::seed}, std::pair{"cell-", Bands::Kind::grid},
                           std::pair{"slice-", Bands::Kind::depth}};

}  // namespace

void Bands::add(const std::string& scene, const std::string& column, Kind kind, double rms) {
  double& largest = columns_[column][static_cast<std::size_t>(kind)][scene];
  largest = std::max(largest, rms);
}

std::optional<double> Bands::of(std::string_view scene, std::string_view column) const {
  const auto found = columns_.find(column);
  if (found == columns_.end()) return std::nullopt;
  double squares = 0.0;
  for (const ByScene& scenes : found->second) {
    double rms = 0.0;
    if (const auto own = scenes.find(scene); own != scenes.end()) {
      rms = own->second;
    } else {
      for (const auto& [name, value] : scenes) rms = std::max(rms, value);
    }
    squares += rms * rms;
  }
  return std::sqrt(squares);
}

Bands read_bands(const std::filesystem::path& records) {
  const auto file = records / "bands.json";
  if (!is_there(file)) return {};
  const auto differences = nlohmann::json::parse(read_file(file), nullptr, false);
  if (!differences.is_array()) throw OutputError("read", file, "it is not a JSON list");
  Bands bands;
  for (const auto& difference : differences) {
    try {
      const std::string against = difference.at("against");
      const double rms = difference.at("rms");
      if (!(rms >= 0.0)) throw OutputError("read", file, fmt::format("a band of {}", rms));
      for (const auto& [name, kind] : kinds)
        if (against.starts_with(name)) bands.add(difference.at("scene"), difference.at("column"), kind, rms);
    } catch (const nlohmann::json::exception& error) {
      throw OutputError("read", file, json_fault(error));
    }
  }
  if (bands.empty()) throw OutputError("read", file, "there is no band in it");
  return bands;
}

}  // namespace granvof::compare
