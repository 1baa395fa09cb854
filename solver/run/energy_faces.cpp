#include "solver/run/energy_faces.hpp"

#include <algorithm>

#include "solver/scene/gravity.hpp"

namespace granvof {
namespace {

class Faces {
 public:
  Faces(const Grid& grid, const Scene& scene, const double* side_pressure, double dt, const State& now,
        const State& next, const StepTrace& trace)
      : grid_(grid),
        scene_(scene),
        side_pressure_(side_pressure),
        dt_(dt),
        now_(now),
        next_(next),
        trace_(trace),
        g_(gravity_of(scene)),
        confined_(confined_gravity(scene)),
        outside_(gradient_outside(scene)) {}

  FaceWork sums() {
    for (int d = 0; d < grid_.dim; ++d) {
      if (trace_.inertia.holds_grains) add_solid(d);
      add_fluid(d, grid_.inner_faces(d),
                {.weight = 1.0, .inside = 0, .beyond = -grid_.stride(d), .of_side = false});
      add_surface_weight(d);
    }
    grid_.for_each_passing_side([&](int d, bool upper) {
      const std::ptrdiff_t s = grid_.stride(d);
      add_fluid(d, grid_.side_faces(d, upper),
                {.weight = 0.5, .inside = upper ? -s : 0, .beyond = upper ? 0 : -s, .of_side = true});
    });
    grid_.for_each_open_side([&](int d, bool upper) {
      add_side(d, upper);
      add_half_cells(d, upper);
    });
    return work_;
  }

 private:
  void add_solid(int d);
  // What a face's velocity moves: a cell's volume times the weight, filled as its two cells are.
  struct Moved {
    double weight;
    std::ptrdiff_t inside, beyond;
    bool of_side;
  };
  void add_fluid(int d, const Range& faces, const Moved& moved);
  void add_surface_weight(int d);
  void add_side(int d, bool upper);
  void add_potential_out(int d, bool upper);
  void add_half_cells(int d, bool upper);

