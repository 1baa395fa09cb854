#include "solver/operators/momentum_predictor.hpp"

#include <cmath>

#include "solver/closures/slope_limiter/laws.hpp"
#include "solver/operators/convection.hpp"
#include "solver/operators/mass_consistent_convection.hpp"
#include "solver/scene/gravity.hpp"
#include "solver/scene/parts.hpp"

namespace granvof {

MomentumPredictor::MomentumPredictor(const Grid& grid, const Scene& scene, const Boundary& boundary)
    : grid_(grid),
      scene_(scene),
      boundary_(boundary),
      limited_(closures::is_of_second_order(scene.numerics.transport_scheme)),
      solid_(grid),
      fluid_(grid),
      convective_(grid),
      surface_weight_(grid, scene, boundary) {
  // a fluid of one density fills no face
  if (scene.numerics.fluid_convection == Convection::mass_consistent && has_liquid(scene))
    fluid_mass_ = Field(grid);
}

void MomentumPredictor::set_fluid_mass(const State& now) {
  if (fluid_mass_.empty()) return;
  const double rho_l = scene_.liquid.density, rho_g = scene_.gas.density;
  const double *f = now.f_s.data(), *a = now.alpha.data();
  double* m = fluid_mass_.data();
  for_each(grid_.cells, grid_.cells_and_ghosts(2),
           [=](std::ptrdiff_t c) { m[c] = (1.0 - f[c]) * mixture(a[c], rho_l, rho_g); });
}

void MomentumPredictor::convect_solid(double dt, const State& now, const FaceInertia& inertia, int d) {
  const Range faces = grid_.inner_faces(d);
  if (scene_.numerics.solid_convection == Convection::mass_consistent) {
    upwind_power_ +=
        grid_.cell_volume * scene_.solid.density *
        convect_with_mass(now.f_s, limited_, 0.0, grid_, boundary_.walls(), now.u_s, d, faces, dt, solid_[d]);
    return;
  }
  upwind_power_ += grid_.cell_volume * convective_acceleration(inertia.solid[d], grid_, boundary_.walls(),
                                                               now.u_s, d, faces, limited_, solid_[d]);
  bound_convection(grid_, now.u_s, d, faces, dt, inertia.f_s[d], solid_that_counts_in(scene_), solid_[d]);
}

void MomentumPredictor::convect_fluid(double dt, const State& now, const FaceInertia& inertia, int d) {
  const double between_gas_and_liquid = std::sqrt(scene_.gas.density * scene_.liquid.density);
  const auto advect = [&](const Range& faces) {
    upwind_power_ +=
        grid_.cell_volume *
        (limited_ && has_liquid(scene_)
             ? convective_acceleration_limited_in(inertia.fluid[d], between_gas_and_liquid, grid_,
                                                  boundary_.walls(), now.u_c, d, faces, convective_[d])
             : convective_acceleration(inertia.fluid[d], grid_, boundary_.walls(), now.u_c, d, faces,
                                       limited_, convective_[d]));
  };
  if (fluid_mass_.empty()) return advect(grid_.fluid_faces(d));
  // what fills the half cell of a side comes from beyond it, at a velocity of its own
  grid_.for_each_passing_side([&](int e, bool upper) {
    if (e == d) advect(grid_.side_faces(d, upper));
  });
  upwind_power_ += grid_.cell_volume * convect_with_mass(fluid_mass_, limited_, between_gas_and_liquid, grid_,
                                                         boundary_.walls(), now.u_c, d, grid_.inner_faces(d),
                                                         dt, convective_[d]);
}

void MomentumPredictor::update(double dt, const State& now, const FaceInertia& inertia,
                               const FluidViscosity& viscosity, const Aperture& aperture,
                               const BodyAcceleration* extra) {
  upwind_power_ = viscous_power_ = 0.0;
  set_fluid_mass(now);
  surface_weight_.update(now.alpha);
  for (int d = 0; d < grid_.dim; ++d) {
    const std::ptrdiff_t s = grid_.stride(d);
    const double gravity = gravity_of(scene_)[d], inv_h = 1.0 / grid_.h[d];
    const double outside = gradient_outside(scene_)[d], on_solid = outside / scene_.solid.density;
    const Range fluid = grid_.fluid_faces(d), solid = grid_.inner_faces(d);
    convect_fluid(dt, now, inertia, d);
    fluid_[d] = convective_[d];
    viscosity.add_acceleration(now.u_c, inertia, d, fluid, fluid_[d]);
    viscous_power_ += viscosity.power_on(now.u_c, inertia, d, convective_[d], fluid_[d]);
    const double *open = aperture[d].data(), *f = inertia.f_s[d].data(), *m = inertia.fluid[d].data();
    const double *uc = now.u_c[d].data(), *p = now.p_c.data();
    double* c_star = fluid_[d].data();
    for_each(grid_.cells, fluid, [=](std::ptrdiff_t c) {
      const double pressure = (1.0 - f[c]) * ((p[c] - p[c - s]) * inv_h + outside) / m[c];
      c_star[c] = open[c] * (uc[c] + dt * (c_star[c] + gravity - pressure));
    });
    weigh_surface(dt, inertia, aperture, d);
    if (extra != nullptr) add(dt, aperture, extra->fluid, d, fluid, fluid_);
    boundary_.exchange(fluid_[d]);
    if (!inertia.holds_grains) continue;
    convect_solid(dt, now, inertia, d);
    const double* us = now.u_s[d].data();
    double* s_star = solid_[d].data();
    for_each(grid_.cells, solid, [=](std::ptrdiff_t c) {
      s_star[c] = open[c] * (us[c] + dt * (s_star[c] + gravity - on_solid));
    });
    if (extra != nullptr) add(dt, aperture, extra->solid, d, solid, solid_);
    boundary_.exchange(solid_[d]);
  }
}

void MomentumPredictor::weigh_surface(double dt, const FaceInertia& inertia, const Aperture& aperture,
                                      int d) {
  const Field &open = aperture[d], &f_s = inertia.f_s[d], &mass = inertia.fluid[d];
  for (const auto& [c, force] : surface_weight_[d])
    fluid_[d][c] += dt * open[c] * (1.0 - f_s[c]) * force / mass[c];
}

void MomentumPredictor::add(double dt, const Aperture& aperture, const FaceField& extra, int d,
                            const Range& faces, FaceField& predicted) const {
  const double *open = aperture[d].data(), *source = extra[d].data();
  double* star = predicted[d].data();
  for_each(grid_.cells, faces, [=](std::ptrdiff_t c) { star[c] += dt * open[c] * source[c]; });
}

}  // namespace granvof
