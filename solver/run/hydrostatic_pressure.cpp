#include "solver/run/hydrostatic_pressure.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "solver/linear/scalar_solver.hpp"
#include "solver/operators/aperture.hpp"
#include "solver/operators/mixture.hpp"
#include "solver/operators/pressure_level.hpp"
#include "solver/operators/surface_weight.hpp"
#include "solver/scene/gravity.hpp"

namespace granvof {
namespace {

// Of pressures that are summed up along different ways.
constexpr double rounding = 1e-12;

// The pressure by columns, with the mean density of both cells on every face.
class Columns {
 public:
  Columns(const Grid& grid, const Scene& scene, const Aperture& aperture, State& s)
      : grid_(grid), scene_(scene), aperture_(aperture), s_(s) {}

  // As if the tank were empty: the water on both sides of an obstacle is one body.
  void fill() {
    const Layout& l = grid_.cells;
    const double normal = normal_gravity(scene_);
    for (int k = 0; k < l.n[2]; ++k) {
      tops_.push_back(along_the_top(k));
      for (int i = 0; i < l.n[0]; ++i) {
        double pressure = top(i, k), above = 0.0;
        for (int j = l.n[1] - 1; j >= 0; --j) {
          const std::ptrdiff_t c = l.index(i, j, k);
          const double here = density(c);
          pressure += 0.5 * (above + here) * normal * grid_.h[1];
          s_.p_c[c] = pressure;
          above = here;
        }
      }
    }
  }

  // Stretches of a column between obstacles: one that an obstacle covers is shifted to the pressure of what
  // is beside its uppermost open face, on and on as far as the fluid reaches, with the step that their
  // columns have at the top. At an open top columns stay as they are, under a lid the first one does.
  void join() {
    if (grid_.obstacles.none()) return;
    find_stretches();
    const bool open = grid_.tank_side(vertical, true).passes_fluid;
    for (const bool at_the_top : {true, false}) {
      for (std::size_t number = 0; number < stretches_.size(); ++number) {
        if ((stretches_[number].top[vertical] == grid_.cells.n[vertical] - 1) != at_the_top) continue;
        settle(number, 0.0);
        if (!at_the_top || !open) spread();
      }
      spread();
    }
  }

 private:
  struct Stretch {
    std::array<int, 3> top;
    int cells = 0;
    double off = 0.0;  // of the pressure in its column [Pa]
    bool settled = false;
  };

  double density(std::ptrdiff_t c) const { return fluid_density(scene_, s_, c); }

  double top(int i, int k) const { return tops_[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)]; }

  // Under an inclined top, from its middle.
  std::vector<double> along_the_top(int k) const {
    const Layout& l = grid_.cells;
    const double along = confined_gravity(scene_)[0];
    std::vector<double> pressure(static_cast<std::size_t>(l.n[0]), 0.0);
    double mean = 0.0;
    for (int i = 1; i < l.n[0]; ++i) {
      const std::ptrdiff_t c = l.index(i, l.n[1] - 1, k);
      const std::size_t here = static_cast<std::size_t>(i);
      pressure[here] = pressure[here - 1] + 0.5 * (density(c - 1) + density(c)) * along * grid_.h[0];
      mean += pressure[here] / l.n[0];
    }
    for (double& p : pressure) p -= mean;
    return pressure;
  }

  void find_stretches() {
    const Layout& l = grid_.cells;
    of_.assign(l.size, -1);
    const char* solid = grid_.obstacles.solid();
    for (int k = 0; k < l.n[2]; ++k)
      for (int i = 0; i < l.n[0]; ++i)
        for (int j = l.n[1] - 1; j >= 0; --j) {
          const std::ptrdiff_t c = l.index(i, j, k);
          if (solid[c] != 0) continue;
          if (j == l.n[1] - 1 || solid[c + grid_.stride(vertical)] != 0) stretches_.push_back({{i, j, k}});
          ++stretches_.back().cells;
          of_[static_cast<std::size_t>(c)] = static_cast<int>(stretches_.size()) - 1;
        }
  }

