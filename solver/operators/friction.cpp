#include "solver/operators/friction.hpp"

#include <algorithm>
#include <cmath>

#include "solver/closures/agitation_drag.hpp"
#include "solver/closures/contact_friction.hpp"
#include "solver/operators/component_pointers.hpp"
#include "solver/scene/scales.hpp"

namespace granvof {
namespace {

// Shares of the scene's velocity:
constexpr double velocity_tolerance = 1e-9;  // residual over the face's own mass, drag included
constexpr double slowest_sliding = 1e-7;     // below which a Coulomb wall holds like a viscous one
constexpr double relative_tolerance = 1e-6;
constexpr int most_iterations = 1000;  // a bed that locks in its first step took more than 300
constexpr int smoothing = 2;

// What friction depends on, in a cell or summed over the cells in contact around an edge.
struct Contacts {
  int count = 0;
  double pressure = 0.0;        // P_s^E [Pa]
  double dilatancy = 0.0;       // tan(psi) [-]
  double least = 0.0;           // coefficient of a layer that stops [-]
  double drag = 0.0;            // beta on the agitation [kg/m3 s]
  double normal_squared = 0.0;  // S:S of what is averaged over cells [1/s2]
};

}  // namespace

Friction::Friction(const Grid& grid, const Scene& scene, const Boundary& boundary,
                   const Communicator& communicator)
    : grid_(grid),
      scene_(scene),
      boundary_(boundary),
      velocity_(scales_of(scene).velocity),
      strain_(grid),
      mu_(grid),
      lambda_(grid),
      divergence_(grid),
      marked_(grid),
      communicator_(communicator),
      component_mass_(grid),
      inverse_mass_(grid),
      residual_(grid),
      correction_(grid) {
  for (int p = 0; p < (grid.dim == 2 ? 1 : 3); ++p) {
    mu_edge_[p] = Field(grid);
    shear_[p] = Field(grid);
  }
  for (int d = 0; d < grid.dim; ++d) {
    coefficient_[d] = FaceField(grid);
    faces_[d] = faces_of(grid, box_, d);
  }
}

// Everything below works on the box that holds the grains: most of a tank is fluid, where nothing is to be
// solved.
void Friction::fit_box(const FaceInertia& inertia) {
  const Range box = box_of_grains(grid_, inertia);
  if (box == box_) return;
  box_ = box;
  for (Field* f : {&mu_, &lambda_}) f->fill(0.0);
  for (int p = 0; p < (grid_.dim == 2 ? 1 : 3); ++p)
    for (Field* f : {&mu_edge_[p], &shear_[p]}) f->fill(0.0);
  multigrid_.clear();
  std::vector<Layout> layouts;
  for (int d = 0; d < grid_.dim; ++d) {
    marked_[d].fill(0.0);
    faces_[d] = faces_of(grid_, box_, d);
    if (is_empty(box_)) continue;
    layouts.push_back(faces_[d]);
    multigrid_.emplace_back(faces_[d], communicator_, grid_.h);
  }
  if (!layouts.empty()) solver_.emplace(layouts, communicator_);
}

void Friction::set_viscosity(const Rheology& rheology, const FaceField& u_strain) {
  strain_.update(grid_, u_strain, box_);
  boundary_.fill_scalar(strain_.normal_squared);
  const double eta = scene_.model.contact_friction ? scene_.solid.friction : 0.0;
  const double n = scene_.contact.regularisation;
  const bool inertial = scene_.model.contact_friction && scene_.model.friction_law == FrictionLaw::inertial;
  const double mu_2 = scene_.contact.fast_friction, i_0 = scene_.contact.inertial_number;
  const double rho_s = scene_.solid.density, d_s = scene_.solid.diameter;
  const auto viscosity_at = [=](const Contacts& sum, double norm) {
    const double share = 1.0 / sum.count, pressure = share * sum.pressure;
    const double law =
        inertial ? closures::inertial_friction(pressure, norm, eta, mu_2, i_0, rho_s, d_s) : eta;
    double coefficient = std::fmax(std::fmax(law, share * sum.least) + share * sum.dilatancy, 0.0);
    if (sum.drag > 0.0)
      coefficient += closures::agitation_friction(share * sum.drag, pressure, norm, rho_s, d_s);
    return closures::friction_viscosity(pressure, coefficient, n, norm);
  };
  const double *p = rheology.enduring_pressure.data(), *kinetic = rheology.kinetic_viscosity.data(),
               *psi = rheology.dilatancy_tangent.data(), *stop = rheology.arrest_friction.data(),
               *beta = rheology.agitated_drag.data();
  const double* sq = strain_.squared.data();
  double *mu = mu_.data(), *lambda = lambda_.data();
  for_each(grid_.cells, box_, [=](std::ptrdiff_t c) {
    lambda[c] = kinetic[c];
    mu[c] = kinetic[c];
    if (p[c] > 0.0) mu[c] += viscosity_at({1, p[c], psi[c], stop[c], beta[c], 0.0}, std::sqrt(0.5 * sq[c]));
  });
  boundary_.fill_scalar(mu_);
  boundary_.fill_scalar(lambda_);
  for (int d = 0; d < grid_.dim; ++d) {
    for (int e = d + 1; e < grid_.dim; ++e) {
      const int plane = plane_index(d, e);
      std::array<const double*, 3> rest{strain_.normal_squared.data(), nullptr, nullptr};
      int parts = 1;
      for (int q = 0; q < 3 && grid_.dim == 3; ++q) {
        if (q == plane) continue;
        boundary_.fill_scalar(strain_.plane_squared[q]);
        rest[parts++] = strain_.plane_squared[q].data();
      }
      const double* g = strain_.shear[plane].data();
      double* edge = mu_edge_[plane].data();
      const std::ptrdiff_t s = grid_.stride(d), t = grid_.stride(e);
      for_each(grid_.cells, Grid::edges(box_, d, e), [=](std::ptrdiff_t c) {
        const std::array<std::ptrdiff_t, 4> around{c, c - s, c - t, c - s - t};
        // Only cells in contact count: an average over empty cells would let the bed's surface slide.
        Contacts sum;
        double viscosity = 0.0;
        for (const std::ptrdiff_t a : around) {
          viscosity += 0.25 * kinetic[a];
          if (p[a] <= 0.0) continue;
          ++sum.count;
          sum.pressure += p[a];
          sum.dilatancy += psi[a];
          sum.least += stop[a];
          sum.drag += beta[a];
          for (int q = 0; q < parts; ++q) sum.normal_squared += rest[q][a];
        }
        if (sum.count > 0)
          viscosity +=
              viscosity_at(sum, std::sqrt(0.5 * (sum.normal_squared / sum.count + 0.5 * g[c] * g[c])));
        edge[c] = viscosity;
      });
    }
  }
  set_wall_friction(rheology, u_strain);
}

// Edges on closed sides: none for slip, at most mu_w P_s^E for Coulomb (through a viscosity of the old
// speed), and the bed's own for no-slip. The operator takes the wall's shear as 2 u_t / h.
void Friction::set_wall_friction(const Rheology& rheology, const FaceField& u_strain) {
  const double* p = rheology.enduring_pressure.data();
  const double slowest = slowest_sliding * velocity_;
  for (int d = 0; d < grid_.dim; ++d) {
    if (grid_.cells.periodic[d]) continue;
    for (int upper = 0; upper < 2; ++upper) {
      const Side& side = boundary_.side(d, upper);
      const bool no_slip = side.kind == SideKind::wall && side.solid.kind == WallKind::no_slip;
      if (no_slip) continue;
      const bool coulomb = side.kind == SideKind::wall && side.solid.kind == WallKind::coulomb;
      const double mu_w = coulomb ? side.solid.friction : 0.0;
      for (int e = 0; e < grid_.dim; ++e) {
        if (e == d) continue;
        Range wall = grid_.edges(d, e);
        wall.lower[d] = upper ? grid_.cells.n[d] : 0;
        wall.upper[d] = wall.lower[d] + 1;
        wall = common(wall, Grid::edges(box_, d, e));
        const std::ptrdiff_t s = grid_.stride(d), inside = upper ? -s : 0, t = grid_.stride(e);
        const double h = grid_.h[d], u_wall = side.velocity[e];
        const int g =
            3 - d - e;  // in 3D the other tangential direction: the wall limits the vector, not a component
        const bool three = grid_.dim == 3;
        const double w_wall = three ? side.velocity[g] : 0.0;
        const std::ptrdiff_t r = three ? grid_.stride(g) : 0;
        const double *v = u_strain[e].data(), *w = three ? u_strain[g].data() : v;
        double* edge = mu_edge_[plane_index(d, e)].data();
        for_each(grid_.cells, wall, [=](std::ptrdiff_t c) {
          const double pressure = 0.25 * (p[c] + p[c - s] + p[c - t] + p[c - s - t]);
          const std::ptrdiff_t i = c + inside;
          const double along = v[i] - u_wall;
          const double across = three ? 0.25 * (w[i] + w[i - t] + w[i + r] + w[i + r - t]) - w_wall : 0.0;
          const double speed = std::sqrt(along * along + across * across);
          edge[c] = std::min(edge[c], mu_w * pressure * 0.5 * h / std::max(speed, slowest));
        });
      }
    }
  }
}

void Friction::mark_faces(const FaceInertia& inertia, const Aperture& aperture) {
  for (int d = 0; d < grid_.dim; ++d) {
    const double *f = inertia.f_s[d].data(), *open = aperture[d].data();
    double* m = marked_[d].data();
    for_each(grid_.cells, common(grid_.inner_faces(d), box_),
             [=](std::ptrdiff_t c) { m[c] = f[c] >= least_solid_fraction ? open[c] : 0.0; });
    boundary_.exchange(marked_[d]);
  }
}

// A face without grains carries the fluid's velocity: a contact stress on its edges would glue the bed's
// surface to the water above.
void Friction::cut_edges_beside_empty_faces(const FaceInertia& inertia) {
  for (int d = 0; d < grid_.dim; ++d) {
    for (int e = d + 1; e < grid_.dim; ++e) {
      const double *fd = inertia.f_s[d].data(), *fe = inertia.f_s[e].data();
      const std::ptrdiff_t s = grid_.stride(d), t = grid_.stride(e);
      double* edge = mu_edge_[plane_index(d, e)].data();
      for_each(grid_.cells, Grid::edges(box_, d, e), [=](std::ptrdiff_t c) {
        const double least = std::fmin(std::fmin(fd[c], fd[c - t]), std::fmin(fe[c], fe[c - s]));
        edge[c] = least >= least_solid_fraction ? edge[c] : 0.0;
      });
    }
  }
}

// Own diffusion of every component; couplings to faces that are known go to the diagonal.
void Friction::set_preconditioner(const FaceField& mass) {
  for (int d = 0; d < grid_.dim; ++d) {
    const Layout& layout = faces_[d];
    const double *m = marked_[d].data(), *own = mass[d].data(), *mu = mu_.data(), *lambda = lambda_.data();
    double* diagonal = component_mass_[d].data();
    for_each(layout, [=](std::ptrdiff_t c) { diagonal[c] = m[c] * own[c]; });
    linear::Faces faces{};
    for (int e = 0; e < grid_.dim; ++e) {
      const std::ptrdiff_t s = grid_.stride(e);
      const double inv_h2 = 1.0 / (grid_.h[e] * grid_.h[e]);
      const double* edge = e == d ? nullptr : mu_edge_[plane_index(d, e)].data();
      double* a = coefficient_[d][e].data();
      if (e == d) {
        for_each(layout, [=](std::ptrdiff_t c) {
          const double behind = (2.0 * mu[c - s] + lambda[c - s]) * inv_h2,
                       ahead = (2.0 * mu[c] + lambda[c]) * inv_h2;
          a[c] = behind * m[c] * m[c - s];
          diagonal[c] += m[c] * (behind * (1.0 - m[c - s]) + ahead * (1.0 - m[c + s]));
        });
      } else {
        for_each(layout, [=](std::ptrdiff_t c) {
          a[c] = edge[c] * inv_h2 * m[c] * m[c - s];
          diagonal[c] += m[c] * inv_h2 * (edge[c] * (1.0 - m[c - s]) + edge[c + s] * (1.0 - m[c + s]));
        });
        if (!grid_.cells.periodic[e]) {
          // a wall is half a cell away: its edge counts twice (once above, through the unmarked ghost)
          for (const bool upper : {false, true}) {
            if (upper ? box_.upper[e] < grid_.cells.n[e] : box_.lower[e] > 0) continue;
            Range wall = Range::all(layout);
            wall.lower[e] = upper ? layout.n[e] - 1 : 0;
            wall.upper[e] = wall.lower[e] + 1;
            const std::ptrdiff_t at = upper ? s : 0;
            for_each(layout, wall, [=](std::ptrdiff_t c) { diagonal[c] += m[c] * inv_h2 * edge[c + at]; });
          }
        }
      }
      faces.lower[e] = a;
    }
    multigrid_[d].set(faces, diagonal);
  }
}

void Friction::fill_wall_ghosts(const linear::Components& u, bool moving_walls) const {
  const Layout& l = grid_.cells;
  for (int c = 0; c < grid_.dim; ++c) {
    boundary_.exchange(u[c]);
    for (int d = 0; d < grid_.dim; ++d) {
      if (d == c || l.periodic[d]) continue;
      const std::ptrdiff_t s = l.stride[d];
      for (int upper = 0; upper < 2; ++upper) {
        const double shift = moving_walls ? 2.0 * boundary_.side(d, upper).velocity[c] : 0.0;
        Range row = box_;
        row.upper[c] += 1;
        row.lower[d] = upper ? l.n[d] - 1 : 0;
        row.upper[d] = row.lower[d] + 1;
        if (upper ? box_.upper[d] < l.n[d] : box_.lower[d] > 0) continue;
        const std::ptrdiff_t out = upper ? s : -s;
        double* v = u[c];
        for_each(l, row, [=](std::ptrdiff_t i) { v[i + out] = shift - v[i]; });
      }
    }
  }
}

void Friction::apply(const FaceField& mass, const linear::Components& u, const linear::Components& y) {
  Range with_wrapped = box_;  // the cell beyond a periodic lower end is a neighbour of face 0
  for (int d = 0; d < grid_.dim; ++d) with_wrapped.lower[d] -= grid_.cells.periodic[d] ? 1 : 0;
  double* div = divergence_.data();
  const double *mu = mu_.data(), *lambda = lambda_.data();
  for (int d = 0; d < grid_.dim; ++d) {
    const double* v = u[d];
    const std::ptrdiff_t s = grid_.stride(d);
    const double inv_h = 1.0 / grid_.h[d];
    if (d == 0) {
      for_each(grid_.cells, with_wrapped, [=](std::ptrdiff_t c) { div[c] = (v[c + s] - v[c]) * inv_h; });
    } else {
      for_each(grid_.cells, with_wrapped, [=](std::ptrdiff_t c) { div[c] += (v[c + s] - v[c]) * inv_h; });
    }
    for (int e = d + 1; e < grid_.dim; ++e) {
      const double *w = u[e], *edge = mu_edge_[plane_index(d, e)].data();
      double* tau = shear_[plane_index(d, e)].data();
      const std::ptrdiff_t t = grid_.stride(e);
      const double inv_he = 1.0 / grid_.h[e];
      for_each(grid_.cells, Grid::edges(box_, d, e), [=](std::ptrdiff_t c) {
        tau[c] = edge[c] * ((v[c] - v[c - t]) * inv_he + (w[c] - w[c - s]) * inv_h);
      });
    }
  }
  for (int d = 0; d < grid_.dim; ++d) {
    const double *v = u[d], *own = mass[d].data(), *m = marked_[d].data();
    double* out = y[d];
    const std::ptrdiff_t s = grid_.stride(d);
    const double inv_h = 1.0 / grid_.h[d];
    const int e = d == 0 ? 1 : 0, g = 3 - d - e;
    const bool three = grid_.dim == 3;
    const double* tau1 = shear_[plane_index(d, e)].data();
    const double* tau2 = three ? shear_[plane_index(d, g)].data() : tau1;
    const std::ptrdiff_t t1 = grid_.stride(e), t2 = three ? grid_.stride(g) : 0;
    const double inv_h1 = 1.0 / grid_.h[e], inv_h2 = three ? 1.0 / grid_.h[g] : 0.0;
    for_each(faces_[d], [=](std::ptrdiff_t c) {
      const double ahead = 2.0 * mu[c] * (v[c + s] - v[c]) * inv_h + lambda[c] * div[c];
      const double behind = 2.0 * mu[c - s] * (v[c] - v[c - s]) * inv_h + lambda[c - s] * div[c - s];
      const double force =
          (ahead - behind) * inv_h + (tau1[c + t1] - tau1[c]) * inv_h1 + (tau2[c + t2] - tau2[c]) * inv_h2;
      out[c] = m[c] != 0.0 ? own[c] * v[c] - force : 0.0;
    });
  }
}

linear::Report Friction::solve(const FaceField& mass, const FaceField& rhs, const FaceInertia& inertia,
                               const Aperture& aperture, const Rheology& rheology, const FaceField& u_strain,
                               FaceField& u_s) {
  fit_box(inertia);
  if (is_empty(box_)) return {0, 0.0, 0.0, true};
  set_viscosity(rheology, u_strain);
  mark_faces(inertia, aperture);
  cut_edges_beside_empty_faces(inertia);

  // Solve for the change of the guess: walls, the gate and faces without grains then enter through the
  // residual alone.
  const linear::Components u = component_pointers(u_s, grid_.dim),
                           r = component_pointers(residual_, grid_.dim);
  fill_wall_ghosts(u, true);
  apply(mass, u, r);
  double first = 0.0,
         load = 0.0;  // largest residual of the guess, largest right-hand side, over the mass [m/s]
  for (int d = 0; d < grid_.dim; ++d) {
    const double *b = rhs[d].data(), *m = marked_[d].data();
    double *res = residual_[d].data(), *x = correction_[d].data();
    for_each(faces_[d], [=](std::ptrdiff_t c) {
      res[c] = m[c] != 0.0 ? b[c] - res[c] : 0.0;
      x[c] = 0.0;
    });
    const double* own = mass[d].data();
    double* w = inverse_mass_[d].data();
    const Layout& layout = faces_[d];
    for_each(layout, [=](std::ptrdiff_t c) { w[c] = m[c] != 0.0 ? 1.0 / own[c] : 0.0; });
    first = max_over(layout, Range::all(layout), first,
                     [=](std::ptrdiff_t c) { return std::fabs(w[c] * res[c]); });
    load =
        max_over(layout, Range::all(layout), load, [=](std::ptrdiff_t c) { return std::fabs(w[c] * b[c]); });
  }
  set_preconditioner(mass);
  // Where a bed locks within a step the guess leaves a residual far above every force in the problem
  // (viscosity times the old velocity): a share of that alone would leave momentum unsolved.
  const double least_share = relative_tolerance * std::fmin(first, load);
  const linear::Report report = solver_->solve(
      [&](const linear::Components& p, const linear::Components& q) {
        fill_wall_ghosts(p, false);
        apply(mass, p, q);
      },
      [&](const linear::ConstComponents& res, const linear::Components& z) {
        for (int d = 0; d < grid_.dim; ++d) multigrid_[d].apply(res[d], z[d], smoothing);
      },
      {r[0], r[1], r[2]}, component_pointers(correction_, grid_.dim),
      {std::fmax(velocity_tolerance * velocity_, least_share), 0.0, most_iterations},
      {inverse_mass_[0].data(), inverse_mass_[1].data(), grid_.dim == 3 ? inverse_mass_[2].data() : nullptr});
  for (int d = 0; d < grid_.dim; ++d) {
    const double *x = correction_[d].data(), *m = marked_[d].data();
    double* v = u_s[d].data();
    for_each(faces_[d], [=](std::ptrdiff_t c) { v[c] += m[c] * x[c]; });
    boundary_.exchange(u_s[d]);
  }
  return report;
}

}  // namespace granvof
