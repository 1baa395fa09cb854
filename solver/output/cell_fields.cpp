#include "solver/output/cell_fields.hpp"

#include <stdexcept>

#include <fmt/format.h>

namespace granvof {

void check_sizes(const CellFields& fields) {
  std::size_t count = 1;
  for (std::size_t d = 0; d < 3; ++d) {
    if (fields.cells[d] < 1 || !(fields.spacing[d] > 0.0)) {
      throw std::invalid_argument(
          fmt::format("fields with {} cells of {} m in direction {}", fields.cells[d], fields.spacing[d], d));
    }
    count *= static_cast<std::size_t>(fields.cells[d]);
  }
  const auto check = [&](const std::vector<double>& values, const char* name, bool may_be_empty) {
    if (values.size() == count || (may_be_empty && values.empty())) return;
    throw std::invalid_argument(fmt::format("{} has {} values for {} cells", name, values.size(), count));
  };
  check(fields.f_s, "f_s", false);
  check(fields.alpha, "alpha", false);
  check(fields.p_c, "p_c", false);
  check(fields.p_s, "p_s", true);
  check(fields.theta, "theta", false);
  check(fields.phi, "phi", false);
  for (std::size_t d = 0; d < 3; ++d) {
    check(fields.u_s[d], "u_s", d == 2 && fields.cells[2] == 1);
    check(fields.u_c[d], "u_c", d == 2 && fields.cells[2] == 1);
  }
}

}  // namespace granvof
