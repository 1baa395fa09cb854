#include "solver/operators/friction.hpp"

#include <algorithm>
#include <cmath>

#include "solver/operators/component_pointers.hpp"
#include "solver/scene/scales.hpp"

namespace granvof {
namespace {

constexpr double velocity_tolerance = 1e-9;  // of the scene's velocity: what a residual may be worth
constexpr double relative_tolerance = 1e-6;
constexpr int most_iterations = 1000;  // a bed that locks in its first step took more than 300
constexpr int smoothing = 2;

}  // namespace

Friction::Friction(const Grid& grid, const Scene& scene, const Boundary& boundary)
    : grid_(grid),
      scene_(scene),
      boundary_(boundary),
      velocity_(scales_of(scene).velocity),
      strain_(grid),
      strain_of_solve_(grid),
      mu_(grid),
      lambda_(grid),
      divergence_(grid),
      marked_(grid),
      direct_(grid),
      component_mass_(grid),
      weight_(grid),
      residual_(grid),
      correction_(grid) {
  if (scene.model.bounds_collisions()) bounded_ = Field(grid);
  if (grid.cells.is_cut() && grid.dim == 2) direct_of_slabs_.emplace(grid, scene);
  for (int p = 0; p < (grid.dim == 2 ? 1 : 3); ++p) {
    mu_edge_[p] = Field(grid);
    shear_[p] = Field(grid);
    if (grid.has_bumps() || has_coulomb_walls()) kinetic_edge_[p] = Field(grid);
  }
  if (scene.numerics.has_part_cells()) {
    mu_vertical_ = Field(grid);
    for (int d = 0; d < grid.dim; d += 2)
      tilting_[plane_index(std::min(d, vertical), std::max(d, vertical))] = Field(grid, 1.0);
  }
  for (int d = 0; d < grid.dim; ++d) {
    if (holds_by_friction(d, false) || holds_by_friction(d, true)) normal_stress_[d] = Field(grid);
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
  for (Field* f : {&mu_, &mu_vertical_, &lambda_, &bounded_}) f->fill(0.0);
  for (int p = 0; p < (grid_.dim == 2 ? 1 : 3); ++p)
    for (Field* f : {&mu_edge_[p], &shear_[p]}) f->fill(0.0);
  multigrid_.clear();
  std::vector<Layout> layouts;
  for (int d = 0; d < grid_.dim; ++d) {
    marked_[d].fill(0.0);
    faces_[d] = faces_of(grid_, box_, d);
    if (is_empty(box_)) continue;
    layouts.push_back(faces_[d]);
  }
  if (layouts.empty()) return;
  if (solver_)
    solver_->fit(layouts);
  else
    solver_.emplace(layouts);
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

linear::Report Friction::solve(const SolidBalance& balance, const FaceInertia& inertia,
                               const Aperture& aperture, const Rheology& rheology, const State& now,
                               State& next) {
  for (int d = 0; d < grid_.dim; ++d) normal_stress_[d].fill(0.0);
  return solve_by(balance, inertia, aperture, rheology, now.u_strain, next.u_s);
}

linear::Report Friction::solve_again(const SolidBalance& balance, const FaceInertia& inertia,
                                     const Aperture& aperture, const Rheology& rheology, State& next) {
  keep_normal_stress(next.u_strain);
  return solve_by(balance, inertia, aperture, rheology, next.u_strain, next.u_s);
}

// Of the whole bed, where that pays.
bool Friction::factorise(const FaceField& mass) {
  const bool here =
      direct_of_slabs_ ? direct_of_slabs_->factorise(box_, form(mass)) : direct_.factorise(box_, form(mass));
  return everywhere(grid_.cells, here);
}

linear::Report Friction::solve_by(const SolidBalance& balance, const FaceInertia& inertia,
                                  const Aperture& aperture, const Rheology& rheology,
                                  const FaceField& u_strain, FaceField& u_s) {
  const FaceField& mass = balance.mass;
  fit_box(inertia);
  if (is_empty(box_)) return {0, 0.0, 0.0, true};
  set_viscosity(rheology, u_strain);
  mark_faces(inertia, aperture);
  cut_edges_beside_empty_faces(inertia, rheology);

  // Solve for the change of the guess: walls, the gate and faces without grains then enter through the
  // residual alone.
  const linear::Components u = component_pointers(u_s, grid_.dim),
                           r = component_pointers(residual_, grid_.dim);
  fill_wall_ghosts(u, true);
  apply(mass, u, r);
  set_own_diffusion(mass);
  set_weights(mass);
  const bool thin = factorise(mass);
  if (!thin) set_multigrids();
  double first = 0.0,
         load = 0.0;  // largest residual of the guess, largest right-hand side, over the mass [m/s]
  for (int d = 0; d < grid_.dim; ++d) {
    const double *b = balance.rhs[d].data(), *m = marked_[d].data();
    double* res = residual_[d].data();
    for_each(faces_[d], [=](std::ptrdiff_t c) { res[c] = m[c] != 0.0 ? b[c] - res[c] : 0.0; });
    const double *own = mass[d].data(), *w = weight_[d].data();
    const Layout& layout = faces_[d];
    first = max_over(layout, Range::all(layout), first,
                     [=](std::ptrdiff_t c) { return std::fabs(w[c] * res[c]); });
    load = max_over(layout, Range::all(layout), load,
                    [=](std::ptrdiff_t c) { return m[c] != 0.0 ? std::fabs(b[c]) / own[c] : 0.0; });
  }
  // Where a bed locks within a step the guess leaves a residual far above every force in the problem
  // (viscosity times the old velocity): a share of that alone would leave momentum unsolved.
  const double least_share = relative_tolerance * std::min(first, load);
  const linear::Report report = solver_->solve(
      [&](const linear::Components& p, const linear::Components& q) {
        fill_wall_ghosts(p, false);
        apply(mass, p, q);
      },
      [&](const linear::ConstComponents& res, const linear::Components& z) {
        if (thin && direct_of_slabs_) return direct_of_slabs_->apply(res, z);
        if (thin) return direct_.apply(res, z);
        for (int d = 0; d < grid_.dim; ++d) multigrid_[d].apply(res[d], z[d], smoothing);
      },
      {r[0], r[1], r[2]}, component_pointers(correction_, grid_.dim),
      {std::max(velocity_tolerance * velocity_, least_share), 0.0, most_iterations},
      {weight_[0].data(), weight_[1].data(), grid_.dim == 3 ? weight_[2].data() : nullptr});
  for (int d = 0; d < grid_.dim; ++d) {
    const double *x = correction_[d].data(), *m = marked_[d].data();
    double* v = u_s[d].data();
    for_each(faces_[d], [=](std::ptrdiff_t c) { v[c] += m[c] * x[c]; });
    boundary_.exchange(u_s[d]);
  }
  return report;
}

}  // namespace granvof
