#include "reference/demvof/beads/input_files.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace demvof {

namespace {

void check(const std::ofstream& file, const std::string& path) {
  if (!file) throw std::runtime_error("cannot write " + path);
}

// A surface of triangles.
class StlFile {
 public:
  StlFile(std::string path, const char* name) : path_(std::move(path)), name_(name), file_(path_) {
    file_ << "solid " << name_ << '\n';
  }
  // Four corners of a rectangle, one after the other round it.
  void write(const std::array<Vector, 4>& corner) {
    for (const auto& [b, c] : {std::pair{1, 2}, std::pair{2, 3}}) {
      file_ << "facet normal 1 0 0\nouter loop\n";
      for (const int n : {0, b, c}) {
        const Vector& p = corner[static_cast<std::size_t>(n)];
        file_ << fmt::format("vertex {:.9g} {:.9g} {:.9g}\n", p[0], p[1], p[2]);
      }
      file_ << "endloop\nendfacet\n";
    }
  }
  void end() {
    file_ << "endsolid " << name_ << '\n';
    file_.flush();
    check(file_, path_);
  }

 private:
  std::string path_, name_;
  std::ofstream file_;
};

}  // namespace

WorkBox work_box(const BeadSettings& s) {
  const double margin = 2.0 * s.diameter;
  WorkBox box;
  const double along = s.periodic_length ? 0.0 : margin, across = s.periodic_depth ? 0.0 : margin;
  box.lower = {-along, -margin, -across};
  // The gate rises by its own height before it is taken away.
  const double height = std::max(s.tank[1], s.gate ? 2.5 * s.gate_height : 0.0);
  box.upper = {s.tank[0] + along, height + margin, s.tank[2] + across};
  return box;
}

void write_beads(const std::string& path, const BeadSettings& s, const BeadState& mobile,
                 const std::vector<double>& frozen_positions) {
  const WorkBox box = work_box(s);
  const std::size_t frozen = frozen_positions.size() / 3;
  std::ofstream file(path);
  file << fmt::format("beads\n\n{} atoms\n{} atom types\n\n", mobile.count() + frozen, bead_types);
  file << fmt::format("{} {} xlo xhi\n{} {} ylo yhi\n{} {} zlo zhi\n\nAtoms\n\n", box.lower[0], box.upper[0],
                      box.lower[1], box.upper[1], box.lower[2], box.upper[2]);
  std::size_t id = 0;
  const auto write = [&](const std::vector<double>& x, int type) {
    for (std::size_t i = 0; i + 2 < x.size(); i += 3) {
      file << fmt::format("{} {} {} {} {:.9g} {:.9g} {:.9g}\n", ++id, type, s.diameter, s.density, x[i],
                          x[i + 1], x[i + 2]);
    }
  };
  write(mobile.position, 1);
  write(frozen_positions, 2);
  file.flush();
  check(file, path);
}

void write_gate(const std::string& path, const BeadSettings& s) {
  const double x = s.gate.value();
  // LIGGGHTS refuses corners that lie on the periodic boundary, and a few long triangles beside it; the slit
  // that remains is far below a bead.
  const double near = 1e-3 * s.diameter, far = s.tank[2] - near;
  const int across = std::max(1, static_cast<int>(std::lround(s.tank[2] / (3.0 * s.diameter))));
  const int up = std::max(1, static_cast<int>(std::lround(s.gate_height / (3.0 * s.diameter))));
  const auto corner = [&](int j, int k) {
    return Vector{x, s.gate_height * j / up, near + (far - near) * k / across};
  };
  StlFile file(path, "gate");
  for (int j = 0; j < up; ++j) {
    for (int k = 0; k < across; ++k)
      file.write({corner(j, k), corner(j + 1, k), corner(j + 1, k + 1), corner(j, k + 1)});
  }
  file.end();
}

void write_obstacles(const std::string& path, const BeadSettings& s) {
  const Obstacles& o = s.obstacles;
  const bool flat = o.cells[2] == 1;
  // Through a depth that is joined to itself without an end, which would push as an edge does: in three
  // strips at least, none its own neighbour, the last over the seam with the centres of its triangles before
  // it.
  const int least = s.periodic_depth ? 3 : 1;
  const int strips =
      flat ? std::max(least, static_cast<int>(std::lround(s.tank[2] / (3.0 * s.diameter)))) : o.cells[2];
  const double before = s.periodic_depth ? 0.2 : 0.0;
  const auto corner = [&](int i, int j, int k) {
    return Vector{i * o.spacing[0], j * o.spacing[1], s.tank[2] * (k + before) / strips};
  };
  StlFile file(path, "obstacles");
  // The face below a cell along a direction, if an obstacle is on one side of it alone.
  const auto face = [&](std::size_t d, const std::array<int, 3>& cell, int k) {
    std::array<int, 3> below = cell;
    --below[d];
    if (cell[d] == 0 || o.fill(cell) == o.fill(below)) return;
    const int i = cell[0], j = cell[1];
    if (d == 0)
      file.write({corner(i, j, k), corner(i, j + 1, k), corner(i, j + 1, k + 1), corner(i, j, k + 1)});
    if (d == 1)
      file.write({corner(i, j, k), corner(i + 1, j, k), corner(i + 1, j, k + 1), corner(i, j, k + 1)});
    if (d == 2)
      file.write({corner(i, j, k), corner(i + 1, j, k), corner(i + 1, j + 1, k), corner(i, j + 1, k)});
  };
  for (int k = 0; k < strips; ++k)
    for (int j = 0; j < o.cells[1]; ++j)
      for (int i = 0; i < o.cells[0]; ++i)
        for (std::size_t d = 0; d < (flat ? 2U : 3U); ++d) face(d, {i, j, flat ? 0 : k}, k);
  file.end();
}

}  // namespace demvof
