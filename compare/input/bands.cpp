#include "compare/input/bands.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <nlohmann/json.hpp>

#include "solver/output/atomic_file.hpp"
#include "solver/output/output_error.hpp"

namespace granvof::compare {
namespace {

// What a difference is called that counts, by how its name begins: seed2, cell-3.3mm, slice-4.8mm.
constexpr std::array<std::string_view, 3> kinds{"seed", "cell-", "slice-"};

}  // namespace

std::optional<double> band_of(const std::filesystem::path& records, std::string_view column) {
  const auto file = records / "bands.json";
  if (!std::filesystem::exists(file)) return std::nullopt;
  const auto bands = nlohmann::json::parse(read_file(file), nullptr, false);
  if (!bands.is_array()) throw OutputError("read", file, "it is not a JSON list");
  std::array<double, kinds.size()> largest{};
  bool found = false;
  for (const auto& band : bands) {
    if (!band.is_object() || band.value("column", "") != column) continue;
    if (!band.contains("rms") || !band["rms"].is_number())
      throw OutputError("read", file, "a band without the number 'rms'");
    const std::string against = band.value("against", "");
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      if (!against.starts_with(kinds[i])) continue;
      largest[i] = std::max(largest[i], band["rms"].get<double>());
      found = true;
    }
  }
  double squares = 0.0;
  for (const double rms : largest) squares += rms * rms;
  return found ? std::optional(std::sqrt(squares)) : std::nullopt;
}

}  // namespace granvof::compare
