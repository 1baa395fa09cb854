// From a Scene to what the two sides of demvof need.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "reference/demvof/coupling/coupled_run.hpp"
#include "reference/demvof/preparation/column.hpp"
#include "solver/scene/scene.hpp"

namespace demvof {

// Throws granvof::CaseError for a scene without [reference], and for beads that LIGGGHTS does not accept.
void check_beads(const granvof::Scene& scene);

// The same, and for what else demvof does not compute, naming the key: a scene without a bed,
// periodic or moving walls, a sloping bed, beads larger than the
// fluid's cells, a slice thinner than two beads, obstacles that do not suit the fluid's cells.
void check_scene(const granvof::Scene& scene);

// Diameter of a bead: that of the grains, times reference.coarse_graining [m].
double bead_diameter(const granvof::Scene& scene);
// Step of the beads, the same share of their Rayleigh time (proportional to the diameter) at any size [s].
double bead_dt(const granvof::Scene& scene);
// Solid of so many beads over that of the bed at exactly reference.packing [-].
double solid_share(const granvof::Scene& scene, std::size_t beads);
double depth_of(const granvof::Scene& scene);  // of the slice, or of the tank in 3D [m]
FluidSettings fluid_settings(const granvof::Scene& scene, const std::string& scratch);
BeadSettings bead_settings(const granvof::Scene& scene, const std::string& scratch);
ColumnSettings column_settings(const granvof::Scene& scene, unsigned seed, const std::vector<double>& floor,
                               const std::string& scratch);
// Frozen beads of the rough floor, and of the upper sides of obstacles; none for a smooth one, or where the
// bed stands on neither.
std::vector<double> floor_beads(const granvof::Scene& scene, unsigned seed);
// Liquid share of each cell at the start [-].
std::vector<double> initial_alpha(const granvof::Scene& scene, const FluidSettings& fluid);
// The scene with demvof's grid in place of the solver's, for the output.
granvof::Scene with_reference_grid(const granvof::Scene& scene);

}  // namespace demvof
