#include "solver/operators/continuity_closure.hpp"

#include <vector>

#include "solver/operators/flux_balance.hpp"

namespace granvof {
namespace {

// Flux through the lower end of every item of a row that takes away what the items gain, in units of the
// gain. Items are closed off below where !passable[i]; the gains between two such ends sum to zero but for
// rounding. A row whose ends are joined carries no flux in the mean, or none where it is closed off.
std::vector<double> flux_of_gains(const std::vector<double>& gain, const std::vector<bool>& passable,
                                  bool joined) {
  const std::size_t n = gain.size();
  std::vector<double> flux(n, 0.0);
  for (std::size_t i = 1; i < n; ++i) flux[i] = flux[i - 1] + gain[i - 1];
  double offset = 0.0;
  bool closed_off = false;
  if (joined) {
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      sum += flux[i];
      if (passable[i]) continue;
      closed_off = true;
      offset = flux[i];
    }
    if (!closed_off) offset = sum / static_cast<double>(n);
  }
  for (std::size_t i = 0; i < n; ++i) flux[i] = passable[i] ? flux[i] - offset : 0.0;
  return flux;
}

class Closure {
 public:
  Closure(const Grid& grid, const FaceField& flux_s, FaceField& flux_c)
      : grid_(grid), n_(grid.cells.whole), flux_c_(flux_c), gain_(grid) {
    subtract_divergence(grid, 1.0, flux_s, gain_);
    subtract_divergence(grid, 1.0, flux_c, gain_);
  }

  // Leaves every column without gain in the sum over its cells. Every process does it for all columns of the
  // tank, and changes what it has of them.
  void even_out_columns(const Aperture& aperture) {
    count_open_rows(aperture);
    columns_.assign(static_cast<std::size_t>(n_[0]) * static_cast<std::size_t>(n_[2]), 0.0);
    const Layout& l = grid_.cells;
    for (int k = 0; k < l.n[2]; ++k)
      for (int j = 0; j < l.n[vertical]; ++j)
        for (int i = 0; i < l.n[0]; ++i) column(l.first[0] + i, l.first[2] + k) += gain_[l.index(i, j, k)];
    if (l.is_cut()) l.communicator->sum(columns_);
    if (grid_.dim == 3) even_out_along_z();
    even_out_along_x();
  }

  // From the floor to the top of every column.
  void close_columns() {
    const std::ptrdiff_t s = grid_.stride(vertical);
    const double h = grid_.h[vertical];
    double *q = flux_c_[vertical].data(), *gain = gain_.data();
    const int last = grid_.side(vertical, true).passes_fluid ? n_[vertical] : n_[vertical] - 1;
    Range row = grid_.all_cells();
    for (int j = 1; j <= last; ++j) {
      row.lower[vertical] = j;
      row.upper[vertical] = j + 1;
      for_each(grid_.cells, row, [=](std::ptrdiff_t c) {
        q[c] += h * gain[c - s];
        gain[c] += gain[c - s];
      });
    }
  }

 private:
  double& column(int i, int k) { return columns_[static_cast<std::size_t>(i + k * n_[0])]; }
  double& open_rows(int i) { return open_rows_[static_cast<std::size_t>(i)]; }

  // A gate rises from the floor: the rows below its edge are open.
  void count_open_rows(const Aperture& aperture) {
    open_rows_.assign(static_cast<std::size_t>(n_[0]), 0.0);
    const Layout& l = grid_.cells;
    for (int i = l.seam(0, false) ? 0 : 1; i < l.n[0]; ++i)
      for (int j = 0; j < l.n[vertical]; ++j)
        open_rows(l.first[0] + i) += aperture[0][l.index(i, j, 0)] > 0.0 ? 1.0 : 0.0;
    if (l.is_split(0)) l.communicator->sum(open_rows_);
  }