  const Grid& grid_;
  const Scene& scene_;
  const double* side_pressure_;
  double dt_;
  const State &now_, &next_;
  const StepTrace& trace_;
  Vec3 g_, confined_, outside_;
  FaceWork work_;
};

void Faces::add_solid(int d) {
  const std::ptrdiff_t s = grid_.stride(d);
  const double *m = trace_.inertia.solid[d].data(), *f = trace_.inertia.f_s[d].data(),
               *beta = trace_.beta[d].data(), *star = trace_.predictor.solid()[d].data(),
               *q = trace_.flux_s[d].data();
  const double *f1 = next_.f_s.data(), *p = next_.p_c.data();
  const double *u0 = now_.u_s[d].data(), *u1 = next_.u_s[d].data(), *v1 = next_.u_c[d].data();
  const Sums<8> sums = sum_rows(grid_.cells, grid_.inner_faces(d), [=](std::ptrdiff_t start, int n) {
    double step = 0.0, before = 0.0, after = 0.0, predicted = 0.0, momentum = 0.0, slip = 0.0;
    double spread = 0.0, pressed = 0.0;
#pragma omp simd reduction(+ : step, before, after, predicted, momentum, slip, spread, pressed)
    for (int i = 0; i < n; ++i) {
      const std::ptrdiff_t c = start + i;
      const double u = u1[c], du = u - u0[c], mu = m[c] * u, w = u - v1[c], beside = q[c] - f[c] * u;
      step += m[c] * du * du;
      before += mu * u;
      after += (f1[c] + f1[c - s]) * u * u;
      predicted += mu * (star[c] - u0[c]);
      momentum += mu;
      slip += beta[c] * w * w;
      spread += beside;
      pressed += beside * (p[c] - p[c - s]);
    }
    return Sums<8>{{step, before, after, predicted, momentum, slip, spread, pressed}};
  });
  const auto [step, before, after, predicted, momentum, slip, spread, pressed] = sums.values;
  const double volume = grid_.cell_volume, rho_s = scene_.solid.density;
  const double kinetic = 0.25 * rho_s * after, gravity = (g_[d] - outside_[d] / rho_s) * dt_ * momentum;
  // Of the ledger: step is numerical_time, slip drag, solid_transport numerical_solid; convected and moved
  // are numerical_momentum.
  work_.step += 0.5 * volume * step;
  work_.kinetic += volume * kinetic;
  work_.moved += volume * (kinetic - 0.5 * before);
  work_.convected += volume * (predicted - gravity);
  work_.slip += volume * dt_ * slip;
  work_.solid_transport += volume * dt_ * (confined_[d] * rho_s * spread - pressed / grid_.h[d]);
  if (grid_.cells.periodic[d]) work_.driving += volume * gravity;
}

void Faces::add_fluid(int d, const Range& faces, const Moved& moved) {
  const std::ptrdiff_t s = grid_.stride(d), inside = moved.inside, beyond = moved.beyond;
  const bool of_side = moved.of_side;
  const double *m = trace_.inertia.fluid[d].data(), *f = trace_.inertia.f_s[d].data(),
               *star = trace_.predictor.fluid()[d].data(),
               *convective = trace_.predictor.convective_fluid()[d].data();
  const double *f1 = next_.f_s.data(), *a1 = next_.alpha.data(), *p0 = now_.p_c.data(),
               *p1 = next_.p_c.data();
  const double *v0 = now_.u_c[d].data(), *v1 = next_.u_c[d].data();
  const double *q = trace_.flux_c[d].data(), *solved = trace_.flux_c_solved[d].data(),
               *liquid = trace_.passed.through[d].data();
  const double rho_l = scene_.liquid.density, rho_g = scene_.gas.density, heavier = (rho_l - rho_g) / dt_;
  const double dt_h = dt_ / grid_.h[d], dt = dt_;
  const Sums<9> sums = sum_rows(grid_.cells, faces, [=](std::ptrdiff_t start, int n) {
    double step = 0.0, before = 0.0, after = 0.0, predicted = 0.0, convected = 0.0, momentum = 0.0;
    double passed = 0.0, lifted = 0.0, pressed = 0.0;
#pragma omp simd reduction(+ : step, before, after, predicted, convected, momentum, passed, lifted, pressed)
    for (int i = 0; i < n; ++i) {
      const std::ptrdiff_t c = start + i;
      const double v = v1[c], dv = v - v0[c], mv = m[c] * v, f_c = 1.0 - f[c];
      step += m[c] * dv * dv;
      before += mv * v;
      const double f_in = f1[c + inside], f_out = f1[c + beyond], a_in = a1[c + inside],
                   a_out = a1[c + beyond];
      const double mass = of_side ? passing_side_mass((1.0 - f_in) * mixture(a_in, rho_l, rho_g),
                                                      (1.0 - f_out) * mixture(a_out, rho_l, rho_g))
                                  : face_mass(f_in, a_in, f_out, a_out, rho_l, rho_g);
      after += mass * v * v;
      predicted += mv * (star[c] - v0[c]) + v * f_c * dt_h * (p0[c] - p0[c - s]);
      convected += mv * convective[c] * dt;
      momentum += mv;
      passed += f_c * v;
      lifted += rho_g * q[c] + heavier * liquid[c] - mv;
      pressed += (solved[c] - f_c * v) * (p1[c] - p1[c - s]);
    }
    return Sums<9>{{step, before, after, predicted, convected, momentum, passed, lifted, pressed}};
  });
  const auto [step, before, after, predicted, convected, momentum, passed, lifted, pressed] = sums.values;
  const double volume = moved.weight * grid_.cell_volume;
  const double gravity = dt_ * (g_[d] * momentum - outside_[d] * passed);  // and the pressure outside
  // Further: fluid_transport is numerical_fluid, viscous what numerical_viscosity is taken from.
  work_.step += 0.5 * volume * step;
  work_.kinetic += 0.5 * volume * after;
  work_.moved += 0.5 * volume * (after - before);
  work_.convected += volume * convected;
  work_.viscous += volume * (predicted - convected - gravity);
  work_.fluid_transport += volume * (dt_ * confined_[d] * lifted - dt_h * pressed);
  if (grid_.cells.periodic[d]) work_.driving += volume * gravity;
}

// The predictor adds it as a force of its own; against the fluxes it counts with gravity.
void Faces::add_surface_weight(int d) {
  const Field &f = trace_.inertia.f_s[d], &v = next_.u_c[d];
  double power = 0.0;
  for (const auto& [c, force] : trace_.predictor.surface_weight()[d]) power += (1.0 - f[c]) * force * v[c];
  const double work = grid_.cell_volume * dt_ * of_all(grid_.cells, power);
  work_.viscous -= work;
  work_.fluid_transport -= work;
}

// Mass that leaves takes its height along.
void Faces::add_potential_out(int d, bool upper) {
  const Range faces = grid_.side_faces(d, upper);
  const double *q = trace_.flux_c[d].data(), *qs = trace_.flux_s[d].data(),
               *liquid = trace_.passed.through[d].data();
  const double rho_l = scene_.liquid.density, rho_g = scene_.gas.density, rho_s = scene_.solid.density;
  const double sign = upper ? 1.0 : -1.0, area = grid_.cell_volume / grid_.h[d], dt = dt_;
  const auto total = [&](auto&& term) { return sum_over(grid_.cells, faces, term); };
  const double left = trace_.passed.left(grid_, d, upper);
  const double volume = sign * dt_ * area * total([=](std::ptrdiff_t c) { return q[c]; });
  const double solid = sign * dt_ * area * rho_s * total([=](std::ptrdiff_t c) { return qs[c]; });
  const double mass = rho_l * left + rho_g * (volume - left) + solid;
  const auto mass_of_face = [=](std::ptrdiff_t c) {  // per area, along the axis [kg/m2]
    return rho_l * liquid[c] + rho_g * (dt * q[c] - liquid[c]) + dt * rho_s * qs[c];
  };
  if (confined_[d] != 0.0) work_.potential_out += mass * -confined_[d] * (upper ? scene_.tank[d] : 0.0);
  for (int e = 0; e < grid_.dim; ++e) {  // where gravity acts along the side
    if (e == d || confined_[e] == 0.0) continue;
    const double moment = grid_.h[e] * moment_over(grid_.cells, faces, e, mass_of_face);
    work_.potential_out -= sign * area * confined_[e] * moment;
  }
}

// What passes a side takes its energy along, and the pressure on the side works on it: outflow of the ledger.
void Faces::add_side(int d, bool upper) {
  add_potential_out(d, upper);
  const SideRule& side = grid_.tank_side(d, upper);
  const Range faces = grid_.side_faces(d, upper);
  const std::ptrdiff_t s = grid_.stride(d), inside = upper ? -s : 0;
  const double *q = trace_.flux_c[d].data(), *v = next_.u_c[d].data(), *m = trace_.inertia.fluid[d].data(),
               *f = trace_.inertia.f_s[d].data(), *liquid = trace_.passed.through[d].data();
  const double *qs = trace_.flux_s[d].data(), *us = now_.u_s[d].data(), *theta = now_.theta.data();
  const double rho_l = scene_.liquid.density, rho_g = scene_.gas.density, rho_s = scene_.solid.density;
  const double sign = upper ? 1.0 : -1.0, area = grid_.cell_volume / grid_.h[d], dt = dt_;
  const auto total = [&](auto&& term) { return sum_over(grid_.cells, faces, term); };
  if (side.passes_fluid) {
    work_.kinetic_out += sign * dt * area * total([=](std::ptrdiff_t c) {
                           return 0.5 * m[c] / (1.0 - f[c]) * v[c] * v[c] * q[c];
                         });
    if (side.pressure) {
      const double* given = side_pressure_;  // null where another process has the side
      const std::ptrdiff_t beyond = upper ? 0 : -s;
      const double* solved = trace_.flux_c_solved[d].data();
      work_.side_pressure -=
          sign * dt * area * total([=](std::ptrdiff_t c) { return given[c + beyond] * (qs[c] + solved[c]); });
    }
  } else {  // as much as comes in, at the pressure that it meets
    const double* p = next_.p_c.data();
    work_.kinetic_out += sign * area * total([=](std::ptrdiff_t c) {
                           const double of_fluid = rho_l * liquid[c] + rho_g * (dt * q[c] - liquid[c]);
                           return 0.5 * of_fluid * v[c] * v[c];
                         });
    work_.side_pressure -=
        sign * dt * area * total([=](std::ptrdiff_t c) { return p[c + inside] * (qs[c] + q[c]); });
  }
  // Where the grains' velocity is given: what those inside press on it with.
  if (side.passes_grains || side.inflow_of_grains != 0.0) {
    const double *ps = next_.p_s.data(), *leaving = next_.u_s[d].data();
    work_.side_pressure -=
        sign * dt * area * total([=](std::ptrdiff_t c) { return ps[c + inside] * leaving[c]; });
  }
  work_.kinetic_out +=
      sign * dt * area * total([=](std::ptrdiff_t c) { return 0.5 * rho_s * qs[c] * us[c] * us[c]; });
  work_.granular_out +=
      sign * dt * area * total([=](std::ptrdiff_t c) { return 1.5 * rho_s * qs[c] * theta[c + inside]; });
}

// Between a side and the middle of its cells no momentum is solved of what has a given velocity there: its
// weight is borne by the pressure on the side, which differs so from that inside.
void Faces::add_half_cells(int d, bool upper) {
  const Range faces = grid_.side_faces(d, upper);
  const std::ptrdiff_t s = grid_.stride(d);
  const double *q = trace_.flux_c[d].data(), *qs = trace_.flux_s[d].data(),
               *liquid = trace_.passed.through[d].data(), *p = next_.p_c.data();
  const double rho_l = scene_.liquid.density, rho_g = scene_.gas.density, rho_s = scene_.solid.density;
  const double half = 0.5 * grid_.cell_volume, g = confined_[d], dt = dt_, dt_h = dt_ / grid_.h[d];
  work_.side_pressure -=
      half * dt * g * rho_s * sum_over(grid_.cells, faces, [=](std::ptrdiff_t c) { return qs[c]; });
  if (grid_.tank_side(d, upper).passes_fluid) {
    work_.side_pressure += half * dt_h * sum_over(grid_.cells, faces, [=](std::ptrdiff_t c) {
                             return qs[c] * (p[c] - p[c - s]);
                           });
    return;
  }
  work_.side_pressure -= half * g * sum_over(grid_.cells, faces, [=](std::ptrdiff_t c) {
                           return rho_l * liquid[c] + rho_g * (dt * q[c] - liquid[c]);
                         });
}

}  // namespace

FaceWork work_on_faces(const Grid& grid, const Scene& scene, const double* side_pressure, double dt,
                       const State& now, const State& next, const StepTrace& trace) {
  return Faces(grid, scene, side_pressure, dt, now, next, trace).sums();
}

}  // namespace granvof