  void settle(std::size_t number, double off) {
    Stretch& stretch = stretches_[number];
    if (stretch.settled) return;
    stretch.settled = true;
    stretch.off = off;
    row_.push_back(number);
    if (off == 0.0) return;
    std::array<int, 3> at = stretch.top;
    for (int cell = 0; cell < stretch.cells; ++cell, --at[vertical]) s_.p_c[grid_.cells.index(at)] += off;
  }

  void spread() {
    for (; done_ < row_.size(); ++done_) {
      const Stretch from = stretches_[row_[done_]];
      std::array<int, 3> at = from.top;
      for (int cell = 0; cell < from.cells; ++cell, --at[vertical])
        for (int d = 0; d < grid_.dim; ++d)
          if (d != vertical)
            for (const bool upper : {false, true}) pass(at, d, upper);
    }
  }

  void pass(const std::array<int, 3>& from, int d, bool upper) {
    const Layout& l = grid_.cells;
    std::array<int, 3> to = from;
    to[d] += upper ? 1 : -1;
    if (to[d] < 0 || to[d] >= l.n[d]) {
      if (!l.periodic[d]) return;
      to[d] = (to[d] + l.n[d]) % l.n[d];
    }
    const std::ptrdiff_t here = l.index(from), there = l.index(to);
    if (aperture_[d][upper ? there : here] == 0.0) return;
    const auto number = static_cast<std::size_t>(of_[static_cast<std::size_t>(there)]);
    if (stretches_[number].settled) return;
    // along the lid the columns begin as they do
    if (from[vertical] == l.n[vertical] - 1) return settle(number, stretches_[row_[done_]].off);
    const double expected = s_.p_c[here] + (top(to[0], to[2]) - top(from[0], from[2])), found = s_.p_c[there];
    const double off = expected - found;
    settle(number, std::fabs(off) > rounding * (std::fabs(expected) + std::fabs(found)) ? off : 0.0);
  }

  const Grid& grid_;
  const Scene& scene_;
  const Aperture& aperture_;
  State& s_;
  std::vector<std::vector<double>> tops_;  // pressure along the top [Pa]
  std::vector<Stretch> stretches_;
  std::vector<int> of_;  // number of a cell's stretch by the index of the cell
  std::vector<std::size_t> row_;
  std::size_t done_ = 0;
};

// What the weight on faces has beside that by the mean density, as pressure: where columns differ in it there
// is no rest, and it is the pressure that leaves a flow without divergence.
class BesideTheMean {
 public:
  BesideTheMean(const Grid& grid, const Scene& scene, const Boundary& boundary, const Aperture& aperture,
                const State& s)
      : grid_(grid),
        scene_(scene),
        surface_weight_(grid, scene, boundary),
        step_(grid),
        response_(grid),
        mass_(grid),
        rhs_(grid),
        beside_(grid) {
    surface_weight_.update(s.alpha);
    for (int d = 0; d < grid.dim; ++d) set_faces(aperture[d], s, d);
    set_sides(s);
  }

  Field pressure() {
    if (everywhere(grid_.cells, !any_)) return {};
    const Layout& l = grid_.cells;
    const std::ptrdiff_t s = grid_.stride(vertical);
    linear::Faces faces;
    for (int d = 0; d < grid_.dim; ++d) {
      const Field &step = step_[d], &response = response_[d];
      faces.lower[d] = response.data();
      for_each_place(grid_.inner_faces(d), [&](const std::array<int, 3>& at) {
        const std::ptrdiff_t c = l.index(at);
        rhs_[c] += response[c] * step[c];
        rhs_[c - grid_.stride(d)] -= response[c] * step[c];
        largest_ = std::max(largest_, std::fabs(response[c] * step[c]));
      });
    }
    // A guess by columns, which is all where they agree.
    Range row = grid_.all_cells();
    for (int j = l.n[vertical] - 2; j >= 0; --j) {
      row.lower[vertical] = j;
      row.upper[vertical] = j + 1;
      for_each_place(row, [&](const std::array<int, 3>& at) {
        const std::ptrdiff_t c = l.index(at);
        beside_[c] = beside_[c + s] - step_[vertical][c + s];
      });
    }
    // of all processes, whose solver it is
    const double largest =
        max_over(l, grid_.all_cells(), largest_, [=](std::ptrdiff_t /*cell*/) { return 0.0; });
    linear::ScalarSolver(l, grid_.h)
        .solve(faces, mass_.data(), rhs_.data(), beside_.data(), {rounding * largest, 0.0, most_iterations});
    return std::move(beside_);
  }

