// A plane that cuts the unit cell: the volume below it, and the plane that leaves a given volume.
//
// Source: the volume of a cut cube, piecewise cubic in the plane's distance (Scardovelli & Zaleski 2000, J.
// Comput. Phys. 164, 228). The inverse is ours: below one half the volume is convex in the distance, so that
// Newton's method from the middle of the cell descends to the root without a safeguard.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace granvof {

// The liquid is where sum_i normal[i] x_i <= distance, 0 <= x_i <= 1. The components are >= 0 and add up to 1
// (mirror x_i where the normal is negative); 0 <= distance <= 1.
struct PlaneInCell {
  std::array<double, 3> normal{};
  double distance = 0.0;
};

struct CutVolume {
  double volume = 0.0;   // share of the cell below the plane [-], 0..1
  double section = 0.0;  // d volume / d distance [-]
};

// Components below this share of the largest are left out, the plane moved to where it is on the mean of the
// direction lost: smaller ones would be differences of cubes over a vanishing product.
inline constexpr double least_normal_component = 1e-6;

// The components that count, sorted and adding up to 1; a distance d of the full plane is d = shift + scale
// d'.
struct OrderedNormal {
  std::array<double, 3> m{};
  double shift = 0.0, scale = 1.0;
};

inline OrderedNormal ordered_normal(const std::array<double, 3>& normal) {
  OrderedNormal o{normal};
  std::sort(o.m.begin(), o.m.end());
  const double least = least_normal_component * o.m[2];
  for (double& component : o.m) {
    if (component >= least) continue;
    o.shift += 0.5 * component;
    component = 0.0;
  }
  o.scale = o.m[0] + o.m[1] + o.m[2];
  for (double& component : o.m) component /= o.scale;
  return o;
}

// Below half of the cell: m sorted, adding up to 1, 0 <= d <= 1/2.
inline CutVolume lower_cut(const std::array<double, 3>& m, double d) {
  const double m12 = m[0] + m[1], product = 6.0 * m[0] * m[1] * m[2];
  if (d < m[0]) return {d * d * d / product, 3.0 * d * d / product};
  if (d < m[1]) {
    const double two = 2.0 * m[1] * m[2];
    return {d * (d - m[0]) / two + m[0] * m[0] / (3.0 * two), (2.0 * d - m[0]) / two};
  }
  if (d >= std::min(m12, m[2]) && m12 <= m[2]) return {(2.0 * d - m12) / (2.0 * m[2]), 1.0 / m[2]};
  double volume = d * d * (3.0 * m12 - d), slope = 3.0 * d * (2.0 * m12 - d);
  int corners = 2;
  if (d >= m[2]) {
    volume = d * d * (3.0 - 2.0 * d);
    slope = 6.0 * d * (1.0 - d);
    corners = 3;
  }
  for (int i = 0; i < corners; ++i) {
    volume += m[i] * m[i] * (m[i] - 3.0 * d);
    slope -= 3.0 * m[i] * m[i];
  }
  return {volume / product, slope / product};
}

// Share of the cell below the plane [-]; any normal >= 0 with a positive sum, any distance.
inline double volume_below(const std::array<double, 3>& normal, double distance) {
  const OrderedNormal o = ordered_normal(normal);
  const double d = (distance - o.shift) / o.scale;
  if (d <= 0.0) return 0.0;
  if (d >= 1.0) return 1.0;
  return d <= 0.5 ? lower_cut(o.m, d).volume : 1.0 - lower_cut(o.m, 1.0 - d).volume;
}

// The distance at which the plane leaves `volume` of the cell below it; normal >= 0, sum 1; 0 <= volume <= 1.
inline double distance_of_volume(const std::array<double, 3>& normal, double volume) {
  const OrderedNormal o = ordered_normal(normal);
  const double small = std::min(volume, 1.0 - volume);
  double d = small > 0.0 ? 0.5 : 0.0;
  for (int i = 0; i < 60 && small > 0.0; ++i) {
    const CutVolume cut = lower_cut(o.m, d);
    const double step = (cut.volume - small) / cut.section;
    if (!(step > 1e-16)) break;
    d -= step;
  }
  return o.shift + o.scale * (volume <= 0.5 ? d : 1.0 - d);
}

// Share of the cell [-] that is below the plane and in the slab lower <= x_i <= upper of direction i.
inline double volume_in_slab(const PlaneInCell& plane, int i, double lower, double upper) {
  std::array<double, 3> m = plane.normal;
  const double rest = plane.distance - m[i] * lower;
  m[i] *= upper - lower;
  return (upper - lower) * volume_below(m, rest);
}

}  // namespace granvof
