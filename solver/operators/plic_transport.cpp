#include "solver/operators/plic_transport.hpp"

#include <algorithm>

#include "solver/operators/solid_transport.hpp"

namespace granvof {
namespace {

constexpr double largest_courant =
    0.5;                        // outflow per substep: what a half sweep leaves still covers the next
constexpr double pure = 1e-12;  // alpha closer than this to 0 or 1 has no interface in its cell

struct Cut {
  PlaneInCell plane;
  std::array<bool, 3> mirrored{};
};

// Distance of the next cell in memory along each axis; 0 for z in two dimensions.
using Neighbours = std::array<std::ptrdiff_t, 3>;

// Youngs' normal, out of the liquid, in units of the cell; all zero where alpha is uniform around the cell.
// alpha(i, j, k) that many cells away.
template <typename Alpha>
std::array<double, 3> liquid_normal(bool three, Alpha alpha) {
  std::array<double, 3> n{};
  const int deep = three ? 1 : 0;
  for (int k = -deep; k <= deep; ++k)
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i) {
        const double value = alpha(i, j, k);
        const double wx = 2.0 - std::abs(i), wy = 2.0 - std::abs(j), wz = 2.0 - std::abs(k);
        n[0] -= i * wy * wz * value;
        n[1] -= j * wx * wz * value;
        n[2] -= k * wx * wy * value;
      }
  return n;
}

// The plane of a cell that holds `liquid`, false where its neighbours give it no direction.
bool cut_of(const std::array<double, 3>& n, double liquid, Cut& cut) {
  const double sum = std::fabs(n[0]) + std::fabs(n[1]) + std::fabs(n[2]);
  if (!(sum > pure)) return false;
  for (int i = 0; i < 3; ++i) {
    cut.mirrored[i] = n[i] < 0.0;
    cut.plane.normal[i] = std::fabs(n[i]) / sum;
  }
  cut.plane.distance = distance_of_volume(cut.plane.normal, liquid);
  return true;
}

// Liquid that a cell of fraction `a` loses through its lower and its upper end, as shares of the cell's f_c;
// `width`: what leaves there in all. The plane's volume is good to the root of rounding only: no more liquid
// and no more gas leaves than the cell holds.
std::array<double, 2> leaving(const Cut& cut, int d, double a, const std::array<double, 2>& width) {
  std::array<double, 2> liquid{};
  for (const int end : {0, 1}) {
    const bool far = (end == 1) != cut.mirrored[d];
    const double lower = far ? 1.0 - width[end] : 0.0;
    liquid[end] =
        width[end] > pure ? volume_in_slab(cut.plane, d, lower, lower + width[end]) : a * width[end];
  }
  const double wet = liquid[0] + liquid[1], dry = width[0] + width[1] - wet;
  for (const int end : {0, 1}) {
    if (wet > a) liquid[end] *= a / wet;
    if (dry > 1.0 - a) liquid[end] = width[end] - (width[end] - liquid[end]) * (1.0 - a) / dry;
  }
  return liquid;
}

}  // namespace

PlicTransport::PlicTransport(const Grid& grid, const Boundary& boundary)
    : grid_(grid), boundary_(boundary), f_c_(grid), flux_(grid) {}

// One direction: alpha and f_c_ are both brought over the sweep.
void PlicTransport::sweep(int d, double dt, const FaceField& flux_c, Field& alpha, LiquidPassed& passed) {
  boundary_.fill_liquid_share(alpha, flux_c);
  boundary_.fill_scalar(f_c_);
  const std::ptrdiff_t s = grid_.stride(d);
  const double dt_h = dt / grid_.h[d];
  double *a = alpha.data(), *fc = f_c_.data(), *liquid = flux_.data();
  const double* q = flux_c[d].data();
  const Neighbours step{grid_.stride(0), grid_.stride(1), grid_.dim == 3 ? grid_.stride(2) : 0};
  flux_.fill(0.0);
  // through face c, the normal of its donor by normal_of(donor)
  const auto carried = [=](std::ptrdiff_t c, auto normal_of) {
    const bool forward = q[c] > 0.0;
    const std::ptrdiff_t donor = forward ? c - s : c;
    const double of_donor = dt_h / fc[donor];  // a flux as the part of the donor that it takes
    const int end = forward ? 1 : 0;
    const std::array<double, 2> width{std::max(-q[donor], 0.0) * of_donor,
                                      std::max(q[donor + s], 0.0) * of_donor};
    Cut cut;
    if (a[donor] <= pure || a[donor] >= 1.0 - pure || width[end] <= pure ||
        !cut_of(normal_of(donor), a[donor], cut))
      return a[donor] * q[c];
    return leaving(cut, d, a[donor], width)[end] / width[end] * q[c];
  };
  const bool three = grid_.dim == 3;
  const Range faces = grid_.flux_faces(d);
  for_each(grid_.cells, faces, [=](std::ptrdiff_t c) {
    liquid[c] = carried(c, [=](std::ptrdiff_t donor) {
      return liquid_normal(
          three, [=](int i, int j, int k) { return a[donor + i * step[0] + j * step[1] + k * step[2]]; });
    });
  });
  const InnerWalls& walls = boundary_.walls();
  for (const InnerWalls::Place& cell : walls.cells()) {
    for (const bool upper : {false, true}) {  // what it gives
      std::array<int, 3> at = cell.place;
      at[d] += upper ? 1 : 0;
      const std::ptrdiff_t face = cell.at + (upper ? s : 0);
      if (!faces.contains(at) || !(upper ? q[face] > 0.0 : q[face] < 0.0)) continue;
      liquid[face] = carried(face, [&](std::ptrdiff_t donor) {
        return liquid_normal(three, [&](int i, int j, int k) {
          return walls.cell_beside(a, donor, {i, j, k});
        });
      });
    }
  }
  boundary_.exchange(flux_);
  for_each(grid_.cells, [=](std::ptrdiff_t c) {
    const double held = a[c] * fc[c] - dt_h * (liquid[c + s] - liquid[c]);
    fc[c] -= dt_h * (q[c + s] - q[c]);
    a[c] = std::clamp(held / fc[c], 0.0, 1.0);  // within bounds already but for rounding
  });
  double* through = passed.through[d].data();
  for_each(grid_.cells, grid_.flux_faces(d), [=](std::ptrdiff_t c) { through[c] += dt * liquid[c]; });
}

void PlicTransport::advance(double dt, const Field& alpha, const Field& f_s, const FaceField& flux_c,
                            Field& alpha_new, LiquidPassed& passed) {
  const double courant = outflow_courant(grid_, dt, f_s, true, 0.0, flux_c);
  const int parts = std::max(1, static_cast<int>(std::ceil(courant / largest_courant)));
  const double part = dt / parts;
  alpha_new = alpha;
  const double* f = f_s.data();
  double* fc = f_c_.data();
  for_each(grid_.cells, [=](std::ptrdiff_t c) { fc[c] = 1.0 - f[c]; });
  for (int n = 0; n < parts; ++n) {
    for (int d = 0; d < grid_.dim - 1; ++d) sweep(d, 0.5 * part, flux_c, alpha_new, passed);
    sweep(grid_.dim - 1, part, flux_c, alpha_new, passed);
    for (int d = grid_.dim - 2; d >= 0; --d) sweep(d, 0.5 * part, flux_c, alpha_new, passed);
  }
}

}  // namespace granvof
