// Momentum with implicit drag, and the pressure that gives the flux its divergence -d(eps)/dt.
#include "constrainHbyA.H"
#include "constrainPressure.H"
#include "gaussConvectionScheme.H"
#include "reference/demvof/fluid/fluid_fields.hpp"

namespace demvof {

namespace {

using namespace Foam;

constexpr int pressure_corrections = 2;

tmp<surfaceInterpolationScheme<vector>> convection_scheme(const Fluid::Fields& f) {
  IStringStream name(f.settings.convection == MomentumConvection::van_leer ? "vanLeerV" : "upwind");
  return surfaceInterpolationScheme<vector>::New(f.mesh, f.rho_phi, name);
}

// Force of the boundary on the fluid: pressure on the patches, friction, momentum carried through the top,
// and the pressure jump that a gate carries.
Vector force_of_boundary(const Fluid::Fields& f, const volScalarField& mu,
                         const surfaceScalarField& gate_jump) {
  vector total = vector::zero;
  forAll(f.mesh.boundary(), patch) {
    if (f.mesh.boundary()[patch].type() == "empty") continue;
    const fvPatch& p = f.mesh.boundary()[patch];
    // The pressure on the face: reached from the cell by half a step of the same face gradient.
    const scalarField pressure(f.p_rgh.boundaryField()[patch] +
                               f.rho.boundaryField()[patch] * f.ghf.boundaryField()[patch]);
    total -= sum(pressure * p.Sf());
    total += sum(f.eps.boundaryField()[patch] * mu.boundaryField()[patch] * p.magSf() *
                 f.U.boundaryField()[patch].snGrad());
    total -= sum(f.rho_phi.boundaryField()[patch] * f.U.boundaryField()[patch]);
  }
  forAll(gate_jump, face) {
    if (f.open[face] < 1.0) total += gate_jump[face] * f.mesh.Sf()[face];
  }
  return {{total.x(), total.y(), total.z()}};
}

}  // namespace

void solve_momentum_and_pressure(Fluid::Fields& f) {
  const fvMesh& mesh = f.mesh;
  const dimensionedScalar dt("dt", dimTime, f.time.deltaTValue());
  const volVectorField& U_old = f.U.oldTime();
  // Inertia of what the last interface step left behind; its mass flux belongs to the same eps and alpha, so
  // that momentum is carried without gain or loss.
  const volScalarField inertia(f.eps.oldTime() * f.rho / dt);
  const volScalarField mu(effective_viscosity(f));
  const surfaceScalarField mu_face(fvc::interpolate(f.eps * mu) * f.open);

  const volScalarField old_inertia(inertia + fvc::div(f.rho_phi));
  const volVectorField transposed(fvc::div(f.eps * mu * dev2(T(fvc::grad(f.U))), "div(viscous)"));

  const tmp<surfaceInterpolationScheme<vector>> convection(convection_scheme(f));
  // A limiter looks at the velocity before the step; the step's ledger has to weigh as the step did.
  const surfaceScalarField weights(convection().weights(f.U));
  fvVectorMatrix equation(
      fvm::Sp(inertia, f.U) +
          fv::gaussConvectionScheme<vector>(mesh, f.rho_phi, convection).fvmDiv(f.rho_phi, f.U) -
          fvm::laplacian(mu_face, f.U) + fvm::Sp(f.drag, f.U) ==
      old_inertia * U_old + f.drag * U_old + transposed);

  const volScalarField rAU(1.0 / equation.A());
  const surfaceScalarField eps_face(fvc::interpolate(f.eps));
  const surfaceScalarField coefficient("Dp", eps_face * fvc::interpolate(rAU * f.eps));
  const volScalarField swelling((f.eps - f.eps.oldTime()) / dt);
  // The beads' force acts on the faces, as gravity does: were it left in the cells, the pressure at a wall
  // would not balance it, and the cells beside the wall would feel half of the gradient.
  const surfaceScalarField bead_pull((fvc::interpolate(f.force) & mesh.Sf()) / eps_face);
  surfaceScalarField gate_jump("gateJump", 0.0 * f.ghf * fvc::interpolate(f.rho));

  for (int correction = 0; correction < pressure_corrections; ++correction) {
    const volVectorField HbyA(constrainHbyA(rAU * equation.H(), f.U, f.p_rgh));
    const surfaceScalarField inertial_flux(eps_face * fvc::flux(HbyA));
    const surfaceScalarField buoyancy(-f.ghf * fvc::snGrad(f.rho) * mesh.magSf());
    surfaceScalarField flux("phiHbyA", f.open * (inertial_flux + coefficient * (buoyancy + bead_pull)));
    constrainPressure(f.p_rgh, f.U, flux, coefficient);

    const surfaceScalarField open_coefficient("DpOpen", coefficient * f.open);
    fvScalarMatrix pressure(fvm::laplacian(open_coefficient, f.p_rgh) == fvc::div(flux) + swelling);
    if (f.closed) pressure.setReference(0, 0.0);
    const bool last = correction == pressure_corrections - 1;
    pressure.solve(mesh.solver(last ? "p_rghFinal" : "p_rgh"));
    f.phi = flux - pressure.flux();

    // Where a gate stands, the face carries what stops the flux, on the closed share of the face.
    const surfaceScalarField through(buoyancy - fvc::snGrad(f.p_rgh) * mesh.magSf());
    const surfaceScalarField stopped(-inertial_flux / coefficient - bead_pull);
    const surfaceScalarField pull(f.open * through + (1.0 - f.open) * stopped);
    const volVectorField reconstructed(fvc::reconstruct(pull));
    f.U = HbyA + rAU * f.eps * (reconstructed + fvc::reconstruct(bead_pull));
    f.U.correctBoundaryConditions();
    f.grad_p.primitiveFieldRef() =
        f.rho.primitiveField() * f.gravity().value() - reconstructed.primitiveField();
    gate_jump = (pull - through) / mesh.magSf() / mesh.deltaCoeffs();
  }
  f.boundary_force = force_of_boundary(f, mu, gate_jump);
  const volVectorField drag(f.eps * fvc::reconstruct(bead_pull) - f.drag * (f.U - U_old));
  f.work = work_of_step(f, {inertia, old_inertia, weights, mu_face, transposed, drag});
  f.kinetic_energy = kinetic_energy(f, inertia * dt);
}

}  // namespace demvof
