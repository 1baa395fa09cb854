// The pressure that light beads will feel: one projection of fluid and beads together, drag implicit on both.
//
//   eps rho (u' - u)/dt     = -eps (grad p - rho g)       + K (v' - u')
//   f_s rho_s (v' - v)/dt   = -f_s (grad p - rho_s g) + F - K (v' - u')
//   div(eps u' + f_s v') = 0
// Solved for u', v' by the 2x2 of each cell; grad p then enters with the coefficient D below.
#include "constrainPressure.H"
#include "reference/demvof/fluid/fluid_fields.hpp"

namespace demvof {

namespace {

using namespace Foam;

constexpr double least_fraction = 1e-6;  // keeps the 2x2 regular where there are no beads

}  // namespace

tmp<volVectorField> predict_pressure_gradient(Fluid::Fields& f, double dt, const BeadInertia& beads) {
  const fvMesh& mesh = f.mesh;
  const dimensionedScalar time("dt", dimTime, dt);
  const dimensionedScalar density("rho_s", dimDensity, beads.density);
  volVectorField velocity("beadVelocity", f.U);
  volVectorField force("beadForce", f.force);
  volScalarField drag("beadDrag", f.drag);
  forAll(velocity, cell) {
    velocity[cell] = vector(f.of_cell(beads.velocity[0], cell), f.of_cell(beads.velocity[1], cell),
                            f.of_cell(beads.velocity[2], cell));
    force[cell] = vector(f.of_cell(beads.force[0], cell), f.of_cell(beads.force[1], cell),
                         f.of_cell(beads.force[2], cell));
    drag[cell] = f.of_cell(beads.drag_coefficient, cell);
  }
  velocity.correctBoundaryConditions();
  force.correctBoundaryConditions();
  drag.correctBoundaryConditions();

  const volScalarField f_s(max(1.0 - f.eps, least_fraction));
  const volScalarField a_f(f.eps * f.rho / time), a_s(f_s * density / time);
  const volScalarField determinant(a_f * a_s + drag * (a_f + a_s));
  // Share of a force on the fluid, on the beads, that becomes volume flux of the mixture.
  const volScalarField of_fluid((f.eps * (a_s + drag) + f_s * drag) / determinant);
  const volScalarField of_beads((f_s * (a_f + drag) + f.eps * drag) / determinant);
  const volScalarField mobility(of_fluid * f.eps + of_beads * f_s);

  const surfaceScalarField coefficient("Dp", fvc::interpolate(mobility));
  const volVectorField carried(of_fluid * a_f * f.U + of_beads * a_s * velocity);
  surfaceScalarField inertial_flux(fvc::flux(carried));
  surfaceScalarField::Boundary& sides = inertial_flux.boundaryFieldRef();
  forAll(sides, patch) {
    if (isA<fixedValueFvPatchVectorField>(f.U.boundaryField()[patch])) sides[patch] == 0.0;
  }
  // Forces beside -grad p_rgh: buoyancy of the fluid, weight of the beads beyond the fluid they displace.
  const surfaceScalarField buoyancy(-f.ghf * fvc::snGrad(f.rho) * mesh.magSf());
  const volVectorField beyond(of_beads * (f_s * (density - f.rho) * f.gravity() + force));
  const surfaceScalarField body(fvc::interpolate(beyond) & mesh.Sf());
  surfaceScalarField flux("phiHbyA", f.open * (inertial_flux + coefficient * buoyancy + body));
  f.p_predicted == f.p_rgh;
  constrainPressure(f.p_predicted, f.U, flux, coefficient);
  const surfaceScalarField open_coefficient("DpOpen", coefficient * f.open);
  fvScalarMatrix pressure(fvm::laplacian(open_coefficient, f.p_predicted) == fvc::div(flux));
  if (f.closed) pressure.setReference(0, 0.0);
  pressure.solve();

  const surfaceScalarField through(buoyancy - fvc::snGrad(f.p_predicted) * mesh.magSf());
  const surfaceScalarField stopped(-(inertial_flux + body) / coefficient);
  const surfaceScalarField pull(f.open * through + (1.0 - f.open) * stopped);
  return f.rho * f.gravity() - fvc::reconstruct(pull);
}

}  // namespace demvof
