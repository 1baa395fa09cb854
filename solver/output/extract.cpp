#include "solver/output/extract.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "solver/output/extract_bed.hpp"
#include "solver/output/extract_front.hpp"
#include "solver/output/extract_liquid.hpp"
#include "solver/output/extract_motion.hpp"
#include "solver/output/measures.hpp"

namespace granvof {

namespace {

using namespace scalar;

constexpr std::array table{
    ScalarEntry{"front_dense", "m",
                "the paper's run-out: largest x with f_s >= 0.95 f_s,min, from the wall x = 0", front_dense},
    ScalarEntry{"front_dense_mean", "m", "front_dense of each layer z = const, averaged over z",
                front_dense_mean},
    ScalarEntry{"front_dilute", "m", "largest x with f_s >= 0.30", front_dilute},
    ScalarEntry{"front_quantile", "m", "x left of which 99.5 % of the solid volume lies", front_quantile},
    ScalarEntry{"deposit_height", "m", "largest h(x), h = integral of f_s dy / f_s,min", deposit_height},
    ScalarEntry{"slope", "deg",
                "angle of the deposit's face towards +x, line through h(x) from 80 to 20 % of its largest",
                slope},
    ScalarEntry{"p_base", "Pa",
                "mean P_c at the centres of the lowest cells under the bed's initial base, on the floor or "
                "an obstacle",
                p_base},
    ScalarEntry{"y_c", "m", "centre of the cells with f_s > 0.95 f_s,min, eq (27)", y_c},
    ScalarEntry{"bed_bottom", "m",
                "lower edge of the dense bed (f_s >= 0.95 f_s,min), in the profile over its original columns",
                bed_bottom},
    ScalarEntry{"bed_top", "m", "upper edge of the dense bed, likewise", bed_top},
    ScalarEntry{"bed_height", "m", "H = bed_top - bed_bottom", bed_height},
    ScalarEntry{"bed_height_equivalent", "m", "solid of the profile over the mean f_s of its dense rows",
                bed_height_equivalent},
    ScalarEntry{"y_solid_mean", "m", "centre of mass of all solid", y_solid_mean},
    ScalarEntry{"interface_height", "m", "y_i: alpha = 0.5 in the profile over the whole tank",
                interface_height},
    ScalarEntry{"interface_height_outside", "m", "the same over the columns outside the bed's initial extent",
                interface_height_outside},
    ScalarEntry{"liquid_front", "m", "largest x with alpha >= 0.5 in the lowest row", liquid_front},
    ScalarEntry{"liquid_height_left", "m", "integral of alpha dy in the cells at x = 0", liquid_height_left},
    ScalarEntry{"liquid_height_right", "m", "integral of alpha dy in the cells at the far end",
                liquid_height_right},
    ScalarEntry{"solid_volume", "m3", "volume of all solid", solid_volume},
    ScalarEntry{"liquid_volume", "m3", "volume of all liquid", liquid_volume},
    ScalarEntry{"f_s_max", "-", "largest solid fraction", f_s_max},
    ScalarEntry{"f_s_min", "-", "smallest solid fraction", f_s_min},
    ScalarEntry{"u_s_max", "m/s", "largest solid speed where f_s >= 0.1 f_s,min", u_s_max},
    ScalarEntry{"u_s_dense_max", "m/s", "largest solid speed where f_s >= 0.95 f_s,min", u_s_dense_max},
    ScalarEntry{"u_c_max", "m/s", "largest speed of the continuous phase", u_c_max},
    ScalarEntry{"u_liquid_max", "m/s", "largest speed of the continuous phase where f_l > 0.5", u_liquid_max},
    ScalarEntry{"theta_max", "m2/s2", "largest granular temperature where f_s >= 0.1 f_s,min", theta_max},
    ScalarEntry{"kinetic_energy_solid", "J", "kinetic energy of the mean motion of the solid",
                kinetic_energy_solid},
    ScalarEntry{"kinetic_energy_liquid", "J", "kinetic energy of the liquid", kinetic_energy_liquid},
    ScalarEntry{"kinetic_energy_gas", "J", "kinetic energy of the gas", kinetic_energy_gas},
    ScalarEntry{"potential_energy_solid", "J", "potential energy of the solid above the floor",
                potential_energy_solid},
    ScalarEntry{"potential_energy_liquid", "J", "potential energy of the liquid above the floor",
                potential_energy_liquid},
    ScalarEntry{"potential_energy_gas", "J", "potential energy of the gas above the floor",
                potential_energy_gas},
};

}  // namespace

std::span<const ScalarEntry> scalar_table() {
  return table;
}

Scalars extract_scalars(const CellFields& fields, const Scene& scene) {
  check_fields(fields, scene);
  Scalars scalars;
  scalars.reserve(table.size());
  for (const auto& entry : table) scalars.push_back(entry.function(fields, scene));
  return scalars;
}

}  // namespace granvof
