// The symmetric operator of the friction solve: mass u less the force of the stress of u.
#include "solver/operators/friction.hpp"

namespace granvof {
namespace {

constexpr auto all = [](std::ptrdiff_t) { return 1.0; };

}  // namespace

const double* Friction::tilting(int d, int e) const {
  const Field& share = tilting_[plane_index(d, e)];
  return share.empty() ? nullptr : share.data();
}

const double* Friction::normal_viscosity(int d) const {
  return has_part_cells() && d == vertical ? mu_vertical_.data() : mu_.data();
}

void Friction::fill_wall_ghosts(const linear::Components& u, bool moving_walls) const {
  const Layout& l = grid_.cells;
  for (int c = 0; c < grid_.dim; ++c) {
    boundary_.exchange(u[c]);
    for (int d = 0; d < grid_.dim; ++d) {
      if (d == c) continue;
      const std::ptrdiff_t s = l.stride[d];
      for (int upper = 0; upper < 2; ++upper) {
        if (l.seam(d, upper == 1)) continue;
        const double shift = moving_walls ? 2.0 * boundary_.side(d, upper).velocity[c] : 0.0;
        Range row = box_;
        row.upper[c] += 1;
        row.lower[d] = upper ? l.n[d] : -1;
        row.upper[d] = row.lower[d] + 1;
        if (upper ? box_.upper[d] < l.n[d] : box_.lower[d] > 0) continue;
        const std::ptrdiff_t inward = upper ? -s : s;
        double* v = u[c];
        for_each(l, row, [=](std::ptrdiff_t i) { v[i] = shift - v[i + inward]; });
      }
    }
  }
}

void Friction::apply(const FaceField& mass, const linear::Components& u, const linear::Components& y) {
  Range with_beyond = box_;  // the cell beyond a lower seam is a neighbour of face 0
  for (int d = 0; d < grid_.dim; ++d) with_beyond.lower[d] -= grid_.cells.seam(d, false) ? 1 : 0;
  double* div = divergence_.data();
  const double* lambda = lambda_.data();
  for (int d = 0; d < grid_.dim; ++d) {
    const double* v = u[d];
    const std::ptrdiff_t s = grid_.stride(d);
    const double inv_h = 1.0 / grid_.h[d];
    if (d == 0) {
      for_each(grid_.cells, with_beyond, [=](std::ptrdiff_t c) { div[c] = (v[c + s] - v[c]) * inv_h; });
    } else {
      for_each(grid_.cells, with_beyond, [=](std::ptrdiff_t c) { div[c] += (v[c + s] - v[c]) * inv_h; });
    }
    for (int e = d + 1; e < grid_.dim; ++e) {
      const double *w = u[e], *edge = mu_edge_[plane_index(d, e)].data();
      double* tau = shear_[plane_index(d, e)].data();
      const std::ptrdiff_t t = grid_.stride(e);
      const double inv_he = 1.0 / grid_.h[e];
      const auto shear = [&](auto along_d, auto along_e) {  // shares of the two slopes that shear grains
        for_each(grid_.cells, Grid::edges(box_, d, e), [=](std::ptrdiff_t c) {
          tau[c] =
              edge[c] * (along_e(c) * (v[c] - v[c - t]) * inv_he + along_d(c) * (w[c] - w[c - s]) * inv_h);
        });
      };
      const double* share = tilting(d, e);
      const auto tilt = [=](std::ptrdiff_t c) { return share[c]; };
      if (share == nullptr) {
        shear(all, all);
      } else if (e == vertical) {
        shear(tilt, all);
      } else {
        shear(all, tilt);
      }
    }
  }
  for (int d = 0; d < grid_.dim; ++d) {
    const double *v = u[d], *own = mass[d].data(), *m = marked_[d].data(), *mu = normal_viscosity(d);
    double* out = y[d];
    const std::ptrdiff_t s = grid_.stride(d);
    const double inv_h = 1.0 / grid_.h[d];
    const int e = d == 0 ? 1 : 0, g = 3 - d - e;
    const bool three = grid_.dim == 3;
    const double* tau1 = shear_[plane_index(d, e)].data();
    const double* tau2 = three ? shear_[plane_index(d, g)].data() : tau1;
    const std::ptrdiff_t t1 = grid_.stride(e), t2 = three ? grid_.stride(g) : 0;
    const double inv_h1 = 1.0 / grid_.h[e], inv_h2 = three ? 1.0 / grid_.h[g] : 0.0;
    const auto force_on_faces = [&](auto share1, auto share2) {  // of the shear stress of either plane
      for_each(faces_[d], [=](std::ptrdiff_t c) {
        const double ahead = 2.0 * mu[c] * (v[c + s] - v[c]) * inv_h + lambda[c] * div[c];
        const double behind = 2.0 * mu[c - s] * (v[c] - v[c - s]) * inv_h + lambda[c - s] * div[c - s];
        const double force = (ahead - behind) * inv_h +
                             (share1(c + t1) * tau1[c + t1] - share1(c) * tau1[c]) * inv_h1 +
                             (share2(c + t2) * tau2[c + t2] - share2(c) * tau2[c]) * inv_h2;
        out[c] = m[c] != 0.0 ? own[c] * v[c] - force : 0.0;
      });
    };
    if (d != vertical || tilting(0, vertical) == nullptr) {
      force_on_faces(all, all);
      continue;
    }
    const double *k1 = tilting(0, vertical), *k2 = three ? tilting(vertical, 2) : k1;
    force_on_faces([=](std::ptrdiff_t c) { return k1[c]; }, [=](std::ptrdiff_t c) { return k2[c]; });
  }
}

}  // namespace granvof
