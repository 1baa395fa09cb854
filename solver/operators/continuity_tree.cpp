#include "solver/operators/continuity_tree.hpp"

#include <array>

#include "solver/operators/flux_balance.hpp"

namespace granvof {

void ContinuityTree::grow(const Aperture& aperture) {
  const Layout& l = grid_.cells;
  steps_.clear();
  std::vector<char> reached(l.size, 0);
  std::vector<std::array<int, 3>> row;  // cells in the order in which they were reached
  row.reserve(l.count());
  const auto reach = [&](const std::array<int, 3>& at) {
    char& seen = reached[static_cast<std::size_t>(l.index(at))];
    if (seen != 0) return false;
    seen = 1;
    row.push_back(at);
    return true;
  };
  std::size_t done = 0;
  const auto spread = [&] {
    for (; done < row.size(); ++done) {
      const std::array<int, 3> from = row[done];
      for (int d = 0; d < grid_.dim; ++d) {
        for (const bool upper : {false, true}) {
          std::array<int, 3> to = from;
          to[d] += upper ? 1 : -1;
          if (to[d] < 0 || to[d] >= l.n[d]) {
            if (!l.periodic[d]) continue;
            to[d] = (to[d] + l.n[d]) % l.n[d];
          }
          // The face at the lower end of the upper of the two; on the seam that of the first cell.
          const std::ptrdiff_t face = l.index(upper ? to : from);
          if (aperture[d][face] > 0.0 && reach(to))
            steps_.push_back({l.index(to), l.index(from), d, face, upper ? -1.0 : 1.0});
        }
      }
    }
  };
  for (int d = 0; d < grid_.dim; ++d) {
    for (const bool upper : {false, true}) {
      if (!grid_.side(d, upper).passes_fluid) continue;
      for_each_place(grid_.side_cells(d, upper), [&](const std::array<int, 3>& at) {
        const std::ptrdiff_t face = l.index(at) + (upper ? l.stride[d] : 0);
        if (aperture[d][face] > 0.0 && reach(at))
          steps_.push_back({l.index(at), -1, d, face, upper ? 1.0 : -1.0});
      });
    }
  }
  spread();
  for_each_place(grid_.all_cells(), [&](const std::array<int, 3>& at) {
    if (reach(at)) spread();
  });
}

void ContinuityTree::close(const Boundary& boundary, const FaceField& flux_s, FaceField& flux_c) {
  gain_.fill(0.0);
  subtract_divergence(grid_, 1.0, flux_s, gain_);
  subtract_divergence(grid_, 1.0, flux_c, gain_);
  for (auto at = steps_.rbegin(); at != steps_.rend(); ++at) {
    const Step& step = *at;
    const double gain = gain_[step.cell];
    flux_c[step.direction][step.face] += step.sign * grid_.h[step.direction] * gain;
    if (step.next >= 0) gain_[step.next] += gain;
  }
  for (int d = 0; d < grid_.dim; ++d) boundary.exchange(flux_c[d]);
}

}  // namespace granvof
