// The scene's own scales: what every threshold of the solver is a share of.
//
// A threshold with a unit holds for one size of tank and one kind of grain; as a share of these scales it
// holds for every scene, in any units. This is the one place that says what small is measured by.
#pragma once

#include "solver/scene/scene.hpp"

namespace granvof {

// All > 0 for any scene that load_scene() accepts.
struct Scales {
  double length;    // height of the bed, else of the liquid, else of the tank [m]
  double velocity;  // sqrt(g length), of the fastest wall if that is faster, else length / time.end [m/s]
  double pressure;  // load of the bed: weight in the fluid it is lightest in, or inertia rho_s velocity^2
                    // where walls or nothing but the run's length set the velocity [Pa]
  double energy;    // 1/2 density velocity^2 of the whole tank, of the continuous phase [J]

  double time() const { return length / velocity; }  // sqrt(length / g) [s]; of a bed the unit "column"
};

Scales scales_of(const Scene& scene);

// Potential energy of the bed above its own base, as a box of its length and height, in the fluid that it is
// lightest in [J]; 0 without a bed.
double energy_of_bed(const Scene& scene);

}  // namespace granvof
