// The viscosity of enduring contacts and of collisions on cells and edges: friction.hpp's law, (16) and (17).
#include <algorithm>
#include <cmath>

#include "solver/closures/agitation_drag.hpp"
#include "solver/closures/contact_friction.hpp"
#include "solver/closures/critical_packing/laws.hpp"
#include "solver/closures/friction/laws.hpp"
#include "solver/closures/kinetic_theory.hpp"
#include "solver/closures/shear_dilatancy.hpp"
#include "solver/operators/friction.hpp"

namespace granvof {
namespace {

// What friction depends on, in a cell or summed over the cells in contact around an edge.
struct Contacts {
  int count = 0;
  double pressure = 0.0;        // P_s^E [Pa]
  double kinetic = 0.0;         // P_s^K [Pa] where the law is one of the whole stress, else 0
  double tan_psi = 0.0;         // tan(psi) [-]
  double least = 0.0;           // coefficient of a layer that stops [-]
  double drag = 0.0;            // beta on the agitation [kg/m3 s]
  double fluid = 0.0;           // mu_c between the grains [Pa s]
  double normal_squared = 0.0;  // S:S of what is averaged over cells [1/s2]
};

}  // namespace

void Friction::strain_of_contacts(const Rheology& rheology, const FaceField& u, StrainRate& strain) {
  strain.update(grid_, boundary_.walls(), u, box_);
  if (has_part_cells()) free_faces_of_part_cells(rheology, u, strain);
}

// Grains in a part of a cell rest on what lies below and rub along it; above they are free. What falls on
// them, or hangs over the edge of their cell, moves that free face at a speed that is none of theirs: taken
// for strain of the bed it outruns all creep, (17) yields to it, and the surface runs down the slope for
// ever. So neither their normal strain nor the tilt of an edge by a free face shears the grains, and no
// stress of such an edge acts on the face.
void Friction::free_faces_of_part_cells(const Rheology& rheology, const FaceField& velocity,
                                        StrainRate& strain) {
  const double* side = rheology.free_side.data();
  const std::ptrdiff_t up = grid_.stride(vertical);
  const auto free_face = [=](std::ptrdiff_t c) { return side[c - up] > 0.0 || side[c] < 0.0; };
  double *normal = strain.normal_squared.data(), *all = strain.squared.data();
  for (int h = 0; h < grid_.dim; h += 2) {
    const int d = std::min(h, vertical), e = std::max(h, vertical), plane = plane_index(d, e);
    const std::ptrdiff_t s = grid_.stride(d), t = grid_.stride(e), along = grid_.stride(h);
    const double inv_h = 1.0 / grid_.h[vertical];
    const double* u = velocity[h].data();
    double *share = tilting_[plane].data(), *g = strain.shear[plane].data(),
           *squared = strain.plane_squared[plane].data();
    for_each(grid_.cells, Grid::edges(box_, d, e), [=](std::ptrdiff_t c) {
      share[c] = free_face(c) || free_face(c - along) ? 0.0 : 1.0;
      if (share[c] == 0.0) g[c] = (u[c] - u[c - up]) * inv_h;
    });
    const Range edges = Grid::edges(box_, d, e);
    for (const InnerWalls::Edge& wall : boundary_.walls().edges(plane))
      if (edges.contains(wall.place) && share[wall.at] == 0.0) g[wall.at] *= wall.share;
    for_each(grid_.cells, box_, [=](std::ptrdiff_t c) {
      const double before = squared[c];
      squared[c] = squared_shear_of_cell(g, c, s, t);
      all[c] = std::max(all[c] + squared[c] - before, 0.0);
    });
  }
  const double* v = velocity[vertical].data();
  const double inv_h = 1.0 / grid_.h[vertical];
  for_each(grid_.cells, box_, [=](std::ptrdiff_t c) {
    const double fall = (v[c + up] - v[c]) * inv_h;
    if (side[c] != 0.0) normal[c] = std::max(normal[c] - fall * fall, 0.0);
  });
}

void Friction::set_viscosity(const Rheology& rheology, const FaceField& u_strain) {
  strain_of_contacts(rheology, u_strain, strain_);
  boundary_.fill_scalar(strain_.normal_squared);
  const double n = scene_.contact.regularisation;
  FrictionLaw friction = scene_.model.friction_law;
  Solid grains = scene_.solid;
  if (!scene_.model.contact_friction) {
    friction = {};
    grains.friction = 0.0;
  }
  const Contact contact = scene_.contact;
  const bool dilates = scene_.model.shear_dilatancy && scene_.model.dilatancy_friction;
  const CriticalPacking critical = scene_.model.critical_packing;
  // By the pressure that the law is one of, without the drag on agitation.
  const auto coefficient_at = [=](const Contacts& sum, double pressure, double norm) {
    const double share = 1.0 / sum.count, mu_c = share * sum.fluid;
    const double of_law = friction.with([&](auto law) {
      return law.coefficient({pressure, norm, mu_c}, grains, contact);
    });
    double tan_psi = share * sum.tan_psi;
    critical.with([&](auto law) {
      if constexpr (decltype(law)::depends_on_rate) {
        if (!dilates) return;
        const double mixed =
            closures::mixed_inertial_number(2.0 * norm, pressure, grains.density, grains.diameter, mu_c);
        tan_psi += contact.dilatancy_slope * (contact.critical_solid_fraction - law.packing(mixed, contact));
      }
    });
    return std::max(std::max(of_law, share * sum.least) + tan_psi, 0.0);
  };
  const auto viscosity_at = [=](const Contacts& sum, double norm) {
    const double share = 1.0 / sum.count, pressure = share * sum.pressure;
    double coefficient = coefficient_at(sum, share * (sum.pressure + sum.kinetic), norm);
    if (sum.drag > 0.0)
      coefficient +=
          closures::agitation_friction(share * sum.drag, pressure, norm, grains.density, grains.diameter);
    return closures::friction_viscosity(pressure, coefficient, n, norm);
  };
  const double *p = rheology.enduring_pressure.data(), *whole = rheology.kinetic_viscosity.data(),
               *psi = rheology.dilatancy_tangent.data(), *stop = rheology.arrest_friction.data(),
               *beta = rheology.agitated_drag.data();
  const double* fluid = rheology.pore_viscosity.empty() ? nullptr : rheology.pore_viscosity.data();
  const double *sq = strain_.squared.data(), *side = rheology.free_side.data();
  const bool bounds = !bounded_.empty();
  const double* borne = bounds ? rheology.kinetic_pressure.data() : nullptr;  // by collisions
  const auto in_cell = [=](std::ptrdiff_t c) {
    return Contacts{1, p[c], borne ? borne[c] : 0.0, psi[c], stop[c], beta[c], fluid ? fluid[c] : 0.0, 0.0};
  };
  const auto norm_of = [=](std::ptrdiff_t c) { return std::sqrt(0.5 * sq[c]); };
  if (bounds) {
    double* bounded = bounded_.data();
    for_each(grid_.cells, box_, [=](std::ptrdiff_t c) {
      bounded[c] = 0.0;
      if (borne[c] <= 0.0) return;
      const double norm = norm_of(c), eta = coefficient_at(in_cell(c), p[c] + borne[c], norm);
      bounded[c] = closures::bounded_kinetic_viscosity(whole[c], borne[c], eta, n, norm);
    });
    boundary_.fill_scalar(bounded_);
  }
  const double* kinetic = shear_of_collisions(rheology).data();
  double *mu = mu_.data(), *lambda = lambda_.data();
  for_each(grid_.cells, box_, [=](std::ptrdiff_t c) {
    lambda[c] = whole[c] + (closures::bulk_to_shear_viscosity - 1.0) * (whole[c] - kinetic[c]);
    mu[c] = kinetic[c];
    if (p[c] > 0.0) mu[c] += viscosity_at(in_cell(c), norm_of(c));
  });
  boundary_.fill_scalar(mu_);
  if (has_part_cells()) {
    double* squeezed = mu_vertical_.data();
    const double* held = rheology.part_cells.held.data();
    for_each(grid_.cells, box_, [=](std::ptrdiff_t c) {
      const double hold = side[c] == 0.0 ? 1.0 : held[c];
      squeezed[c] = kinetic[c] + hold * (mu[c] - kinetic[c]);
    });
    boundary_.fill_scalar(mu_vertical_);
  }
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
      // by the contact pressure of each cell around
      const auto viscosity_of_edge = [=](std::ptrdiff_t c, auto pressure_of) {
        const std::array<std::ptrdiff_t, 4> around{c, c - s, c - t, c - s - t};
        // Only cells in contact count: an average over empty cells would let the bed's surface slide.
        Contacts sum;
        double viscosity = 0.0;
        for (const std::ptrdiff_t a : around) {
          viscosity += 0.25 * kinetic[a];
          const double pressure = pressure_of(a);
          if (pressure <= 0.0) continue;
          ++sum.count;
          sum.pressure += pressure;
          if (borne) sum.kinetic += borne[a];
          sum.tan_psi += psi[a];
          sum.least += stop[a];
          sum.drag += beta[a];
          if (fluid) sum.fluid += fluid[a];
          for (int q = 0; q < parts; ++q) sum.normal_squared += rest[q][a];
        }
        if (sum.count > 0)
          viscosity +=
              viscosity_at(sum, std::sqrt(0.5 * (sum.normal_squared / sum.count + 0.5 * g[c] * g[c])));
        return viscosity;
      };
      const Range edges = Grid::edges(box_, d, e);
      for_each(grid_.cells, edges, [=](std::ptrdiff_t c) {
        edge[c] = viscosity_of_edge(c, [=](std::ptrdiff_t a) { return p[a]; });
      });
      if (!has_part_cells()) continue;
      // What bears grains feels their weight to its surface, as the tank's own floor and lid do.
      const double* weight = rheology.half_weight.data();
      for (const Obstacles::Edge& o : grid_.obstacles.edges(plane)) {
        if (!o.flat || o.across != vertical || !edges.contains(o.place)) continue;
        const double towards = o.above ? 1.0 : -1.0;
        edge[o.at] = viscosity_of_edge(
            o.at, [=](std::ptrdiff_t a) { return p[a] + borne_by_wall(p[a], towards * weight[a]); });
      }
    }
  }
  set_wall_friction(rheology, u_strain);
  set_kinetic_edges(rheology);
  slip_on_bumps(rheology);
}

