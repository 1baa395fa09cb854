#include "compare/study/advise_scene.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "compare/checks/theory.hpp"
#include "compare/study/ablate.hpp"
#include "solver/scene/case_error.hpp"
#include "solver/scene/load_scene.hpp"
#include "solver/scene/presets.hpp"

namespace granvof::compare {
namespace {

std::vector<std::string> overrides_for(const AdviseInput& input, const Scene& scene,
                                       const Configuration& configuration) {
  std::vector<std::string> set = input.set;
  set.push_back(fmt::format("grid.dx={:.12g}", configuration.cell));
  set.insert(set.end(), configuration.method.set.begin(), configuration.method.set.end());
  for (const Part& part : configuration.without)
    for (const std::string& assignment : overrides_of(part, scene)) set.push_back(assignment);
  return set;
}

class SceneBench : public Bench {
 public:
  SceneBench(const AdviseInput& input, const Method& reference, const Scene& scene, Runner& runner)
      : input_(input), reference_(reference), scene_(scene), runner_(runner) {}

  void aim_at(const Target& target) { target_ = &target; }

  std::vector<std::string> set_of(const Configuration& configuration) {
    return overrides_for(input_, scene_, configuration);
  }

  Outcome outcome(const Configuration& configuration) {
    return runner_.run({input_.case_file, set_of(configuration)});
  }

  Trial trial(const Configuration& configuration) override {
    const Outcome made = outcome(configuration);
    Trial trial{std::nullopt, made.cost(), made.failure, made.noise};
    if (!made.run) return trial;
    const Observed observed = observe(input_.quantity, *made.run);
    trial.error = relative_distance(input_.quantity, observed, target_->observed);
    if (!trial.error)
      trial.failure = observed.defined() ? "not comparable with the reference" : observed.note;
    return trial;
  }

  std::optional<double> distance(const Configuration& a, const Configuration& b) override {
    const Outcome first = outcome(a);
    const Outcome second = outcome(b);
    if (!first.run || !second.run) return std::nullopt;
    return relative_distance(input_.quantity, observe(input_.quantity, *first.run),
                             observe(input_.quantity, *second.run));
  }

  bool is_reference(const Configuration& configuration) override {
    return target_->kind == kind_of_own && configuration.cell == input_.cells.back() &&
           configuration.method.name == reference_.name && configuration.without.empty();
  }

  std::optional<std::vector<std::string>> overrides(const Part& part) override {
    try {
      return overrides_of(part, scene_);
    } catch (const std::invalid_argument&) {
      return std::nullopt;
    }
  }

