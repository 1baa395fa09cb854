// The energy budget's part of the solid pressure: contacts that store, and pressures of the flow.
#include "solver/closures/contact_pressure.hpp"
#include "solver/run/energy_budget.hpp"

namespace granvof {

double EnergyBudget::elastic(const Field& f_s, const Field& packing) const {
  const double *f = f_s.data(), *p = packing.data();
  const auto* energy = &elastic_energy_;
  return grid_.cell_volume *
         sum_over(grid_.cells, grid_.all_cells(), [=](std::ptrdiff_t c) { return (*energy)(f[c], p[c]); });
}

const Field& EnergyBudget::fraction_of_law(const State& now, const State& next) const {
  return scene_.numerics.contact_pressure == ContactPressure::implicit ? next.f_s : now.f_s;
}

// What Theta does not pay of it is `dense_excess` of the ledger.
double EnergyBudget::work_of_flow_pressure(double dt, const State& now, const State& next,
                                           const StepTrace& trace) const {
  const double *f = fraction_of_law(now, next).data(), *theta = now.theta.data(),
               *packing = trace.packing.data(), *e = trace.rheology.restitution.data(),
               *resting = trace.rheology.part_cells.resting.data(), *div = trace.strain.divergence.data();
  const Field& stress = trace.rheology.viscous_stress;
  const double* viscous = stress.empty() ? nullptr : stress.data();
  return dt * grid_.cell_volume *
         sum_over(grid_.cells, grid_.all_cells(), [=, law = trace.law](std::ptrdiff_t c) {
           const closures::GrainsOfCell cell{theta[c], e[c], resting[c], packing[c],
                                             viscous != nullptr ? viscous[c] : 0.0};
           if (theta[c] == 0.0 && resting[c] == 0.0 && cell.viscous_stress == 0.0) return 0.0;
           return (closures::flow_pressure(f[c], cell, law).value +
                   closures::viscous_pressure(f[c], cell, law).value) *
                  div[c];
         });
}

// The step's own: of the packing and, where it is explicit, of the f_s that it took the law at. What the
// contacts do not store of it is numerical_elastic of the ledger.
double EnergyBudget::work_of_contacts(double dt, const State& now, const State& next,
                                      const StepTrace& trace) const {
  const double *f = fraction_of_law(now, next).data(), *packing = trace.packing.data(),
               *div = trace.strain.divergence.data();
  const Contact contact = scene_.contact;
  return dt * grid_.cell_volume * sum_over(grid_.cells, grid_.all_cells(), [=](std::ptrdiff_t c) {
           return f[c] > packing[c] ? closures::elastic_pressure(f[c], contact, packing[c]).value * div[c]
                                    : 0.0;
         });
}

}  // namespace granvof