// Grains stick to an obstacle: of the kinetic viscosity only the open cells around have one, and an edge
// holds nobody where a face, or on a flat surface a cell, beside it has no grains. Edges at its corners keep
// the whole distance. Along the gate they slip.
void Friction::hold_to_walls(const FaceInertia& inertia, const Rheology& rheology, int d, int e) {
  const int plane = plane_index(d, e);
  const double* kinetic = shear_of_collisions(rheology).data();
  double* viscosity = mu_edge_[plane].data();
  for (const Obstacles::Edge& edge : grid_.obstacles.edges(plane)) {
    if (edge.on_side) continue;  // on which grains slip
    double& mu = viscosity[edge.at];
    double sum = 0.0;
    for (int i = 0; i < edge.cells; ++i) sum += kinetic[edge.open[i]];
    mu += sum / edge.cells - 0.25 * sum;
    for (int i = 0; i < edge.faces; ++i)
      if (inertia.f_s[edge.face[i].first][edge.face[i].second] < least_solid_fraction) mu = 0.0;
    if (!edge.flat) continue;
    const double* on_surface = inertia.f_s[edge.across].data();  // half of the open cell's
    const std::ptrdiff_t surface = edge.above ? 0 : grid_.stride(edge.across);
    for (int i = 0; i < edge.cells; ++i)
      if (2.0 * on_surface[edge.open[i] + surface] < least_solid_fraction) mu = 0.0;
  }
  for (const InnerWalls::Edge& wall : boundary_.walls().edges(plane)) viscosity[wall.at] *= wall.share;
}

