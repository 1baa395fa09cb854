// Numerical derivatives for the tests of the closures.
#pragma once

namespace granvof::test {

// Central difference of fourth order; its error is about (step / scale of f)^4.
template <class Function>
double derivative(const Function& f, double x, double step) {
  return (8.0 * (f(x + step) - f(x - step)) - (f(x + 2.0 * step) - f(x - 2.0 * step))) / (12.0 * step);
}

}  // namespace granvof::test
