// The OpenFOAM objects of one fluid, shared by the stages of its time step (momentum, pressure, interface).
#pragma once

#include <cmath>

#include "fvCFD.H"
#include "reference/demvof/fluid/case_folder.hpp"
#include "reference/demvof/fluid/fluid.hpp"

namespace demvof {

struct Fluid::Fields {
  // Of Fluid's constructor: settings, liquid share and void fraction at the start.
  Fields(const FluidSettings& s, const std::vector<double>& alpha0, const std::vector<double>& eps0);

  FluidSettings settings;
  Foam::labelList places;  // of the mesh's cells in the tank, see box_mesh.hpp
  CaseFolder folder;
  Foam::Time time;
  std::unique_ptr<Foam::fvMesh> mesh_owner;
  Foam::fvMesh& mesh;

  Foam::volScalarField eps;          // void fraction [-]
  Foam::volScalarField alpha;        // liquid share [-]
  Foam::volScalarField rho;          // density of the continuous phase [kg/m3]
  Foam::volVectorField U;            // velocity [m/s]
  Foam::surfaceScalarField phi;      // eps u . S [m3/s]
  Foam::surfaceScalarField rho_phi;  // mass flux of the last interface step [kg/s]
  Foam::volScalarField p_rgh;        // p - rho g.(x - x_top) [Pa]
  Foam::volScalarField p_predicted;  // the same, of the prediction for the beads [Pa]
  Foam::volScalarField gh;           // g.(x - x_top) [m2/s2]
  Foam::surfaceScalarField ghf;
  Foam::volVectorField grad_p;    // full pressure gradient, as the fluid felt it [Pa/m]
  Foam::volScalarField drag;      // K [kg/(m3 s)]
  Foam::volVectorField force;     // explicit force density of the beads [N/m3]
  Foam::surfaceScalarField open;  // share of a face that a gate leaves open [-]
  bool closed = true;             // no open side: the pressure level is free
  Vector boundary_force{};        // of the last step [N]
  FluidWork work;                 // of the last step [J]
  double kinetic_energy = 0.0;    // after it, with the mass before the liquid moved [J]

  Foam::dimensionedVector gravity() const {
    const double angle = settings.inclination * Foam::constant::mathematical::pi / 180.0;
    return {"g", Foam::dimAcceleration,
            settings.gravity * Foam::vector(std::sin(angle), -std::cos(angle), 0)};
  }
  // Value of a cell of the mesh among those of all cells of the tank.
  template <typename Values>
  auto& of_cell(Values& values, Foam::label cell) const {
    return values[static_cast<std::size_t>(places[cell])];
  }
  double cell_volume() const { return settings.spacing[0] * settings.spacing[1] * settings.spacing[2]; }
};

// mu + mu_t [Pa s]: mixture viscosity and, with large_eddy, eq (10).
Foam::tmp<Foam::volScalarField> effective_viscosity(const Fluid::Fields& fields);

// What a step of momentum and pressure did, as it was discretised.
struct MomentumStep {
  const Foam::volScalarField& inertia;           // mass that the new velocity has, over dt [kg/(m3 s)]
  const Foam::volScalarField& old_inertia;       // that the old one had
  const Foam::surfaceScalarField& weights;       // of the cells on the carried velocity of their face [-]
  const Foam::surfaceScalarField& viscosity;     // on faces [Pa s]
  const Foam::volVectorField& explicit_viscous;  // the part of the viscous force not in the matrix [N/m3]
  const Foam::volVectorField& drag;              // force density of the beads, all of it [N/m3]
};
// Works of the step that led from U.oldTime() to U, and the kinetic energy after it.
FluidWork work_of_step(const Fluid::Fields& fields, const MomentumStep& step);
double kinetic_energy(const Fluid::Fields& fields, const Foam::volScalarField& mass_density);

// One step of momentum and pressure: updates U, phi, p_rgh, grad_p, boundary_force, work,
// kinetic_energy. eps holds the new value.
void solve_momentum_and_pressure(Fluid::Fields& fields);

// The prediction of Fluid::predict_pressure_gradient.
Foam::tmp<Foam::volVectorField> predict_pressure_gradient(Fluid::Fields& fields, double dt,
                                                          const BeadInertia& beads);

// One step of the liquid: updates alpha, rho, rho_phi with the flux phi.
void solve_interface(Fluid::Fields& fields);

}  // namespace demvof
