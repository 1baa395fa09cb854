// Transport of the liquid: van Leer and interface compression, limited by MULES, on the flux of continuity.
#include "CMULES.H"
#include "reference/demvof/fluid/fluid_fields.hpp"

namespace demvof {

using namespace Foam;

void solve_interface(Fluid::Fields& f) {
  const fvMesh& mesh = f.mesh;
  volScalarField& alpha = f.alpha;
  const dimensionedScalar liquid("l", dimDensity, f.settings.liquid_density);
  const dimensionedScalar gas("g", dimDensity, f.settings.gas_density);

  // Compression acts along the interface normal with the local speed (factor 1), not across walls.
  const surfaceVectorField gradient(fvc::interpolate(fvc::grad(alpha)));
  const dimensionedScalar small("small", dimless / dimLength, 1e-8 / std::cbrt(f.cell_volume()));
  surfaceScalarField compression(mag(f.phi) * ((gradient / (mag(gradient) + small)) & mesh.Sf()) /
                                 mesh.magSf());
  surfaceScalarField::Boundary& sides = compression.boundaryFieldRef();
  forAll(sides, patch) sides[patch] == 0.0;

  surfaceScalarField liquid_flux(
      "alphaPhi",
      fvc::flux(f.phi, alpha, "div(phi,alpha)") +
          fvc::flux(-fvc::flux(-compression, 1.0 - alpha, "div(phirb,alpha)"), alpha, "div(phirb,alpha)"));
  MULES::explicitSolve(f.eps, alpha, f.phi, liquid_flux, oneField(), zeroField());

  f.rho_phi = liquid_flux * (liquid - gas) + f.phi * gas;
  f.rho = alpha * liquid + (1.0 - alpha) * gas;
  f.rho.correctBoundaryConditions();
}

}  // namespace demvof
