#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "compare/input/curves.hpp"
#include "compare/input/energy_budget.hpp"
#include "compare/metrics/power_law.hpp"
#include "compare/output/write.hpp"

namespace granvof::compare {
namespace {

using Json = nlohmann::ordered_json;

Json json_number(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json json_run(const RunSummary& summary) {
  Json run{{"id", summary.plan.id},
           {"case", summary.plan.case_name},
           {"set", summary.plan.set},
           {"state", name_of(summary.state)},
           {"reason", summary.reason}};
  if (!summary.facts) return run;
  run["version"] = summary.facts->version;
  run["commit"] = summary.facts->commit;
  run["date"] = summary.facts->date;
  run["case_hash"] = summary.facts->case_hash;
  run["host"] = summary.facts->host;
  run["exit"] = summary.facts->exit;
  run["numbers"] = summary.facts->numbers;
  return run;
}

// The record that a run is shown beside: the first that a row judges it by, or that of its case.
std::string record_of(const Evaluation& evaluation, const PlannedRun& plan) {
  for (const Result& result : evaluation.results)
    if (result.check.run == plan.id && result.check.reference.record) return *result.check.reference.record;
  return plan.case_name;
}

Json json_result(const Result& result) {
  const Check& check = result.check;
  Json json{{"id", check.id},
            {"scene", check.run},
            {"quantity", check.metric},
            {"metric", metric_label(check)},
            {"value", json_number(result.value)},
            {"unit", result.unit},
            {"reference", json_number(result.reference)},
            {"reference_kind", name_of(check.reference.kind)},
            {"reference_source", check.reference.source},
            {"band", result.band},
            {"tolerance", tolerance_text(check)},
            {"verdict", name_of(result.judgement.verdict)},
            {"unexpected", result.judgement.unexpected},
            {"asserted", check.asserted},
            {"frequency", name_of(check.frequency)},
            {"note", result.note}};
  if (check.parameters.against) json["against"] = *check.parameters.against;
  const bool judged = result.value && result.reference;
  json["deviation"] = judged ? Json(result.judgement.deviation) : Json(nullptr);
  json["distance"] = judged ? Json(result.judgement.distance) : Json(nullptr);
  if (check.expected_failure)
    json["expected_failure"] = {{"reason", check.expected_failure->reason},
                                {"distance", check.expected_failure->distance},
                                {"cause", check.expected_failure->cause}};
  return json;
}

Json json_curve(const Curve& curve) {
  return {{"x", curve.time}, {"y", curve.value}};
}

// At most `most` of its samples, evenly taken, the last among them.
Curve sampled(const Curve& curve, std::size_t most) {
  if (curve.time.size() <= most) return curve;
  Curve taken;
  taken.widest = curve.widest;
  for (std::size_t i = 0; i < most; ++i) {
    const std::size_t at = i * (curve.time.size() - 1) / (most - 1);
    taken.time.push_back(curve.time[at]);
    taken.value.push_back(curve.value[at]);
  }
  return taken;
}

Curve shifted(Curve curve, double by) {
  for (double& value : curve.value) value += by;
  return curve;
}

Json json_curves(const Run& run) {
  Json curves = Json::object();
  const auto add = [&](const char* name, const Curve& curve) {
    if (!curve.empty()) curves[name] = json_curve(curve);
  };
  add("run_out", run_out_curve(run));
  add("run_out_dense", run_out_dense_curve(run));
  add("run_out_quantile", run_out_quantile_curve(run));
  add("excess_base_pressure", excess_base_pressure(run));
  for (const char* column : {"y_c", "y_solid_mean"}) {
    // About the paper's mean, over 3-6 s of 6 s.
    const Curve centre = run.curve(column);
    const auto mean = time_mean(clip(centre, {0.5 * run.scene.times.end, run.scene.times.end}));
    if (mean) add((std::string(column) + "_deviation").c_str(), shifted(centre, -*mean));
  }
  for (const char* column : {"front_dense", "front_quantile", "y_c", "y_solid_mean", "interface_height",
                             "bed_height_equivalent", "liquid_front", "liquid_height_left"})
    add(column, run.curve(column));
  if (!run.scene.bed) add("scaled_liquid_front", scaled_liquid_front(run));
  for (const auto& [name, curve] : energy_budget(run))
    add(fmt::format("energy:{}", name).c_str(), sampled(curve, 300));
  return curves;
}

// The fit of eq (26) to the front, over all but the first tenth of the run, and at most until the front meets
// the far wall.
Json json_power_law(const Run& run) {
  const Curve front = free_front(run);
  if (front.empty()) return nullptr;
  const Window window{0.1 * run.scene.times.end, front.time.back()};
  const auto fit = power_law(front, window);
  if (!fit) return nullptr;
  return {{"factor", fit->factor}, {"exponent", fit->exponent}, {"begin", window.begin}, {"end", window.end}};
}

// What a reader of the energy curves needs: how each counts and what it is called.
Json json_ledger(const Run& run) {
  Json terms = Json::array();
  for (const LedgerTerm& term : run.facts.ledger)
    terms.push_back(
        {{"name", term.name}, {"kind", term.kind}, {"never_gains", term.never_gains}, {"label", term.label}});
  return terms;
}

Json json_scene(const Scene& scene) {
  Json json{{"title", scene.title},
            {"tank", scene.tank},
            {"dimensions", scene.dimensions},
            {"cells", scene.grid.cells},
            {"spacing", scene.grid.spacing},
            {"gravity", scene.gravity},
            {"density_ratio", scene.solid.density / scene.liquid.density},
            {"drag", scene.model.drag},
            {"end", scene.times.end},
            {"time_unit", scene.times.unit},
            {"field_times", scene.times.field_times}};
  if (scene.bed)
    json["bed"] = {{"lower", scene.bed->box.lower},
                   {"upper", scene.bed->box.upper},
                   {"solid_fraction", scene.bed->solid_fraction}};
  return json;
}

}  // namespace

std::string results_json(const Evaluation& evaluation, Frequency frequency, const std::string& date) {
  Json json{{"date", date}, {"frequency", name_of(frequency)}, {"unexpected", evaluation.unexpected()}};
  std::map<std::string, int> counts;
  for (const Result& result : evaluation.results) ++counts[std::string(name_of(result.judgement.verdict))];
  json["counts"] = counts;
  json["causes"] = Json::object();
  for (const Cause& cause : evaluation.causes) json["causes"][cause.key] = cause.text;
  json["runs"] = Json::array();
  for (const RunSummary& summary : evaluation.runs) {
    json["runs"].push_back(json_run(summary));
    json["runs"].back()["record"] = record_of(evaluation, summary.plan);
  }
  json["results"] = Json::array();
  for (const Result& result : evaluation.results) json["results"].push_back(json_result(result));
  return json.dump(1) + "\n";
}

std::string curves_json(const Evaluation& evaluation) {
  const auto json_entry = [](const Run& run) {
    return Json{{"scene", json_scene(run.scene)},
                {"directory", run.directory.string()},
                {"curves", json_curves(run)},
                {"ledger", json_ledger(run)},
                {"power_law", json_power_law(run)}};
  };
  Json json{{"runs", Json::object()}, {"records", Json::object()}, {"peers", Json::object()}};
  for (const auto& [id, run] : evaluation.usable) json["runs"][id] = json_entry(run);
  for (const auto& [name, variants] : evaluation.records)
    for (const Run& run : variants) json["records"][name][run.id] = json_entry(run);
  // Levels take reading all the fields: only those that a row asks for.
  for (const Result& result : evaluation.results)
    if (const auto run = evaluation.usable.find(result.check.run); result.check.parameters.level &&
                                                                   run != evaluation.usable.end() &&
                                                                   result.judgement.verdict != Verdict::error)
      json["runs"][run->first]["curves"][fmt::format("solid_level_{:g}", *result.check.parameters.level)] =
          json_curve(solid_level_curve(run->second, *result.check.parameters.level));
  for (const auto& [id, programs] : evaluation.peers)
    for (const Run& run : programs) json["peers"][id][run.id] = json_entry(run);
  return json.dump() + "\n";
}

}  // namespace granvof::compare
