#include "solver/output/extract_motion.hpp"

#include <algorithm>
#include <cmath>

#include "solver/output/measures.hpp"
#include "solver/scene/gravity.hpp"

namespace granvof::scalar {

namespace {

using Velocity = std::array<std::vector<double>, 3>;

double speed_squared(const Velocity& u, std::size_t c) {
  double sum = 0.0;
  for (const auto& component : u) sum += component.empty() ? 0.0 : component[c] * component[c];
  return sum;
}

// Largest speed over the cells for which use(c) holds.
template <class Use>
Value largest_speed(const Velocity& u, std::size_t cells, Use use) {
  Value largest;
  for (std::size_t c = 0; c < cells; ++c) {
    if (use(c)) largest = std::max(largest.value_or(0.0), speed_squared(u, c));
  }
  return largest ? Value(std::sqrt(*largest)) : std::nullopt;
}

double solid_share(const CellFields& f, std::size_t c) {
  return f.f_s[c];
}
double liquid_share(const CellFields& f, std::size_t c) {
  return f.alpha[c] * (1.0 - f.f_s[c]);
}
double gas_share(const CellFields& f, std::size_t c) {
  return (1.0 - f.alpha[c]) * (1.0 - f.f_s[c]);
}

template <class Share>
double kinetic_energy(const CellFields& fields, const Scene& scene, Share share, const Velocity& u,
                      double density) {
  double sum = 0.0;
  for (std::size_t c = 0; c < fields.f_s.size(); ++c) sum += share(fields, c) * speed_squared(u, c);
  return 0.5 * density * sum * cell_volume(fields, scene);
}

template <class Share>
double potential_energy(const CellFields& fields, const Scene& scene, Share share, double density) {
  const Vec3 g = confined_gravity(scene);
  double height = 0.0, along = 0.0;  // sums of share times y and x in cells
  std::size_t c = 0;
  for (int k = 0; k < fields.cells[2]; ++k) {
    for (int j = 0; j < fields.cells[1]; ++j) {
      double row = 0.0;
      for (int i = 0; i < fields.cells[0]; ++i) {
        const double part = share(fields, c++);
        row += part;
        along += part * (i + 0.5);
      }
      height += row * (j + 0.5);
    }
  }
  return density * -g[1] * height * fields.spacing[1] * cell_volume(fields, scene) -
         density * g[0] * along * fields.spacing[0] * cell_volume(fields, scene);
}

}  // namespace

Value u_s_max(const CellFields& fields, const Scene& scene) {
  const double threshold = present_threshold(scene);
  return largest_speed(fields.u_s, fields.f_s.size(),
                       [&](std::size_t c) { return fields.f_s[c] >= threshold; });
}

Value u_s_dense_max(const CellFields& fields, const Scene& scene) {
  const double threshold = dense_threshold(scene);
  return largest_speed(fields.u_s, fields.f_s.size(),
                       [&](std::size_t c) { return fields.f_s[c] >= threshold; });
}

Value u_c_max(const CellFields& fields, const Scene&) {
  return largest_speed(fields.u_c, fields.f_s.size(), [](std::size_t) { return true; });
}

Value u_liquid_max(const CellFields& fields, const Scene&) {
  return largest_speed(fields.u_c, fields.f_s.size(),
                       [&](std::size_t c) { return liquid_share(fields, c) > 0.5; });
}

Value kinetic_energy_solid(const CellFields& fields, const Scene& scene) {
  return kinetic_energy(fields, scene, solid_share, fields.u_s, scene.solid.density);
}
Value kinetic_energy_liquid(const CellFields& fields, const Scene& scene) {
  return kinetic_energy(fields, scene, liquid_share, fields.u_c, scene.liquid.density);
}
Value kinetic_energy_gas(const CellFields& fields, const Scene& scene) {
  return kinetic_energy(fields, scene, gas_share, fields.u_c, scene.gas.density);
}
Value potential_energy_solid(const CellFields& fields, const Scene& scene) {
  return potential_energy(fields, scene, solid_share, scene.solid.density);
}
Value potential_energy_liquid(const CellFields& fields, const Scene& scene) {
  return potential_energy(fields, scene, liquid_share, scene.liquid.density);
}
Value potential_energy_gas(const CellFields& fields, const Scene& scene) {
  const std::vector<bool> solid = obstacle_cells(fields, scene);
  const auto share = [&](const CellFields& f, std::size_t c) {
    return !solid.empty() && solid[c] ? 0.0 : gas_share(f, c);
  };
  return potential_energy(fields, scene, share, scene.gas.density);
}

}  // namespace granvof::scalar
