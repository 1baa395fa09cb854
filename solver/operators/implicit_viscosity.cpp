#include "solver/operators/implicit_viscosity.hpp"

#include <algorithm>

#include "solver/operators/edge_mean.hpp"
#include "solver/operators/strain.hpp"
#include "solver/scene/scales.hpp"

namespace granvof {
namespace {

constexpr double relative_tolerance = 1e-5;   // of what implicit and explicit step differ by
constexpr double velocity_tolerance = 1e-10;  // of the scene's velocity
constexpr int most_iterations = 100;

}  // namespace

ImplicitViscosity::ImplicitViscosity(const Grid& grid, const Scene& scene, const Boundary& boundary)
    : grid_(grid),
      boundary_(boundary),
      least_velocity_(velocity_tolerance * scales_of(scene).velocity),
      open_(grid),
      edge_(grid),
      coefficient_(grid),
      mass_(grid),
      diagonal_(grid),
      rhs_(grid),
      increment_(grid) {
  for (int d = 0; d < grid.dim; ++d) solver_.emplace_back(grid.face_layout(d), grid.h);
}

// Rows of component d. A closed face is known (no increment): what couples to it goes to the diagonal.
void ImplicitViscosity::set_system(int d, double dt, const Field& viscosity, const FaceInertia& inertia,
                                   const FaceField& beta, const Aperture& aperture) {
  const Layout layout = grid_.face_layout(d);
  open_.fill(1.0);
  double *open = open_.data(), *mass = mass_.data(), *diagonal = diagonal_.data();
  const double *passable = aperture[d].data(), *fluid = inertia.fluid[d].data(), *b = beta[d].data();
  const double* solid = inertia.solid[d].data();
  for_each(layout, [=](std::ptrdiff_t c) {
    const double m_s = solid[c] / dt;
    open[c] = passable[c];
    mass[c] = fluid[c] / dt + (b[c] > 0.0 ? b[c] * m_s / (m_s + b[c]) : 0.0);
    diagonal[c] = open[c] * mass[c];
  });
  boundary_.exchange(open_);
  const double* mu = viscosity.data();
  for (int e = 0; e < grid_.dim; ++e) {
    const std::ptrdiff_t s = grid_.stride(d), t = grid_.stride(e);
    const double inv_h2 = 1.0 / (grid_.h[e] * grid_.h[e]);
    double *a = coefficient_[e].data(), *edge = edge_.data();
    const auto couple = [&](auto below, auto above) {  // coefficients towards c - t and c + t
      for_each(layout, [=](std::ptrdiff_t c) {
        a[c] = inv_h2 * below(c) * open[c] * open[c - t];
        diagonal[c] += inv_h2 * open[c] * (below(c) * (1.0 - open[c - t]) + above(c) * (1.0 - open[c + t]));
      });
    };
    if (e == d) {
      couple([=](std::ptrdiff_t c) { return 2.0 * mu[c - s]; },
             [=](std::ptrdiff_t c) { return 2.0 * mu[c]; });
      if (!grid_.cells.seam(d, false)) {  // no gradient beyond a lower side that the fluid passes
        Range first = Range::all(layout);
        first.upper[d] = 1;
        for_each(layout, first, [=](std::ptrdiff_t c) { a[c] = 0.0; });
      }
    } else {
      for_each(grid_.cells, grid_.edges(d, e), [=](std::ptrdiff_t c) { edge[c] = edge_mean(mu, c, s, t); });
      const int plane = plane_index(std::min(d, e), std::max(d, e));
      for (const Obstacles::Edge& o : grid_.obstacles.edges(plane))
        if (o.flat) edge[o.at] = edge_mean(mu, o);
      for (const InnerWalls::Edge& wall : boundary_.walls().edges(plane)) edge[wall.at] *= wall.share;
      boundary_.exchange(edge_);
      couple([=](std::ptrdiff_t c) { return edge[c]; }, [=](std::ptrdiff_t c) { return edge[c + t]; });
      set_sides(d, e, edge);
    }
    boundary_.exchange(coefficient_[e]);
  }
}

// The sides of direction e beside component d: what the ghosts are by the side's tangent.
void ImplicitViscosity::set_sides(int d, int e, const double* edge) {
  const Layout layout = grid_.face_layout(d);
  double *a = coefficient_[e].data(), *diagonal = diagonal_.data();
  const double* open = open_.data();
  for (const bool upper : {false, true}) {
    if (layout.seam(e, upper)) continue;
    Range row = Range::all(layout);
    row.lower[e] = upper ? layout.n[e] - 1 : 0;
    row.upper[e] = row.lower[e] + 1;
    if (!upper) for_each(layout, row, [=](std::ptrdiff_t c) { a[c] = 0.0; });
    const double share = boundary_.side(e, upper).fluid.share;
    if (share == 1.0) continue;
    const double held = (1.0 - share) / (grid_.h[e] * grid_.h[e]);
    const std::ptrdiff_t at = upper ? grid_.stride(e) : 0;
    for_each(layout, row, [=](std::ptrdiff_t c) { diagonal[c] += held * open[c] * edge[c + at]; });
  }
}

bool ImplicitViscosity::apply(double dt, const Field& viscosity, const FaceInertia& inertia,
                              const FaceField& beta, const Aperture& aperture, const FaceField& u_old,
                              FaceField& predicted_c, FaceField& u_c, FaceField& u_s) {
  bool converged = true;
  for (int d = 0; d < grid_.dim; ++d) {
    set_system(d, dt, viscosity, inertia, beta, aperture);
    const Layout layout = grid_.face_layout(d);
    const double *open = open_.data(), *mass = mass_.data(), *old = u_old[d].data();
    double *rhs = rhs_.data(), *x = increment_.data(), *fluid = u_c[d].data(), *grains = u_s[d].data();
    for_each(layout, [=](std::ptrdiff_t c) {
      x[c] = open[c] * (fluid[c] - old[c]);
      rhs[c] = mass[c] * x[c];
    });
    const double heaviest =
        max_over(layout, Range::all(layout), 0.0, [=](std::ptrdiff_t c) { return open[c] * mass[c]; });
    linear::Faces faces{};
    for (int e = 0; e < grid_.dim; ++e) faces.lower[e] = coefficient_[e].data();
    const linear::Report report = solver_[static_cast<std::size_t>(d)].solve(
        faces, diagonal_.data(), rhs, x, {least_velocity_ * heaviest, relative_tolerance, most_iterations});
    converged = converged && report.converged;
    const double *b = beta[d].data(), *solid = inertia.solid[d].data(), *own = inertia.fluid[d].data();
    double* star = predicted_c[d].data();
    for_each(layout, [=](std::ptrdiff_t c) {
      if (open[c] == 0.0) return;
      const double change = old[c] + x[c] - fluid[c];
      const double of_grains = b[c] > 0.0 ? b[c] / (solid[c] / dt + b[c]) * change : 0.0;
      fluid[c] += change;
      grains[c] += of_grains;
      star[c] += change + solid[c] / own[c] * of_grains;
    });
    boundary_.exchange(u_c[d]);
    boundary_.exchange(u_s[d]);
  }
  return converged;
}

}  // namespace granvof
