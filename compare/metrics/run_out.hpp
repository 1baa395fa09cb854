// Run-out of a collapsing column, (l - l0) / h0 against T = t / sqrt(h0 / g) (paper, section 4.1, Fig. 4).
//
// One definition of the front l from the first row to the last, and l0 is that front at t = 0. "run_out"
// takes the front by f_s = 0.30: it is there in every code at every time, whatever the packing of its toe.
// The paper's own, by f_s = 0.95 f_s,min, is "run_out_dense": from T of about 8 on, when the toe is a cell
// thick, and in dry flows, whose toe is looser than that, it says how dense the toe is rather than where.
// "run_out_quantile" is that of the place left of which 99.5 % of the grains lie: it counts grains that run
// ahead alone.
#pragma once

#include "compare/metrics/curve.hpp"

namespace granvof::compare {

struct ColumnSize {
  double height = 0.0;   // h0 [m], > 0
  double gravity = 0.0;  // g [m/s2], > 0
};

// Time scale tau0 = sqrt(h0 / g) [s].
double collapse_time(const ColumnSize& column);

// Run-out [-] against T [-] from a front [m, distance from the column's wall] against t [s]; nothing for a
// front that is undefined at t = 0.
Curve run_out(const Curve& front, const ColumnSize& column);

// The samples before the front [m] first comes within `cell` [m] of the wall at `far_end` [m]: from there on
// the wall sets it, and a front is known to no better than a cell. All of them where it never does.
Curve before_wall(const Curve& front, double far_end, double cell);

// Root-mean-square of the difference of two curves over `window` of their abscissa, on the union of their
// samples, both interpolated linearly; nothing unless both cover the window.
std::optional<double> rms_distance(const Curve& a, const Curve& b, Window window);

}  // namespace granvof::compare
