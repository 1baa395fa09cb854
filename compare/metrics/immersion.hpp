// Immersed share h/H of a floating bed (paper, section 4.3, Fig. 12a).
//
// With y up, a bed of height H centred at y_c reaches down to y_c - H/2, so its immersed depth below the
// interface at y_i is h = H/2 + (y_i - y_c). The paper prints H/2 + (y_c - y_i), which holds for y down.
#pragma once

#include "compare/metrics/curve.hpp"

namespace granvof::compare {

struct Immersion {
  double depth = 0.0;   // mean h [m]
  double height = 0.0;  // mean H [m]
  double share() const { return depth / height; }
};

// From y_c (27), H and y_i against time, averaged over `window`; nothing where one of them is undefined there
// (y_c and H are undefined until the bed has compacted to 0.95 f_s,min).
std::optional<Immersion> immersion(const Curve& centre, const Curve& height, const Curve& interface,
                                   Window window);

}  // namespace granvof::compare
