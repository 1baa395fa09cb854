#include "compare/input/energy_budget.hpp"

#include <array>
#include <cmath>

namespace granvof::compare {
namespace {

struct Part {
  const char* name;
  const char* column;
  double sign;  // of the column in a sum of changes and losses that must vanish
};

constexpr std::array parts{Part{"kinetic", "energy_kinetic", 1.0},
                           Part{"potential", "energy_potential", 1.0},
                           Part{"granular", "energy_granular", 1.0},
                           Part{"elastic", "energy_elastic", 1.0},
                           Part{"drag", "lost_drag", 1.0},
                           Part{"friction", "lost_friction", 1.0},
                           Part{"viscosity", "lost_viscosity", 1.0},
                           Part{"collisions", "lost_collisions", 1.0},
                           Part{"outside", "lost_outflow", 1.0},
                           Part{"outside", "gained_walls", -1.0},
                           Part{"dilatancy", "gained_dilatancy", -1.0},
                           Part{"dilatancy", "gained_shear_dilatancy", -1.0},
                           Part{"numerical_time", "lost_numerical_time", 1.0},
                           Part{"numerical_momentum", "lost_numerical_momentum", 1.0},
                           Part{"numerical_volume", "lost_numerical_volume", 1.0},
                           Part{"numerical_stress", "lost_numerical_stress", 1.0},
                           Part{"numerical_granular", "lost_numerical_granular", 1.0}};

void accumulate(Curve& sum, const Curve& curve, double sign) {
  if (sum.empty()) sum = {curve.time, std::vector<double>(curve.time.size(), 0.0)};
  for (std::size_t i = 0; i < curve.time.size(); ++i)
    sum.value[i] += sign * (curve.value[i] - curve.value.front());
}

}  // namespace

std::map<std::string, Curve> energy_budget(const Run& run) {
  std::map<std::string, Curve> budget;
  for (const Part& part : parts) {
    const Curve curve = run.curve(part.column);
    if (curve.empty()) return {};
    accumulate(budget[part.name], curve, part.sign);
    accumulate(budget["open"], curve, part.sign);
    if (std::string_view(part.name).starts_with("numerical"))
      accumulate(budget["numerical"], curve, part.sign);
  }
  return budget;
}

std::optional<double> closure_error(const std::map<std::string, Curve>& budget,
                                    std::optional<double> turnover) {
  if (budget.empty() || !turnover || *turnover <= 0.0) return std::nullopt;
  double largest = 0.0;
  for (const double value : budget.at("open").value) largest = std::max(largest, std::abs(value));
  return largest / *turnover;
}

std::optional<double> numerical_share(const std::map<std::string, Curve>& budget,
                                      std::optional<double> turnover) {
  if (budget.empty() || !turnover || *turnover <= 0.0) return std::nullopt;
  return budget.at("numerical").value.back() / *turnover;
}

}  // namespace granvof::compare
