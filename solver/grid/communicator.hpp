// Exchange of ghost values and global reductions: the one place where a distributed grid would differ.
//
// The serial communicator only joins the ends of periodic directions. A distributed one fills every ghost
// layer that another process owns and reduces over all processes; kernels do not change.
#pragma once

#include "solver/grid/layout.hpp"

namespace granvof {

class Communicator {
 public:
  virtual ~Communicator() = default;
  // Fill the ghost layers that belong to a neighbour (here: the opposite end of a periodic direction).
  virtual void exchange(const Layout& layout, double* values) const = 0;
  virtual void exchange(const Layout& layout, float* values) const = 0;
  virtual double sum(double local) const = 0;
  virtual double max(double local) const = 0;
};

class SerialCommunicator final : public Communicator {
 public:
  void exchange(const Layout& layout, double* values) const override;
  void exchange(const Layout& layout, float* values) const override;
  double sum(double local) const override { return local; }
  double max(double local) const override { return local; }
};

}  // namespace granvof
