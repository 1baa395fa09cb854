#include "compare/input/bands.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string_view>

#include <nlohmann/json.hpp>

#include "solver/output/atomic_file.hpp"
#include "solver/output/output_error.hpp"

namespace granvof::compare {
namespace {

// What a difference is called that counts, by how its name begins: seed2, cell-3.3mm, slice-4.8mm.
constexpr std::array<std::string_view, 3> kinds{"seed", "cell-", "slice-"};

}  // namespace

Bands read_bands(const std::filesystem::path& records) {
  const auto file = records / "bands.json";
  if (!std::filesystem::exists(file)) return {};
  const auto differences = nlohmann::json::parse(read_file(file), nullptr, false);
  if (!differences.is_array()) throw OutputError("read", file, "it is not a JSON list");
  std::map<std::string, std::array<double, kinds.size()>> largest;
  for (const auto& difference : differences) {
    if (!difference.is_object()) continue;
    if (!difference.contains("rms") || !difference["rms"].is_number())
      throw OutputError("read", file, "a band without the number 'rms'");
    const std::string against = difference.value("against", "");
    for (std::size_t i = 0; i < kinds.size(); ++i)
      if (against.starts_with(kinds[i])) {
        double& rms = largest[difference.value("column", "")][i];
        rms = std::max(rms, difference["rms"].get<double>());
      }
  }
  Bands bands;
  for (const auto& [column, each] : largest)
    bands[column] = std::sqrt(std::inner_product(each.begin(), each.end(), each.begin(), 0.0));
  return bands;
}

}  // namespace granvof::compare
