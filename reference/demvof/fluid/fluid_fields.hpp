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

  Foam::dimensionedVector gravity() const {
    const double angle = settings.inclination * Foam::constant::mathematical::pi / 180.0;
    return {"g", Foam::dimAcceleration,
            settings.gravity * Foam::vector(std::sin(angle), -std::cos(angle), 0)};
  }
  double cell_volume() const { return settings.spacing[0] * settings.spacing[1] * settings.spacing[2]; }
};

// mu + mu_t [Pa s]: mixture viscosity and, with large_eddy, eq (10).
Foam::tmp<Foam::volScalarField> effective_viscosity(const Fluid::Fields& fields);

// One step of momentum and pressure: updates U, phi, p_rgh, grad_p, boundary_force. eps holds the new value.
void solve_momentum_and_pressure(Fluid::Fields& fields);

// The prediction of Fluid::predict_pressure_gradient.
Foam::tmp<Foam::volVectorField> predict_pressure_gradient(Fluid::Fields& fields, double dt,
                                                          const BeadInertia& beads);

// One step of the liquid: updates alpha, rho, rho_phi with the flux phi.
void solve_interface(Fluid::Fields& fields);

}  // namespace demvof
