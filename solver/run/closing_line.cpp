#include "solver/run/closing_line.hpp"

#include <cstddef>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace granvof {
namespace {

std::string results(const Scene& scene, const Scalars& end) {
  const std::vector<std::string_view> of_the_bed{"front_dense", "deposit_height", "y_solid_mean"},
      of_the_liquid{"liquid_front", "interface_height"};
  std::string text;
  for (const std::string_view name : scene.bed ? of_the_bed : of_the_liquid)
    for (std::size_t i = 0; i < end.size(); ++i)
      if (const ScalarEntry& entry = scalar_table()[i]; entry.name == name && end[i])
        text += fmt::format("{}{} {:.4g} {}", text.empty() ? "" : ", ", name, *end[i], entry.unit);
  return text.empty() ? "" : text + "; ";
}

std::string warnings(const RunProgress& progress) {
  if (progress.warnings.empty()) return "no warnings";
  std::string names;
  for (const Warning& warning : progress.warnings) names += (names.empty() ? "" : ", ") + warning.monitor;
  return fmt::format("{} warning{}: {}", progress.warnings.size(), progress.warnings.size() == 1 ? "" : "s",
                     names);
}

}  // namespace

std::string closing_line(const Scene& scene, const RunProgress& progress, const Scalars& end,
                         const std::filesystem::path& directory) {
  return fmt::format(
      "{}: finished, t = {:.4g} s: {}{:.3g} core-seconds, {} steps of {} cells; {}; next: granvof report {}",
      scene.name, progress.simulated_time, results(scene, end), progress.core_seconds, progress.steps,
      progress.cells, warnings(progress), directory.string());
}

}  // namespace granvof
