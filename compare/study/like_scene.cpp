#include "compare/study/like_scene.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "solver/output/atomic_file.hpp"
#include "solver/output/json_fault.hpp"
#include "solver/scene/load_scene.hpp"

namespace granvof::compare {
namespace {

// What a bed may stand out of the liquid and count as submerged, of its height.
constexpr double dry_share = 0.02;

// Height of the liquid over the middle of the bed's base; 0 without.
double level_at(const Scene& scene, const Box& bed) {
  const double x = 0.5 * (bed.lower[0] + bed.upper[0]);
  double level = 0.0;
  for (const Box& box : scene.liquid_boxes)
    if (box.lower[0] <= x && x <= box.upper[0]) level = std::max(level, box.upper[1]);
  return level;
}

std::string_view surroundings_of(const Scene& scene) {
  if (!scene.bed) return "no grains";
  const Box& bed = scene.bed->box;
  const double level = level_at(scene, bed), height = bed.upper[1] - bed.lower[1];
  if (level <= 0.0) return "dry";
  if (scene.solid.density < scene.liquid.density) return "floating";
  if (level <= bed.lower[1] + dry_share * height) return "above liquid";
  return level >= bed.upper[1] - dry_share * height ? "submerged" : "partly wet";
}

double farthest(const SceneNumbers& a, const SceneNumbers& b) {
  double factor = 1.0;
  for (std::size_t i = 0; i < a.numbers.size(); ++i)
    factor = std::max(factor, std::exp(std::abs(std::log(a.numbers[i].value / b.numbers[i].value))));
  return factor;
}

double distance(const SceneNumbers& a, const SceneNumbers& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.numbers.size(); ++i)
    sum += std::pow(std::log(a.numbers[i].value / b.numbers[i].value), 2);
  return sum;
}

bool of_quantity(const KnownRow& row, const Quantity& quantity) {
  return row.metric.substr(0, row.metric.find_first_of("@ ")) == quantity.name;
}

ModelError error_of(const std::vector<const KnownRow*>& rows, bool is_curve) {
  ModelError error{
      rows.front()->run, "", rows.front()->reference_kind, 0.0, 0.0, static_cast<int>(rows.size())};
  double squares = 0.0, largest = 0.0;
  std::vector<double> each;
  for (const KnownRow* row : rows) {
    squares += std::pow(row->value - row->reference, 2);
    largest = std::max(largest, std::abs(row->reference));
    each.push_back(std::abs(row->value - row->reference) / std::abs(row->reference));
  }
  const auto [low, high] = std::minmax_element(each.begin(), each.end());
  error.lowest = *low;
  error.highest = *high;
  if (is_curve)
    error.lowest = error.highest = std::sqrt(squares / static_cast<double>(rows.size())) / largest;
  return error;
}

}  // namespace

std::string preset_of(const Scene& scene) {
  const std::string key = "preset = \"";
  const auto at = scene.resolved.find(key);
  if (at == std::string::npos) return "";
  const auto begin = at + key.size();
  return scene.resolved.substr(begin, scene.resolved.find('"', begin) - begin);
}

SceneNumbers numbers_of(const Scene& scene) {
  SceneNumbers found{surroundings_of(scene), {}};
  if (!scene.bed) {
    double length = scene.tank[0], height = scene.tank[1];
    for (const Box& box : scene.liquid_boxes) {
      length = box.upper[0] - box.lower[0];
      height = box.upper[1] - box.lower[1];
    }
    found.numbers = {{"aspect ratio", height / length}};
    return found;
  }
  const Box& bed = scene.bed->box;
  const double height = bed.upper[1] - bed.lower[1], length = bed.upper[0] - bed.lower[0];
  const Fluid& fluid = found.surroundings == "dry" ? scene.gas : scene.liquid;
  const double d = scene.solid.diameter, rho_s = scene.solid.density;
  const double fall = std::sqrt(rho_s * std::abs(rho_s - fluid.density) * scene.gravity * d * d * d);
  found.numbers = {{"density ratio", rho_s / fluid.density}};
  if (fluid.viscosity > 0.0 && fall > 0.0)
    found.numbers.push_back({"Stokes number", fall / (18.0 * fluid.viscosity)});
  found.numbers.push_back({"aspect ratio", height / length});
  found.numbers.push_back({"h/d", height / d});
  return found;
}