  // Index of the lowest cell of a column of the tank, -1 where another process has it.
  std::ptrdiff_t foot(int i, int k) const {
    const Layout& l = grid_.cells;
    const int x = i - l.first[0], z = k - l.first[2];
    return x < 0 || x >= l.n[0] || z < 0 || z >= l.n[2] ? -1 : l.index(x, 0, z);
  }

  // Lets `flux` (of the gain of a whole column) pass from the neighbour below in direction d into column (i,
  // k), in equal parts through the lowest `rows` faces.
  void pass(int d, int i, int k, double rows, double flux) {
    std::array<int, 3> below{i, 0, k};
    below[d] = (below[d] + n_[d] - 1) % n_[d];
    const std::ptrdiff_t to = foot(i, k), from = foot(below[0], below[2]);
    const double part = flux / rows;
    for (int j = 0; j < rows; ++j) {
      const std::ptrdiff_t at = j * grid_.stride(vertical);
      if (to >= 0) {
        flux_c_[d][to + at] += grid_.h[d] * part;
        gain_[to + at] += part;
      }
      if (from >= 0) gain_[from + at] -= part;
    }
    column(i, k) += flux;
    column(below[0], below[2]) -= flux;
  }

  // Where each part of the tank begins that a closed gate cuts off along x, and where the last one ends.
  std::vector<int> parts() {
    std::vector<int> begins{0};
    for (int i = 1; i < n_[0] && !grid_.cells.periodic[0]; ++i)
      if (open_rows(i) == 0.0) begins.push_back(i);
    begins.push_back(n_[0]);
    return begins;
  }

  void even_out_along_z() {
    const bool joined = grid_.cells.periodic[2];
    std::vector<bool> passable(static_cast<std::size_t>(n_[2]), true);
    passable[0] = joined;
    const std::vector<int> begins = parts();
    for (std::size_t part = 0; part + 1 < begins.size(); ++part) {
      std::vector<double> gain(passable.size(), 0.0);
      for (int k = 0; k < n_[2]; ++k)
        for (int i = begins[part]; i < begins[part + 1]; ++i)
          gain[static_cast<std::size_t>(k)] += column(i, k);
      const std::vector<double> flux = flux_of_gains(gain, passable, joined);
      const int wide = begins[part + 1] - begins[part];
      for (int k = joined ? 0 : 1; k < n_[2]; ++k)
        for (int i = begins[part]; i < begins[part + 1]; ++i)
          pass(2, i, k, n_[vertical], flux[static_cast<std::size_t>(k)] / wide);
    }
  }

  void even_out_along_x() {
    std::vector<bool> passable(static_cast<std::size_t>(n_[0]));
    for (int i = 0; i < n_[0]; ++i) passable[static_cast<std::size_t>(i)] = open_rows(i) > 0.0;
    for (int k = 0; k < n_[2]; ++k) {
      std::vector<double> gain(passable.size());
      for (int i = 0; i < n_[0]; ++i) gain[static_cast<std::size_t>(i)] = column(i, k);
      const std::vector<double> flux = flux_of_gains(gain, passable, grid_.cells.periodic[0]);
      for (int i = 0; i < n_[0]; ++i)
        if (open_rows(i) > 0.0) pass(0, i, k, open_rows(i), flux[static_cast<std::size_t>(i)]);
    }
  }

  const Grid& grid_;
  std::array<int, 3> n_;  // of the whole tank
  FaceField& flux_c_;
  Field gain_;                     // -div of both fluxes [1/s]
  std::vector<double> open_rows_;  // of the faces below column i along x, of the whole tank
  std::vector<double> columns_;    // sum of gain_ over each column of the whole tank
};

}  // namespace

void close_continuity(const Grid& grid, const Boundary& boundary, const Aperture& aperture,
                      const FaceField& flux_s, FaceField& flux_c) {
  Closure closure(grid, flux_s, flux_c);
  if (!grid.side(vertical, true).passes_fluid) closure.even_out_columns(aperture);
  closure.close_columns();
  for (int d = 0; d < grid.dim; ++d) boundary.exchange(flux_c[d]);
}

}  // namespace granvof
