// Run-out of a collapsing column, (l - l0) / h0 against T = t / sqrt(h0 / g) (paper, section 4.1, Fig. 4).
//
// The front l by f_s = 0.95 f_s,min ("dense") is clean until T = 8; later the toe is one cell thick and that
// threshold makes it jump, so the front by f_s = 0.30 ("dilute") is used beyond. Each definition starts from
// its own front at t = 0, so that the two meet without an offset that only their thresholds would make.
#pragma once

#include "compare/metrics/curve.hpp"

namespace granvof::compare {

struct ColumnSize {
  double height = 0.0;   // h0 [m], > 0
  double gravity = 0.0;  // g [m/s2], > 0
};

inline constexpr double dense_front_until = 8.0;  // T up to which the dense front is used [-]

// Time scale tau0 = sqrt(h0 / g) [s].
double collapse_time(const ColumnSize& column);

// Run-out [-] against T [-] from the fronts [m, distance from the column's wall] against t [s]; a front that
// is undefined at t = 0 contributes nothing.
Curve run_out(const Curve& front_dense, const Curve& front_dilute, const ColumnSize& column);

// The samples before the front [m] first comes within `cell` [m] of the wall at `far_end` [m]: from there on
// the wall sets it, and a front is known to no better than a cell. All of them where it never does.
Curve before_wall(const Curve& front, double far_end, double cell);

// Root-mean-square of the difference of two curves over `window` of their abscissa, on the union of their
// samples, both interpolated linearly; nothing unless both cover the window.
std::optional<double> rms_distance(const Curve& a, const Curve& b, Window window);

}  // namespace granvof::compare
