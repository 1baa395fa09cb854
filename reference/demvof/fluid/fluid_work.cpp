// Where the kinetic energy of the fluid goes in a step, from the terms of its momentum equation
//   m (U - U_old) + dt (div(rho_phi U) - div(rho_phi) U_old) = dt (viscous + drag - eps grad p + eps rho g),
// m the mass that U_old had, times U.
#include "reference/demvof/fluid/fluid_fields.hpp"

namespace demvof {

namespace {

using namespace Foam;

// Integral of one field times U over the tank.
double power(const Fluid::Fields& f, const vectorField& force) {
  return f.cell_volume() * sum(f.U.primitiveField() & force);
}

}  // namespace

double kinetic_energy(const Fluid::Fields& f, const volScalarField& mass_density) {
  return 0.5 * f.cell_volume() * sum(mass_density.primitiveField() * magSqr(f.U.primitiveField()));
}

FluidWork work_of_step(const Fluid::Fields& f, const MomentumStep& step) {
  const double dt = f.time.deltaTValue(), volume = f.cell_volume();
  FluidWork work;
  work.drag = dt * power(f, step.drag.primitiveField());
  const scalarField& eps = f.eps.primitiveField();
  work.pressure = -dt * power(f, eps * f.grad_p.primitiveField());
  work.gravity = dt * power(f, eps * f.rho.primitiveField() * f.gravity().value());
  const volVectorField viscous(fvc::laplacian(step.viscosity, f.U) + step.explicit_viscous);
  work.viscosity = -dt * power(f, viscous.primitiveField());
  const vectorField change(f.U.primitiveField() - f.U.oldTime().primitiveField());
  work.numerical_time = 0.5 * dt * volume * sum(step.old_inertia.primitiveField() * magSqr(change));

  forAll(f.mesh.boundary(), patch) {
    if (f.mesh.boundary()[patch].type() == "empty") continue;
    work.outflow += 0.5 * dt * sum(f.rho_phi.boundaryField()[patch] * magSqr(f.U.boundaryField()[patch]));
  }
  // Convection of momentum beyond that of 1/2 U^2 with the mass.
  const volVectorField convected(
      fvc::surfaceIntegrate(f.rho_phi * surfaceInterpolationScheme<vector>::interpolate(f.U, step.weights)));
  const scalarField mass_lost((step.old_inertia - step.inertia)().primitiveField());
  work.numerical_momentum = dt * (power(f, convected.primitiveField()) -
                                  0.5 * volume * sum(mass_lost * magSqr(f.U.primitiveField()))) -
                            work.outflow;
  return work;
}

}  // namespace demvof