 private:
  static constexpr int most_iterations = 200;

  void set_faces(const Field& open, const State& s, int d) {
    const double inv_h2 = 1.0 / (grid_.h[d] * grid_.h[d]);
    const std::ptrdiff_t stride = grid_.stride(d);
    for_each_place(grid_.inner_faces(d), [&](const std::array<int, 3>& at) {
      const std::ptrdiff_t c = grid_.cells.index(at), b = c - stride;
      if (open[c] == 0.0) return;
      const double f_c = 1.0 - 0.5 * (s.f_s[b] + s.f_s[c]),
                   mass = face_mass(s.f_s[b], s.alpha[b], s.f_s[c], s.alpha[c], scene_.liquid.density,
                                    scene_.gas.density);
      response_[d][c] = inv_h2 * f_c * f_c / mass;
    });
    for (const auto& [c, force] : surface_weight_[d]) {
      if (open[c] == 0.0) continue;
      step_[d][c] = force * grid_.h[d];
      any_ = true;
    }
  }

  // What waits beyond an open top weighs on its faces where it is heavier.
  void set_sides(const State& s) {
    grid_.for_each_passing_side([&](int d, bool upper) {
      const std::ptrdiff_t beyond = upper ? grid_.stride(d) : -grid_.stride(d);
      const double inv_h2 = 1.0 / (grid_.h[d] * grid_.h[d]);
      const char* solid = grid_.obstacles.solid();
      for_each_place(grid_.side_cells(d, upper), [&](const std::array<int, 3>& at) {
        const std::ptrdiff_t c = grid_.cells.index(at);
        if (solid != nullptr && solid[c] != 0) return;
        const double f_c = 1.0 - s.f_s[c], inside = f_c * fluid_density(scene_, s, c),
                     outside = (1.0 - s.f_s[c + beyond]) * fluid_density(scene_, s, c + beyond),
                     mass = passing_side_mass(inside, outside);
        const double response = 2.0 * inv_h2 * f_c * f_c / mass;
        mass_[c] += response;
        if (d != vertical || !upper) return;
        beside_[c] = 0.5 * (mass - inside) / f_c * normal_gravity(scene_) * grid_.h[d];
        rhs_[c] += response * beside_[c];
        largest_ = std::max(largest_, std::fabs(response * beside_[c]));
        any_ = any_ || beside_[c] != 0.0;
      });
    });
  }

  const Grid& grid_;
  const Scene& scene_;
  SurfaceWeight surface_weight_;
  FaceField step_;      // of the pressure across a face, from below to above [Pa]
  FaceField response_;  // of the fluid's flux to a step
  Field mass_, rhs_, beside_;
  double largest_ = 0.0;  // of what rhs_ is made of
  bool any_ = false;
};

}  // namespace

void set_hydrostatic_pressure(const Grid& grid, const Scene& scene, const Boundary& boundary, State& s) {
  const Aperture aperture(grid, scene);
  Columns columns(grid, scene, aperture, s);
  columns.fill();
  // Until here as if the tank were empty.
  for (const std::ptrdiff_t c : grid.obstacles.cells()) s.f_s[c] = s.alpha[c] = s.phi[c] = s.p_c[c] = 0.0;
  columns.join();
  const Field beside = BesideTheMean(grid, scene, boundary, aperture, s).pressure();
  if (!beside.empty())
    for_each_place(grid.all_cells(), [&](const std::array<int, 3>& at) {
      const std::ptrdiff_t c = grid.cells.index(at);
      s.p_c[c] += beside[c];
    });
  PressureLevel level(grid, scene);
  if (level.may_be_parted()) {
    ContinuityTree tree(grid);
    tree.grow(aperture);
    level.find_parts(tree);
  }
  if (level.may_be_parted() || !beside.empty()) level.set(s.alpha, s.p_c);
  for (const std::ptrdiff_t c : grid.obstacles.cells()) s.p_c[c] = 0.0;
}

}  // namespace granvof