 private:
  const AdviseInput& input_;
  const Method& reference_;  // of our own finest grid
  const Scene& scene_;
  Runner& runner_;
  const Target* target_ = nullptr;
};

// Theory or a published series, from the chart's panels or the table of checks.
std::optional<Target> known_target(const AdviseInput& input, const Run& run) {
  for (const Panel& panel : input.panels) {
    if (panel.quantity.label() != input.quantity.label()) continue;
    if (panel.against == Against::theory) return theory_target(run, panel.formula);
    if (panel.against == Against::published) return published_target(run, panel.published, panel.column);
  }
  if (input.quantity.is_curve) return std::nullopt;
  for (const Check& check : input.checks) {
    const bool same =
        check.metric == input.quantity.name && check.parameters.at == input.quantity.parameters.at;
    if (!same || check.relation != Relation::equal) continue;
    if (check.reference.kind != ReferenceKind::theory && check.reference.kind != ReferenceKind::published)
      continue;
    if (check.reference.formula) return theory_target(run, *check.reference.formula);
    Target stated{std::string(name_of(check.reference.kind)),
                  check.reference.source,
                  {},
                  check.reference.band,
                  std::nullopt,
                  ""};
    if (!check.reference.value || *check.reference.value == 0.0) continue;  // no relative error of 0
    stated.observed.value = check.reference.value;
    stated.floor /= std::abs(*check.reference.value);
    return stated;
  }
  return std::nullopt;
}

// The method whose finest run is the reference of the paper's model: the panels', else the first.
const Method& reference_method(const AdviseInput& input, const std::vector<Method>& methods) {
  for (const Panel& panel : input.panels)
    for (const Method& method : methods)
      if (panel.against == Against::finest && panel.method == method.name) return method;
  for (const Method& method : methods)
    if (!method.other_model) return method;
  return methods.front();
}

bool makes_preset(const Method& method, const std::string& preset) {
  return method.set == std::vector<std::string>{"model.preset=" + preset};
}

// The method that stands for the model to advise on where only our own finest grid is a reference.
const Method& model_to_advise_on(const AdviseInput& input, const std::vector<Method>& methods,
                                 const Scene& scene) {
  std::string preset = preset_of(scene);
  if (!input.like.empty() && input.like.front().farthest <= near_factor) {
    const auto& errors = input.like.front().errors;
    preset = std::min_element(errors.begin(), errors.end(), [](const ModelError& a, const ModelError& b) {
               return a.highest < b.highest;
             })->preset;
  }
  for (const Method& method : methods)
    if (method.other_model && makes_preset(method, preset)) return method;
  return reference_method(input, methods);
}

std::vector<Method> methods_of_model(const std::vector<Method>& methods, const Method& model) {
  if (model.other_model) return {model};
  std::vector<Method> same = methods;
  std::erase_if(same, [](const Method& method) { return method.other_model; });
  return same;
}

// Each other model's result beside the chosen one's, on the next to finest cells.
void try_other_models(const std::vector<Method>& methods, const Method& model, const Method& paper,
                      SceneBench& bench, AdviseReport& report) {
  const double cell = report.input.cells[report.input.cells.size() - 2];
  report.others_cell = cell;
  std::vector<Method> others;
  if (model.other_model && !paper.other_model) others.push_back(paper);
  for (const Method& method : methods)
    if (method.other_model && method.name != model.name) others.push_back(method);
  const auto tried = [&](const Method& method) {
    const Outcome made = bench.outcome({cell, method, {}});
    OtherModel one{name_of(method), bench.distance({cell, method, {}}, {cell, model, {}}), made.failure,
                   method.preset};
    if (made.run) one.value = observe(report.input.quantity, *made.run).value;
    one.cost = made.cost();
    return one;
  };
  report.itself = tried(model);
  for (const Method& method : others) report.others.push_back(tried(method));
}

// Parts that a walk may leave out: what a choice beside the paper's model is worth is tried by methods that
// make it.
std::vector<Part> removable(const std::vector<Part>& parts) {
  std::vector<Part> kept = parts;
  std::erase_if(kept, [](const Part& part) { return part.form == Form::each_choice; });
  return kept;
}

Target choose_target(const AdviseInput& input, const Method& method, const Scene& scene, SceneBench& bench) {
  const auto wanted = [&](Against kind) { return input.against.value_or(kind) == kind; };
  Target dem = dem_target(input.quantity, scene, input.records, scene.name);
  if (wanted(Against::dem) && dem.observed.defined()) return dem;
  const Outcome coarse = bench.outcome({input.cells.front(), method, {}});
  if (coarse.run && (wanted(Against::theory) || wanted(Against::published))) {
    auto known = known_target(input, *coarse.run);
    if (known && known->observed.defined()) {
      known->cost = dem.cost;  // what the advice is set against, whatever the reference is
      return *known;
    }
  }
  if (!wanted(Against::finest)) throw std::runtime_error(fmt::format("no such reference: {}", dem.note));
  const Outcome finest = bench.outcome({input.cells.back(), method, {}});
  if (!finest.run)
    throw std::runtime_error(
        fmt::format("no reference: {}; no theory; and on the finest grid {}", dem.note, finest.failure));
  const Outcome next = bench.outcome({input.cells[input.cells.size() - 2], method, {}});
  Target own = own_target(input.quantity, *finest.run, name_of(method), next.run ? &*next.run : nullptr);
  if (!own.observed.defined()) throw std::runtime_error(fmt::format("no reference: {}", own.note));
  own.cost = dem.cost;
  return own;
}

}  // namespace

std::vector<double> cells_to_advise(const std::vector<double>& grids, const Scene& scene) {
  const double own = scene.grid.spacing[0];
  const double grain = scene.bed ? scene.solid.diameter : 0.0;
  std::vector<double> cells;
  for (const double cell :
       grids.empty() ? std::vector{4.0 * own, 2.0 * own, own, 0.5 * own, 0.25 * own} : grids)
    if (cell >= grain * (1.0 - 1e-9)) cells.push_back(cell);
  if (cells.empty()) cells.push_back(own * std::exp2(std::ceil(std::log2(grain / own) - 1e-9)));
  if (cells.size() == 1) cells.insert(cells.begin(), 2.0 * cells.front());
  return cells;
}

std::vector<std::vector<Job>> jobs_of(const AdviseInput& input, const std::vector<Method>& methods,
                                      const std::vector<Part>& parts) {
  const Scene scene = load_scene(input.case_file, input.set);
  std::vector<std::vector<Job>> jobs(input.cells.size());
  const auto add = [&](std::size_t grid, const Configuration& configuration) {
    try {
      jobs[grid].push_back({input.case_file, overrides_for(input, scene, configuration)});
    } catch (const std::invalid_argument&) {  // the part does not apply
    }
  };
  const std::size_t last = input.cells.size() - 1, of_parts = last > 1 ? last - 2 : 0;
  for (std::size_t i = 0; i < last; ++i)
    for (const Method& method : methods)
      if (i < method.grids.value_or(i + 1)) add(i, {input.cells[i], method, {}});
  for (const Part& part : removable(parts)) add(of_parts, {input.cells[of_parts], methods.front(), {part}});
  add(last, {input.cells[last], methods.front(), {}});
  return jobs;
}

std::vector<Method> with_presets(std::vector<Method> methods, const AdviseInput& input) {
  const auto resolved = [&](const std::vector<std::string>& set) {
    std::vector<std::string> all = input.set;
    all.insert(all.end(), set.begin(), set.end());
    try {
      return load_scene(input.case_file, all).resolved;
    } catch (const CaseError&) {  // not for this scene
      return std::string();
    }
  };
  for (const case_file::PresetEntry& entry : case_file::presets()) {
    const std::string made = resolved({"model.preset=" + entry.word});
    for (Method& method : methods)
      if (!made.empty() && resolved(method.set) == made) method.preset = entry.word;
  }
  return methods;
}

AdviseReport advise_scene(const AdviseInput& input, const std::vector<Method>& given,
                          const std::vector<Part>& parts, Runner& runner) {
  const Scene scene = load_scene(input.case_file, input.set);
  const std::vector<Method> methods = with_presets(given, input);
  const Method& paper = reference_method(input, methods);
  const Method& model = model_to_advise_on(input, methods, scene);
  SceneBench bench(input, model, scene, runner);
  AdviseReport report{scene.name, "", input, choose_target(input, model, scene, bench), {}, {}, ""};
  report.numbers = numbers_of(scene);
  report.preset = preset_of(load_scene(input.case_file, bench.set_of({input.cells.back(), model, {}})));
  bench.aim_at(report.target);
  if (report.target.floor > largest_floor * input.tolerance) {
    report.refusal = fmt::format(
        "cannot be told: the reference is itself uncertain by {:.2g} %, {:.2g} of the tolerance (at most "
        "{:g}); {}",
        100.0 * report.target.floor, report.target.floor / input.tolerance, largest_floor,
        report.target.kind == kind_of_own
            ? fmt::format("a finer last grid (--cells), or a tolerance of {:.2g} % or more",
                          100.0 * report.target.floor / largest_floor)
            : fmt::format("a tolerance of {:.2g} % or more can be",
                          100.0 * report.target.floor / largest_floor));
    return report;
  }
  std::vector<Method> tried = methods;
  if (report.target.kind == kind_of_own) {
    report.model = name_of(model);
    tried = methods_of_model(methods, model);
    try_other_models(methods, model, paper, bench, report);
  }
  report.advice = advise(input.cells, tried, removable(parts), input.tolerance, bench);
  if (!report.advice.chosen) return report;
  report.set = bench.set_of(report.advice.chosen->configuration);
  const Outcome chosen = bench.outcome(report.advice.chosen->configuration);
  report.observed = observe(input.quantity, *chosen.run);
  report.preset = preset_of(load_scene(input.case_file, report.set));
  report.version = chosen.facts->version;
  if (!chosen.facts->commit.empty()) report.version += fmt::format(" ({})", chosen.facts->commit);
  return report;
}

}  // namespace granvof::compare
