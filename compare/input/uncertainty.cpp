#include "compare/input/uncertainty.hpp"

#include <algorithm>
#include <array>

#include "compare/input/curves.hpp"

namespace granvof::compare {
namespace {

struct Entry {
  std::string_view quantity;
  std::string_view column;  // as in bands.json
  bool over_height;         // divided by the height of the column
};

// The front at f_s = 0.30 moves with the cells as the dense one does.
constexpr std::array table{
    Entry{"run_out", "front_dense [m]", true},
    Entry{"run_out_dense", "front_dense [m]", true},
    Entry{"run_out_quantile", "front_quantile [m]", true},
    Entry{"run_out_curve", "front_dense [m]", true},
    Entry{"run_out_dense_curve", "front_dense [m]", true},
    Entry{"run_out_quantile_curve", "front_quantile [m]", true},
    Entry{"front", "front_dense [m]", false},
    Entry{"grain_front", "front_dense [m]", false},
    Entry{"grain_front_curve", "front_dense [m]", false},
    Entry{"solid_height", "y_solid_mean [m]", false},
    Entry{"interface_height", "interface_height [m]", false},
    Entry{"base_pressure", "excess_base_pressure [Pa]", false},
    Entry{"base_pressure_curve", "excess_base_pressure [Pa]", false},
    Entry{"base_pressure_peak", "excess_base_pressure [Pa]", false},
};

}  // namespace

std::optional<double> record_uncertainty(std::string_view quantity, const Run& record, const Bands& bands) {
  const auto* entry =
      std::find_if(table.begin(), table.end(), [&](const Entry& e) { return e.quantity == quantity; });
  if (entry == table.end()) return std::nullopt;
  const auto band = bands.of(record.scene.name, entry->column);
  if (!band) return std::nullopt;
  return entry->over_height ? *band / column_of(record).height : *band;
}

}  // namespace granvof::compare
