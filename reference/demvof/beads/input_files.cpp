#include "reference/demvof/beads/input_files.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>

namespace demvof {

namespace {

void check(const std::ofstream& file, const std::string& path) {
  if (!file) throw std::runtime_error("cannot write " + path);
}

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
  std::ofstream file(path);
  file << "solid gate\n";
  const auto triangle = [&](const Vector& a, const Vector& b, const Vector& c) {
    file << "facet normal 1 0 0\nouter loop\n";
    for (const Vector& p : {a, b, c}) file << fmt::format("vertex {:.9g} {:.9g} {:.9g}\n", p[0], p[1], p[2]);
    file << "endloop\nendfacet\n";
  };
  for (int j = 0; j < up; ++j) {
    for (int k = 0; k < across; ++k) {
      triangle(corner(j, k), corner(j + 1, k), corner(j + 1, k + 1));
      triangle(corner(j, k), corner(j + 1, k + 1), corner(j, k + 1));
    }
  }
  file << "endsolid gate\n";
  file.flush();
  check(file, path);
}

}  // namespace demvof
