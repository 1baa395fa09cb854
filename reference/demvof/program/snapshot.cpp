#include "reference/demvof/program/snapshot.hpp"

#include <algorithm>
#include <cmath>

#include "reference/demvof/program/obstacle_setup.hpp"
#include "solver/scene/gravity.hpp"

namespace demvof {

namespace {

constexpr double least_fraction = 1e-9;  // below it a cell counts as free of beads

// Quantile of one coordinate of the beads' centres.
double quantile(const BeadState& beads, std::size_t direction, double share) {
  std::vector<double> x(beads.count());
  for (std::size_t b = 0; b < x.size(); ++b) x[b] = beads.position[3 * b + direction];
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(x.size() - 1));
  std::nth_element(x.begin(), x.begin() + rank, x.end());
  return x[static_cast<std::size_t>(rank)];
}

}  // namespace

granvof::CellFields snapshot(const CoupledRun& run, const granvof::Scene& scene, double time) {
  granvof::CellFields f;
  f.time = time;
  f.cells = scene.grid.cells;
  f.spacing = scene.grid.spacing;
  const std::vector<double>& f_s = run.solid_fraction();
  const std::size_t cells = f_s.size();
  const bool flat = f.cells[2] == 1;
  const double share = run.beads().bead_volume() / run.mapping().cell_volume();
  const std::vector<double>& velocity = run.beads().state().velocity;

  f.f_s = f_s;
  f.alpha = run.fluid().view().alpha;
  f.p_c = run.fluid().view().pressure;
  f.phi.resize(cells);
  for (std::size_t c = 0; c < cells; ++c) f.phi[c] = f_s[c] > least_fraction ? 1.0 : 0.0;

  std::vector<double> mean_square(cells, 0.0), squares(velocity.size() / 3);
  for (std::size_t b = 0; b < squares.size(); ++b) {
    for (std::size_t d = 0; d < 3; ++d) squares[b] += velocity[3 * b + d] * velocity[3 * b + d];
  }
  run.mapping().deposit(squares, 1, 0, mean_square);
  f.theta.assign(cells, 0.0);
  for (std::size_t c = 0; c < cells; ++c) {
    if (f_s[c] > least_fraction) f.theta[c] = mean_square[c] * share / f_s[c];
  }
  for (std::size_t d = 0; d < 3; ++d) {
    std::vector<double> u(cells, 0.0);
    run.mapping().deposit(velocity, 3, static_cast<int>(d), u);
    for (std::size_t c = 0; c < cells; ++c) {
      u[c] = f_s[c] > least_fraction ? u[c] * share / f_s[c] : 0.0;
      f.theta[c] -= u[c] * u[c];
    }
    if (d == 2 && flat) break;
    f.u_s[d] = std::move(u);
    f.u_c[d] = run.fluid().view().velocity[d];
  }
  for (double& theta : f.theta) theta = std::max(0.0, theta / 3.0);
  return f;
}

double bead_front(const BeadState& beads) {
  return quantile(beads, 0, 0.995);
}

double bed_top(const BeadState& beads, double diameter) {
  return quantile(beads, 1, 0.995) + 0.5 * diameter;
}

double bead_rms_speed(const BeadState& beads) {
  double sum = 0.0;
  for (const double v : beads.velocity) sum += v * v;
  return std::sqrt(sum / static_cast<double>(beads.count()));
}

std::optional<double> floor_slip(const BeadState& beads, double diameter, double from) {
  double speed[2] = {0.0, 0.0};
  double number[2] = {0.0, 0.0};
  for (std::size_t b = 0; b < beads.count(); ++b) {
    const double layer = beads.position[3 * b + 1] / diameter;
    if (layer >= 2.5 || beads.position[3 * b] <= from) continue;
    const int which = layer < 1.5 ? 0 : 1;
    speed[which] += beads.velocity[3 * b];
    number[which] += 1.0;
  }
  if (number[0] < 10.0 || number[1] < 10.0 || speed[1] / number[1] < 1e-2) return std::nullopt;
  return speed[0] / number[0] / (speed[1] / number[1]);
}

double excess_base_pressure(const CoupledRun& run, const granvof::Scene& scene) {
  double level = 0.0;
  for (const granvof::Box& box : scene.liquid_boxes) level = std::max(level, box.upper[1]);
  const Obstacles obstacles = obstacles_on(scene);
  const std::vector<double>& pressure = run.fluid().view().pressure;
  const int first = static_cast<int>(std::lround(scene.bed->box.lower[0] / scene.grid.spacing[0]));
  const int last =
      std::max(first + 1, static_cast<int>(std::lround(scene.bed->box.upper[0] / scene.grid.spacing[0])));
  const auto [nx, ny, nz] = scene.grid.cells;
  double sum = 0.0, columns = 0.0;
  for (int k = 0; k < nz; ++k) {
    for (int i = first; i < last; ++i) {
      int j = 0;
      while (obstacles.fill({i, j, k})) ++j;
      if (j == ny) continue;
      const double y = (j + 0.5) * scene.grid.spacing[1];
      const double own =
          level > y ? scene.liquid.density * granvof::normal_gravity(scene) * (level - y) : 0.0;
      sum += pressure[static_cast<std::size_t>((k * ny + j) * nx + i)] - own;
      columns += 1.0;
    }
  }
  return sum / columns;
}

}  // namespace demvof
