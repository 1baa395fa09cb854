#include "compare/engine/work_unit.hpp"

#include <ctime>
#include <stdexcept>
#include <vector>

namespace granvof::compare {
namespace {

constexpr int side = 256;
constexpr long updates_of_a_unit = 100'000'000;

// One damped Jacobi sweep of the interior.
void sweep(const std::vector<double>& from, std::vector<double>& to) {
  for (int j = 1; j < side - 1; ++j) {
    const double* row = from.data() + j * side;
    double* out = to.data() + j * side;
    for (int i = 1; i < side - 1; ++i)
      out[i] = 0.2 * row[i] + 0.2 * (row[i - 1] + row[i + 1] + row[i - side] + row[i + side]);
  }
}

}  // namespace

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double work_unit_seconds() {
  std::vector<double> a(side * side, 0.0), b(side * side, 0.0);
  for (int i = 0; i < side; ++i) a[i] = b[i] = 1.0;  // one warm edge, so that the field is not constant
  const long sweeps = updates_of_a_unit / ((side - 2) * (side - 2));
  const double begin = thread_seconds();
  for (long n = 0; n < sweeps / 2; ++n) {
    sweep(a, b);
    sweep(b, a);
  }
  const double seconds = thread_seconds() - begin;
  // Used, so that no compiler drops the sweeps; heat only spreads, so the field stays within its edges.
  if (!(a[side + 1] > 0.0 && a[side + 1] <= 1.0)) throw std::logic_error("the calibration kernel went wrong");
  return seconds;
}

}  // namespace granvof::compare