// A face without grains carries the fluid's velocity: a contact stress on its edges would glue the bed's
// surface to the water above.
void Friction::cut_edges_beside_empty_faces(const FaceInertia& inertia, const Rheology& rheology) {
  for (int d = 0; d < grid_.dim; ++d) {
    for (int e = d + 1; e < grid_.dim; ++e) {
      const double *fd = inertia.f_s[d].data(), *fe = inertia.f_s[e].data();
      const std::ptrdiff_t s = grid_.stride(d), t = grid_.stride(e);
      double* edge = mu_edge_[plane_index(d, e)].data();
      std::vector<double> on_obstacles;  // a face inside one has no grains and is no reason to let go
      for (const Obstacles::Edge& o : grid_.obstacles.edges(plane_index(d, e)))
        on_obstacles.push_back(edge[o.at]);
      for_each(grid_.cells, Grid::edges(box_, d, e), [=](std::ptrdiff_t c) {
        const double least = std::min(std::min(fd[c], fd[c - t]), std::min(fe[c], fe[c - s]));
        edge[c] = least >= least_solid_fraction ? edge[c] : 0.0;
      });
      std::size_t next = 0;
      for (const Obstacles::Edge& o : grid_.obstacles.edges(plane_index(d, e)))
        edge[o.at] = on_obstacles[next++];
      hold_to_walls(inertia, rheology, d, e);
    }
  }
}

}  // namespace granvof
