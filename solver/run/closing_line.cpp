#include "solver/run/closing_line.hpp"

#include <cstddef>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "solver/plausibility/plausibility.hpp"

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

std::string counted(std::size_t n) {
  return n == 0 ? "no warnings" : fmt::format("{} warning{}", n, n == 1 ? "" : "s");
}

// Those of the run by name; those of the case stand above, before its first step.
std::string warnings(const Scene& scene, const RunProgress& progress) {
  std::string text = counted(progress.warnings.size());
  for (std::size_t i = 0; i < progress.warnings.size(); ++i)
    text += (i == 0 ? ": " : ", ") + progress.warnings[i].monitor;
  if (const std::size_t of_the_case = plausibility(scene).size(); of_the_case > 0)
    text += fmt::format("; {} about the case", counted(of_the_case));
  return text;
}

}  // namespace

std::string closing_line(const Scene& scene, const RunProgress& progress, const Scalars& end,
                         const std::filesystem::path& directory) {
  return fmt::format(
      "{}: finished, t = {:.4g} s: {}{:.3g} core-seconds, {} steps of {} cells; {}; next: granvof report {}",
      scene.name, progress.simulated_time, results(scene, end), progress.core_seconds, progress.steps,
      progress.cells, warnings(scene, progress), directory.string());
}

}  // namespace granvof
