// Size of the next time step.
#pragma once

#include "solver/closures/solid_pressure.hpp"
#include "solver/operators/mixture.hpp"
#include "solver/state/state.hpp"

namespace granvof {

class StepControl {
 public:
  // All three must outlive this.
  StepControl(const Grid& grid, const Scene& scene, const closures::SolidLaw& law);

  // Largest step allowed from state `s` [s]: convective Courant number, gate, dt_max and growth of at
  // most 1.2 over the last accepted step.
  double next(const State& s) const;
  // What the step becomes if `dt` was refused; below dt_min the run has to give up.
  double after_refusal(double dt) const;
  void accepted(double dt) { last_ = dt; }
  double last() const { return last_; }
  void restore(double last) { last_ = last; }

 private:
  const Grid& grid_;
  const Scene& scene_;
  const closures::SolidLaw& law_;
  double last_;
};

}  // namespace granvof
