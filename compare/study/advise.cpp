#include "compare/study/advise.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

namespace granvof::compare {
namespace {

constexpr double share_of_a_part = 0.25;  // of the tolerance, that one part may move the result by
constexpr double least_saving = 0.1;      // of the cost, that makes it worth to leave a part out

class Walk {
 public:
  Walk(const std::vector<double>& cells, const std::vector<Method>& methods, const std::vector<Part>& parts,
       double tolerance, Bench& bench)
      : cells_(cells), methods_(methods), parts_(parts), tolerance_(tolerance), bench_(bench) {}

  Advice go() {
    for (std::size_t i = 0; i + 1 < cells_.size() && !advice_.chosen; ++i) {
      for (const Step& candidate : within_tolerance(i)) {
        if (!confirm(candidate, i)) continue;
        leave_parts_out(i);
        break;
      }
    }
    return advice_;
  }

 private:
  Step& attempt(const Configuration& configuration) {
    advice_.steps.push_back({configuration, bench_.trial(configuration), ""});
    Step& step = advice_.steps.back();
    if (!step.trial.error) step.remark = step.trial.failure;
    return step;
  }

  static bool saves(const Trial& trial, const Trial& full) {
    return trial.cost <= full.cost * (1.0 - std::max(least_saving, trial.noise + full.noise));
  }

  bool meets(const Trial& trial) const { return trial.error && *trial.error <= tolerance_; }

  // The full model by all methods on one grid; those that meet the tolerance, the cheapest first, or those of
  // them that cost the same within the noise in the study's order.
  std::vector<Step> within_tolerance(std::size_t grid) {
    std::vector<Step> found;
    for (const Method& method : methods_) {
      if (grid >= method.grids.value_or(grid + 1)) continue;
      Step& step = attempt({cells_[grid], method, {}});
      if (step.trial.error) step.remark = meets(step.trial) ? "within the tolerance" : "beyond the tolerance";
      if (meets(step.trial)) found.push_back(step);
    }
    const auto by_cost = [](const Step& a, const Step& b) { return a.trial.cost < b.trial.cost; };
    if (found.empty()) return found;
    const Trial cheapest = std::min_element(found.begin(), found.end(), by_cost)->trial;
    const auto dearer = std::stable_partition(found.begin(), found.end(), [&](const Step& step) {
      return step.trial.cost <= cheapest.cost * (1.0 + std::max(cheapest.noise, step.trial.noise));
    });
    std::stable_sort(dearer, found.end(), by_cost);
    std::stable_partition(found.begin(), found.end(), [&](const Step& step) {
      return !bench_.is_reference(finer(step.configuration, grid));
    });
    return found;
  }

  Configuration finer(Configuration configuration, std::size_t grid) const {
    configuration.cell = cells_[grid + 1];
    return configuration;
  }

  // Takes `candidate` as the answer if the next finer grid bears it out.
  bool confirm(const Step& candidate, std::size_t grid) {
    const Configuration witness = finer(candidate.configuration, grid);
    Step& step = attempt(witness);
    const auto moved = bench_.distance(candidate.configuration, witness);
    const std::string name = name_of(candidate.configuration);
    if (!step.trial.error || !moved) {
      step.remark = fmt::format("does not confirm {}: {}", name, step.trial.failure);
      return false;
    }
    const bool confirmed = meets(step.trial) && *moved <= tolerance_;
    step.remark = fmt::format("{} {}, {:.2g} % from it{}", confirmed ? "confirms" : "does not confirm", name,
                              100.0 * *moved,
                              bench_.is_reference(witness) ? "; not independent: it is the reference" : "");
    if (!confirmed) return false;
    advice_.chosen = candidate;
    advice_.confirmation = step;
    advice_.moved = moved;
    return true;
  }

  struct Screened {
    Part part;
    double moved;  // relative
    double cost;
    std::set<std::string> keys;
  };

  // Parts that alone move the result little and save something.
  std::vector<Screened> screen(std::size_t grid) {
    if (parts_.empty()) return {};
    const Configuration full{cells_[grid > 0 ? grid - 1 : grid], advice_.chosen->configuration.method, {}};
    const Trial with_all = bench_.trial(full);
    std::vector<Screened> found;
    for (const Part& part : parts_) {
      const auto overrides = bench_.overrides(part);
      if (!overrides) continue;
      Configuration without = full;
      without.without = {part};
      Step& step = attempt(without);
      const auto moved = bench_.distance(without, full);
      if (!step.trial.error || !moved) continue;
      const double saved = 1.0 - step.trial.cost / with_all.cost;
      const double noise = step.trial.noise + with_all.noise;
      const bool may_go = *moved <= share_of_a_part * tolerance_ && saves(step.trial, with_all);
      step.remark = fmt::format("moves the result by {:.2g} %, saves {:.0f} % (noise {:.0f} %): {}",
                                100.0 * *moved, 100.0 * saved, 100.0 * noise, may_go ? "may go" : "stays");
      if (!may_go) continue;
      std::set<std::string> keys;
      for (const std::string& assignment : *overrides)
        keys.insert(assignment.substr(0, assignment.find('=')));
      found.push_back({part, *moved, step.trial.cost, std::move(keys)});
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Screened& a, const Screened& b) { return a.cost < b.cost; });
    // Of two on the same key the cheaper one.
    std::set<std::string> taken;
    std::vector<Screened> kept;
    for (Screened& one : found) {
      const bool clash = std::any_of(one.keys.begin(), one.keys.end(),
                                     [&](const std::string& key) { return taken.contains(key); });
      if (clash) continue;
      taken.insert(one.keys.begin(), one.keys.end());
      kept.push_back(std::move(one));
    }
    return kept;
  }

  void leave_parts_out(std::size_t grid) {
    const Step full = *advice_.chosen;
    std::vector<Screened> gone = screen(grid);
    while (!gone.empty()) {
      Configuration reduced = full.configuration;
      for (const Screened& one : gone) reduced.without.push_back(one.part);
      Step& step = attempt(reduced);
      const bool cheaper = saves(step.trial, full.trial);
      if (step.trial.error)
        step.remark = !meets(step.trial) ? "beyond the tolerance"
                      : cheaper          ? "within the tolerance"
                                         : "saves nothing";
      if (meets(step.trial) && cheaper) {
        const Step candidate = step;
        if (confirm(candidate, grid)) return;
      }
      gone.erase(std::max_element(gone.begin(), gone.end(),
                                  [](const Screened& a, const Screened& b) { return a.moved < b.moved; }));
    }
  }

  const std::vector<double>& cells_;
  const std::vector<Method>& methods_;
  const std::vector<Part>& parts_;
  double tolerance_;
  Bench& bench_;
  Advice advice_;
};

}  // namespace

std::string name_of(const Method& method) {
  const std::string preset = "preset " + method.preset;
  return method.preset.empty() || method.name == preset ? method.name
                                                        : fmt::format("{} ({})", preset, method.name);
}

std::string name_of(const Configuration& configuration) {
  std::string name = fmt::format("{} on {:.4g} mm", name_of(configuration.method), 1e3 * configuration.cell);
  for (const Part& part : configuration.without) name += ", " + part.name;
  return name;
}

Advice advise(const std::vector<double>& cells, const std::vector<Method>& methods,
              const std::vector<Part>& parts, double tolerance, Bench& bench) {
  return Walk(cells, methods, parts, tolerance, bench).go();
}

}  // namespace granvof::compare