std::vector<KnownRow> read_known_rows(const std::filesystem::path& file) {
  const auto json = nlohmann::json::parse(read_file(file), nullptr, false);
  const char* key = json.is_object() && json.contains("rows") ? "rows" : "results";
  if (!json.is_object() || !json.contains(key) || !json.at(key).is_array())
    throw std::runtime_error(fmt::format("{}: not results of granvof-compare check", file.string()));
  std::vector<KnownRow> rows;
  for (const auto& row : json.at(key)) {
    try {
      if (!row.at("value").is_number() || !row.at("reference").is_number()) continue;
      rows.push_back({row.at("scene"), row.at("metric"), row.at("reference_kind"),
                      row.at("value").get<double>(), row.at("reference").get<double>()});
    } catch (const nlohmann::json::exception& error) {
      throw std::runtime_error(fmt::format("{}: {}", file.string(), json_fault(error)));
    }
  }
  return rows;
}

std::vector<LikeScene> like_scenes(const Scene& scene, const Quantity& quantity, const Table& table,
                                   std::span<const KnownRow> rows, const std::filesystem::path& cases,
                                   std::size_t most) {
  std::map<std::string, std::vector<const KnownRow*>> by_run;
  for (const KnownRow& row : rows)
    if ((row.reference_kind == "DEM" || row.reference_kind == "published") && row.reference != 0.0 &&
        of_quantity(row, quantity))
      by_run[row.run].push_back(&row);
  const SceneNumbers here = numbers_of(scene);
  std::vector<LikeScene> found;
  for (const PlannedRun& planned : table.runs) {
    const auto known = by_run.find(planned.id);
    if (known == by_run.end() || planned.case_name == scene.name) continue;
    const Scene other = load_scene(cases / (planned.case_name + ".toml"), planned.set);
    SceneNumbers there = numbers_of(other);
    if (there.surroundings != here.surroundings || there.numbers.size() != here.numbers.size()) continue;
    ModelError error = error_of(known->second, quantity.is_curve);
    error.preset = preset_of(other);
    auto same = std::find_if(found.begin(), found.end(),
                             [&](const LikeScene& one) { return one.case_name == planned.case_name; });
    if (same == found.end()) {
      found.push_back({planned.case_name, there, farthest(here, there), {}});
      same = found.end() - 1;
    }
    same->errors.push_back(std::move(error));
  }
  std::stable_sort(found.begin(), found.end(), [&](const LikeScene& a, const LikeScene& b) {
    return distance(here, a.numbers) < distance(here, b.numbers);
  });
  if (found.size() > most) found.resize(most);
  return found;
}

std::vector<std::string> likeness_text(const SceneNumbers& here, const std::vector<LikeScene>& scenes) {
  if (scenes.empty())
    return {fmt::format("model error: not known; no recorded scene ({}) is judged in this quantity",
                        here.surroundings)};
  std::vector<std::string> lines{"model error, which no grid mends, in the nearest recorded scenes:"};
  for (const LikeScene& scene : scenes) {
    std::vector<std::string> errors, numbers;
    for (const ModelError& error : scene.errors)
      errors.push_back(error.lowest == error.highest
                           ? fmt::format("{} {:.0f} % ({})", error.preset, 100.0 * error.highest, error.run)
                           : fmt::format("{} {:.0f} to {:.0f} % ({})", error.preset, 100.0 * error.lowest,
                                         100.0 * error.highest, error.run));
    for (std::size_t i = 0; i < here.numbers.size(); ++i)
      numbers.push_back(fmt::format("{} {:.3g} / {:.3g}", here.numbers[i].name, here.numbers[i].value,
                                    scene.numbers.numbers[i].value));
    lines.push_back(fmt::format("  {} against {}: {}", scene.case_name, scene.errors.front().kind,
                                fmt::join(errors, ", ")));
    lines.push_back(fmt::format("    {}, here / there: {}; {}", here.surroundings, fmt::join(numbers, ", "),
                                scene.farthest <= near_factor
                                    ? fmt::format("near: each within a factor of {:.2g}", scene.farthest)
                                    : fmt::format("NOT near: up to a factor of {:.2g}", scene.farthest)));
  }
  return lines;
}

}  // namespace granvof::compare
