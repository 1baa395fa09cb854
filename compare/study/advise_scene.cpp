#include "compare/study/advise_scene.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "compare/checks/theory.hpp"
#include "compare/study/ablate.hpp"
#include "solver/scene/load_scene.hpp"

namespace granvof::compare {
namespace {

class SceneBench : public Bench {
 public:
  SceneBench(const AdviseInput& input, const Method& reference, const Scene& scene, Runner& runner)
      : input_(input), reference_(reference), scene_(scene), runner_(runner) {}

  void aim_at(const Target& target) { target_ = &target; }

  std::vector<std::string> set_of(const Configuration& configuration) {
    std::vector<std::string> set = input_.set;
    set.push_back(fmt::format("grid.dx={:.12g}", configuration.cell));
    set.insert(set.end(), configuration.method.set.begin(), configuration.method.set.end());
    for (const Part& part : configuration.without)
      for (const std::string& assignment : overrides_of(part, scene_)) set.push_back(assignment);
    return set;
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

const Method& reference_method(const AdviseInput& input, const std::vector<Method>& methods) {
  for (const Panel& panel : input.panels)
    for (const Method& method : methods)
      if (panel.against == Against::finest && panel.method == method.name) return method;
  return methods.front();
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
  Target own = own_target(input.quantity, *finest.run, method.name, next.run ? &*next.run : nullptr);
  if (!own.observed.defined()) throw std::runtime_error(fmt::format("no reference: {}", own.note));
  own.cost = dem.cost;
  return own;
}

}  // namespace

AdviseReport advise_scene(const AdviseInput& input, const std::vector<Method>& methods,
                          const std::vector<Part>& parts, Runner& runner) {
  const Scene scene = load_scene(input.case_file, input.set);
  const Method& reference = reference_method(input, methods);
  SceneBench bench(input, reference, scene, runner);
  AdviseReport report{scene.name, "", input, choose_target(input, reference, scene, bench), {}, {}};
  bench.aim_at(report.target);
  std::vector<Method> tried = methods;
  if (report.target.kind == kind_of_own)
    std::erase_if(tried, [](const Method& method) { return method.other_model; });
  // What a choice beside the paper's model is worth is tried by methods that make it.
  std::vector<Part> removable = parts;
  std::erase_if(removable, [](const Part& part) { return part.form == Form::each_choice; });
  report.advice = advise(input.cells, tried, removable, input.tolerance, bench);
  if (!report.advice.chosen) return report;
  report.set = bench.set_of(report.advice.chosen->configuration);
  const Outcome chosen = bench.outcome(report.advice.chosen->configuration);
  report.version = chosen.facts->version;
  if (!chosen.facts->commit.empty()) report.version += fmt::format(" ({})", chosen.facts->commit);
  return report;
}

}  // namespace granvof::compare
