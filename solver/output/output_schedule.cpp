#include "solver/output/output_schedule.hpp"

#include <algorithm>

namespace granvof {

std::vector<DueOutput> due_output(const Times& times, double after, double until) {
  std::vector<DueOutput> due;
  auto row = std::upper_bound(times.row_times.begin(), times.row_times.end(), after);
  auto field = std::upper_bound(times.field_times.begin(), times.field_times.end(), after);
  for (;;) {
    const bool row_left = row != times.row_times.end() && *row <= until;
    const bool field_left = field != times.field_times.end() && *field <= until;
    if (!row_left && !field_left) return due;
    const double next = row_left && field_left ? std::min(*row, *field) : (row_left ? *row : *field);
    due.push_back({next, row_left && *row == next, field_left && *field == next});
    if (due.back().row) ++row;
    if (due.back().fields) ++field;
  }
}

}  // namespace granvof
