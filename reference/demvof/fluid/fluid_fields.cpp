#include "reference/demvof/fluid/fluid_fields.hpp"

#include "reference/demvof/fluid/box_mesh.hpp"

namespace demvof {

namespace {

using namespace Foam;

// OpenFOAM throws instead of ending the process, and keeps quiet.
std::string quiet(const std::string& path) {
  FatalError.throwExceptions();
  FatalIOError.throwExceptions();
  messageStream::level = 0;
  solverPerformance::debug = 0;
  return path;
}

// Patch types of a field by the kind of side.
struct PatchTypes {
  const char *no_slip, *slip, *open;
};

wordList patch_types(const FluidSettings& s, const PatchTypes& types) {
  wordList list(s.obstacles.empty() ? 6 : 7, types.no_slip);
  for (int side = 0; side < 6; ++side) {
    switch (s.sides[side]) {
      case FluidSide::no_slip:
        list[side] = types.no_slip;
        break;
      case FluidSide::slip:
        list[side] = types.slip;
        break;
      case FluidSide::open:
        list[side] = types.open;
        break;
      case FluidSide::empty:
        list[side] = "empty";
        break;
    }
  }
  return list;
}

const PatchTypes plain{"zeroGradient", "zeroGradient", "zeroGradient"};
const PatchTypes liquid_share{"zeroGradient", "zeroGradient", "inletOutlet"};
const PatchTypes velocity{"noSlip", "slip", "pressureInletOutletVelocity"};
const PatchTypes pressure{"fixedFluxPressure", "fixedFluxPressure", "totalPressure"};

IOobject named(const char* name, const fvMesh& mesh) {
  return {name, mesh.time().timeName(), mesh};
}

volScalarField scalar_field(const char* name, const fvMesh& mesh, const dimensionSet& dimensions,
                            const wordList& types) {
  return {named(name, mesh), mesh, dimensionedScalar(name, dimensions, 0.0), types};
}

template <typename Values>
volScalarField filled(const char* name, const fvMesh& mesh, const wordList& types, const labelList& places,
                      const Values& values) {
  volScalarField field(scalar_field(name, mesh, dimless, types));
  forAll(field, cell) field[cell] = values[static_cast<std::size_t>(places[cell])];
  field.correctBoundaryConditions();
  return field;
}

surfaceScalarField face_field(const char* name, const fvMesh& mesh, const dimensionSet& dimensions,
                              double value) {
  return {named(name, mesh), mesh, dimensionedScalar(name, dimensions, value)};
}

dictionary control() {
  dictionary dict;
  dict.add("startFrom", word("startTime"));
  dict.add("startTime", 0.0);
  dict.add("stopAt", word("endTime"));
  dict.add("endTime", 1e9);
  dict.add("deltaT", 1e-4);
  dict.add("writeControl", word("none"));
  dict.add("writeInterval", 1);
  return dict;
}

// From the top down, face by face, as the pressure equation balances it: what is written before the first
// step is then a pressure, and the first step does not ring. What obstacles cover has it from beside.
void start_from_hydrostatic_pressure(Fluid::Fields& f) {
  const label nx = f.settings.cells[0], ny = f.settings.cells[1];
  std::vector<char> known(static_cast<std::size_t>(f.mesh.nCells()), 0);
  DynamicList<label> row;  // cells whose pressure is known, in the order in which they hand it on
  const auto know = [&](label cell) {
    known[static_cast<std::size_t>(cell)] = 1;
    row.append(cell);
  };
  const auto is_known = [&](label cell) { return known[static_cast<std::size_t>(cell)] != 0; };
  const auto hand_on = [&](label from, label to) {
    const scalar face = 0.5 * (f.gh[to] + f.gh[from]);
    f.p_rgh[to] = f.p_rgh[from] + face * (f.rho[from] - f.rho[to]);
    know(to);
  };
  labelList cell_at(nx * ny * f.settings.cells[2], -1);
  forAll(f.places, cell) cell_at[f.places[cell]] = cell;
  for (label place = cell_at.size() - 1; place >= 0; --place) {
    if (cell_at[place] < 0) continue;
    if (place / nx % ny == ny - 1) {
      know(cell_at[place]);
    } else if (cell_at[place + nx] >= 0 && is_known(cell_at[place + nx])) {
      hand_on(cell_at[place + nx], cell_at[place]);
    }
  }
  if (row.empty()) know(0);
  if (row.size() == f.mesh.nCells()) return;
  const labelListList& beside = f.mesh.cellCells();
  for (label next = 0; next < row.size(); ++next) {
    const label from = row[next];
    for (const label to : beside[from]) {
      if (!is_known(to)) hand_on(from, to);
    }
  }
}

}  // namespace

Fluid::Fields::Fields(const FluidSettings& s, const std::vector<double>& alpha0,
                      const std::vector<double>& eps0)
    : settings(s),
      places(places_of_cells(s)),
      folder(quiet(s.scratch_folder)),
      time(control(), fileName(folder.parent()), fileName(folder.name()), "system", "constant", false, false),
      mesh_owner(make_box_mesh(s, time)),
      mesh(*mesh_owner),
      eps(filled("eps", mesh, patch_types(s, plain), places, eps0)),
      alpha(scalar_field("alpha", mesh, dimless, patch_types(s, liquid_share))),
      rho(scalar_field("rho", mesh, dimDensity, patch_types(s, plain))),
      U(named("U", mesh), mesh, dimensionedVector("U", dimVelocity, vector::zero), patch_types(s, velocity)),
      phi(face_field("phi", mesh, dimVolume / dimTime, 0.0)),
      rho_phi(face_field("rhoPhi", mesh, dimMass / dimTime, 0.0)),
      p_rgh(scalar_field("p_rgh", mesh, dimPressure, patch_types(s, pressure))),
      p_predicted(scalar_field("pPredicted", mesh, dimPressure, patch_types(s, pressure))),
      gh(named("gh", mesh), gravity() & mesh.C()),
      ghf(named("ghf", mesh), gravity() & mesh.Cf()),
      grad_p(named("gradP", mesh), mesh, dimensionedVector("0", dimPressure / dimLength, vector::zero)),
      drag(named("drag", mesh), mesh, dimensionedScalar("0", dimDensity / dimTime, 0.0)),
      force(named("force", mesh), mesh, dimensionedVector("0", dimForce / dimVolume, vector::zero),
            patch_types(s, plain)),
      open(face_field("open", mesh, dimless, 1.0)) {
  for (const FluidSide side : s.sides) closed = closed && side != FluidSide::open;
  // Zero at the middle of the top, as granvof has it.
  const vector middle_of_top(0.5 * s.cells[0] * s.spacing[0], s.cells[1] * s.spacing[1], 0.0);
  const dimensionedScalar top("top", dimAcceleration * dimLength, gravity().value() & middle_of_top);
  gh -= top;
  ghf -= top;
  U.boundaryFieldRef() == vector::zero;
  forAll(alpha, cell) alpha[cell] = of_cell(alpha0, cell);
  alpha.correctBoundaryConditions();
  rho = alpha * dimensionedScalar("l", dimDensity, s.liquid_density) +
        (1.0 - alpha) * dimensionedScalar("g", dimDensity, s.gas_density);
  rho.correctBoundaryConditions();
  start_from_hydrostatic_pressure(*this);
  eps.oldTime();
  alpha.oldTime();
  U.oldTime();
}

tmp<volScalarField> effective_viscosity(const Fluid::Fields& f) {
  const FluidSettings& s = f.settings;
  const dimensionedScalar liquid("l", dimPressure * dimTime, s.liquid_viscosity);
  const dimensionedScalar gas("g", dimPressure * dimTime, s.gas_viscosity);
  tmp<volScalarField> mu(f.alpha * liquid + (1.0 - f.alpha) * gas);
  if (s.large_eddy) {
    const bool flat = s.sides[4] == FluidSide::empty;
    const double size = flat ? std::sqrt(s.spacing[0] * s.spacing[1]) : std::cbrt(f.cell_volume());
    const dimensionedScalar length("length", dimLength, s.smagorinsky * size);
    mu.ref() += f.rho * sqr(length) * std::sqrt(2.0) * mag(symm(fvc::grad(f.U)));
  }
  return mu;
}

}  // namespace demvof
