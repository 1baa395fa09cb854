#include "reference/demvof/fluid/fluid.hpp"

#include <stdexcept>

#include "reference/demvof/fluid/fluid_fields.hpp"

namespace demvof {

namespace {

using namespace Foam;

std::string message_of(const error& problem) {
  return "OpenFOAM: " + std::string(problem.message());
}

}  // namespace

Fluid::Fluid(const FluidSettings& settings, const std::vector<double>& alpha,
             const std::vector<double>& void_fraction) {
  try {
    fields_ = std::make_unique<Fields>(settings, alpha, void_fraction);
  } catch (const error& problem) {
    throw std::runtime_error(message_of(problem));
  }
  Fields& f = *fields_;
  // Until the first step the beads feel the hydrostatic gradient.
  f.grad_p = f.rho * f.gravity();
  refresh_view();
}

Fluid::~Fluid() = default;

double Fluid::time() const {
  return fields_->time.value();
}

void Fluid::set_gate(int face, const std::vector<double>& open) {
  Fields& f = *fields_;
  f.open.primitiveFieldRef() = 1.0;
  if (open.empty()) return;
  const int nx = f.settings.cells[0], ny = f.settings.cells[1];
  const labelList& owner = f.mesh.owner();
  const labelList& neighbour = f.mesh.neighbour();
  forAll(owner, i) {
    const label left = f.places[owner[i]], right = f.places[neighbour[i]];
    if (right == left + 1 && nx > 1 && left % nx == face - 1) {
      f.open[i] = open[static_cast<std::size_t>((left / nx) % ny)];
    }
  }
}

void Fluid::step(double dt, const BeadLoad& load) {
  Fields& f = *fields_;
  try {
    f.time.setDeltaT(dt);
    ++f.time;
    // The first write access of the new time index keeps the old value; without it eps would have no past.
    f.eps.oldTime();
    f.U.oldTime();
    f.alpha.oldTime();
    scalarField& eps = f.eps.primitiveFieldRef();
    forAll(eps, cell) {
      eps[cell] = f.of_cell(load.void_fraction, cell);
      f.drag[cell] = f.of_cell(load.drag_coefficient, cell);
      f.force[cell] = vector(f.of_cell(load.force[0], cell), f.of_cell(load.force[1], cell),
                             f.of_cell(load.force[2], cell));
    }
    f.eps.correctBoundaryConditions();
    f.force.correctBoundaryConditions();
    solve_momentum_and_pressure(f);
    solve_interface(f);
  } catch (const error& problem) {
    throw std::runtime_error(message_of(problem));
  }
  boundary_force_ = f.boundary_force;
  for (double FluidWork::*part :
       {&FluidWork::drag, &FluidWork::pressure, &FluidWork::gravity, &FluidWork::viscosity,
        &FluidWork::outflow, &FluidWork::numerical_time, &FluidWork::numerical_momentum})
    work_.*part += f.work.*part;
  refresh_view();
  if (!std::isfinite(largest_speed()) || !std::isfinite(liquid_volume())) {
    throw std::runtime_error("the fluid blew up (a value is not finite)");
  }
}

std::array<std::vector<double>, 3> Fluid::predict_pressure_gradient(double dt, const BeadInertia& beads) {
  try {
    const volVectorField gradient(demvof::predict_pressure_gradient(*fields_, dt, beads));
    std::array<std::vector<double>, 3> values;
    for (int d = 0; d < 3; ++d) {
      values[d].resize(beads.drag_coefficient.size());
      forAll(gradient, cell) {
        fields_->of_cell(values[d], cell) = gradient[cell][static_cast<direction>(d)];
      }
    }
    return values;
  } catch (const error& problem) {
    throw std::runtime_error(message_of(problem));
  }
}

void Fluid::refresh_view() {
  const Fields& f = *fields_;
  std::size_t n = 1;
  for (const int cells : f.settings.cells) n *= static_cast<std::size_t>(cells);
  view_.alpha.resize(n);
  view_.pressure.resize(n);
  for (int d = 0; d < 3; ++d) {
    view_.velocity[d].resize(n);
    view_.pressure_gradient[d].resize(n);
  }
  forAll(f.places, cell) {
    f.of_cell(view_.alpha, cell) = f.alpha[cell];
    f.of_cell(view_.pressure, cell) = f.p_rgh[cell] + f.rho[cell] * f.gh[cell];
    for (int d = 0; d < 3; ++d) {
      f.of_cell(view_.velocity[d], cell) = f.U[cell][static_cast<direction>(d)];
      f.of_cell(view_.pressure_gradient[d], cell) = f.grad_p[cell][static_cast<direction>(d)];
    }
  }

  courant_ = courant_liquid_ = 0.0;
  const scalarField flux(fvc::surfaceSum(mag(f.phi))().primitiveField());
  forAll(f.places, cell) {
    const double rate = 0.5 * flux[cell] / (f.eps[cell] * f.cell_volume());
    courant_ = std::max(courant_, rate);
    if (f.alpha[cell] > 1e-3) courant_liquid_ = std::max(courant_liquid_, rate);
  }
}

double Fluid::liquid_volume() const {
  const Fields& f = *fields_;
  return f.cell_volume() * sum(f.eps.primitiveField() * f.alpha.primitiveField());
}

Vector Fluid::momentum() const {
  const Fields& f = *fields_;
  const vector total = f.cell_volume() * sum(f.eps.oldTime().primitiveField() *
                                             f.rho.oldTime().primitiveField() * f.U.primitiveField());
  return {{total.x(), total.y(), total.z()}};
}

double Fluid::kinetic_energy() const {
  return fields_->kinetic_energy;
}

double Fluid::potential_energy() const {
  const Fields& f = *fields_;
  const vector gravity = f.gravity().value();
  return -f.cell_volume() *
         sum(f.eps.primitiveField() * f.rho.primitiveField() * (f.mesh.C().primitiveField() & gravity));
}

double Fluid::largest_speed() const {
  return max(mag(fields_->U.primitiveField()));
}

}  // namespace demvof
