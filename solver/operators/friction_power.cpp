// What the solid stress of the friction step does per time: the energy budget's part of friction.hpp.
#include <algorithm>
#include <cmath>

#include "solver/closures/contact_friction.hpp"
#include "solver/operators/component_pointers.hpp"
#include "solver/operators/friction.hpp"
#include "solver/operators/stress_power.hpp"

namespace granvof {

// By the shape of (17) alone: of the coefficient's own dependence on the rate nothing is asked.
Friction::Missed Friction::yields_otherwise(const Rheology& rheology, const State& next) {
  if (is_empty(box_) || !scene_.model.contact_friction) return {};
  correction_ =
      next.u_s;  // not filled itself: what leaves through a side does so at the speed of the old level
  boundary_.fill_velocity(correction_, Phase::solid);
  strain_of_contacts(rheology, correction_, strain_of_solve_);
  const double n = scene_.contact.regularisation;
  const double *mu = mu_.data(), *kinetic = shear_of_collisions().data(), *was = strain_.squared.data(),
               *is = strain_of_solve_.squared.data();
  const auto shape = [=](double squared) {
    return closures::friction_viscosity(1.0, 1.0, n, std::sqrt(0.5 * squared));
  };
  const auto spent = [=](std::ptrdiff_t c) { return 2.0 * (mu[c] - kinetic[c]) * is[c]; };
  const Range cells = common(box_, grid_.all_cells());
  const double by_law =
      sum_over(grid_.cells, cells, [=](std::ptrdiff_t c) { return spent(c) * shape(is[c]) / shape(was[c]); });
  const double otherwise = sum_over(grid_.cells, cells, [=](std::ptrdiff_t c) {
    return spent(c) * std::fabs(1.0 - shape(is[c]) / shape(was[c]));
  });
  const double spent_in_all = sum_over(grid_.cells, cells, spent);
  return {by_law > 0.0 ? otherwise / by_law : 0.0, (spent_in_all - by_law) * grid_.cell_volume};
}

Friction::Power Friction::power(const FaceField& mass, const State& next, Field& kinetic_power) {
  kinetic_power.fill(0.0);
  if (is_empty(box_)) return {};
  correction_ = next.u_strain;
  const linear::Components v = component_pointers(correction_, grid_.dim),
                           r = component_pointers(residual_, grid_.dim);
  fill_wall_ghosts(v, true);
  apply(mass, v, r);
  Power power;
  const double *kinetic = shear_of_collisions().data(), *lambda = lambda_.data(), *div = divergence_.data();
  double* spent = kinetic_power.data();
  double total = sum_over(grid_.cells, box_, [=](std::ptrdiff_t c) {
    spent[c] = lambda[c] * div[c] * div[c];
    return spent[c];
  });
  for (int d = 0; d < grid_.dim; ++d) {
    const std::ptrdiff_t s = grid_.stride(d);
    const double inv_h = 1.0 / grid_.h[d];
    const double *x = v[d], *y = r[d], *m = marked_[d].data(), *own = mass[d].data(),
                 *end = next.u_s[d].data(), *mu = normal_viscosity(d);
    const auto work_on = [&](const double* velocity) {
      return sum_over(grid_.cells, common(faces_of(box_, d), grid_.inner_faces(d)), [=](std::ptrdiff_t c) {
        return m[c] != 0.0 ? velocity[c] * (own[c] * x[c] - y[c]) : 0.0;
      });
    };
    // numerical_stress of the ledger is what the two differ by
    power.on_grains += work_on(end);
    power.solved_for += work_on(x);
    total += sum_over(grid_.cells, box_, [=](std::ptrdiff_t c) {
      const double stretch = (x[c + s] - x[c]) * inv_h;
      spent[c] += 2.0 * kinetic[c] * stretch * stretch;
      return 2.0 * mu[c] * stretch * stretch;
    });
    for (int e = d + 1; e < grid_.dim; ++e) {
      const double *tau = shear_[plane_index(d, e)].data(), *edge = mu_edge_[plane_index(d, e)].data();
      const std::ptrdiff_t t = grid_.stride(e);
      total += sum_over_edges(
          grid_, d, e, [=](std::ptrdiff_t c) { return edge[c] > 0.0 ? tau[c] * tau[c] / edge[c] : 0.0; });
      // of an edge's dissipation per kinetic viscosity of a cell beside it: the square of its strain, less
      // where a wall bears less than the mean kinetic viscosity around
      const Field& of_edges = kinetic_edge_[plane_index(d, e)];
      const double* slipping = of_edges.empty() ? nullptr : of_edges.data();
      const auto squared = [=](std::ptrdiff_t c) {
        if (edge[c] <= 0.0) return 0.0;
        const double mean = 0.25 * (kinetic[c] + kinetic[c - s] + kinetic[c - t] + kinetic[c - s - t]);
        const double held = slipping ? std::min(edge[c], slipping[c]) : edge[c];
        const double strain = tau[c] / edge[c];
        return strain * strain * (held < mean ? held / mean : 1.0);
      };
      for_each(grid_.cells, box_, [=](std::ptrdiff_t c) {
        if (kinetic[c] > 0.0)
          spent[c] += 0.25 * kinetic[c] * (squared(c) + squared(c + s) + squared(c + t) + squared(c + s + t));
      });
      for (const Obstacles::Edge& o : grid_.obstacles.edges(plane_index(d, e)))
        if (o.flat && !o.on_side)  // its strain is over half a cell: four times the square
          for (const std::ptrdiff_t c : {o.open[0], o.open[1]}) spent[c] += 0.75 * kinetic[c] * squared(o.at);
    }
  }
  power.on_grains *= grid_.cell_volume;
  power.solved_for *= grid_.cell_volume;
  power.kinetic = grid_.cell_volume * sum_over(grid_.cells, box_, [=](std::ptrdiff_t c) { return spent[c]; });
  power.friction = std::max(total * grid_.cell_volume - power.kinetic, 0.0);
  grid_.for_each_open_side([&](int d, bool upper) {
    const std::ptrdiff_t s = grid_.stride(d), inside = upper ? -s : 0;
    const double inv_h = 1.0 / grid_.h[d], area = grid_.cell_volume * inv_h, sign = upper ? 1.0 : -1.0;
    const double *x = v[d], *mu = normal_viscosity(d);
    power.sides += sign * area * sum_over(grid_.cells, grid_.side_faces(d, upper), [=](std::ptrdiff_t c) {
                     const std::ptrdiff_t cell = c + inside;
                     const double stretch = (x[cell + s] - x[cell]) * inv_h;
                     return x[c] * (2.0 * mu[cell] * stretch + lambda[cell] * div[cell]);
                   });
  });
  power.walls = wall_power(grid_, boundary_, [&](int d, int e) {
    const double* tau = shear_[plane_index(d, e)].data();
    return [=](std::ptrdiff_t c) { return tau[c]; };
  });
  return power;
}

}  // namespace granvof
