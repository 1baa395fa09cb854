#include "solver/operators/continuity_tree.hpp"

#include <array>

#include "solver/operators/flux_balance.hpp"

namespace granvof {

void ContinuityTree::grow(const Aperture& aperture) {
  const Layout& l = grid_.cells;
  steps_.clear();
  constexpr int nowhere = -1;
  part_of_.assign(l.size, nowhere);
  std::vector<char> drains;             // of every part
  std::vector<std::array<int, 3>> row;  // cells in the order in which they were reached
  row.reserve(l.count());
  const auto reach = [&](const std::array<int, 3>& at) {
    int& part = part_of_[static_cast<std::size_t>(l.index(at))];
    if (part != nowhere) return false;
    part = static_cast<int>(drains.size()) - 1;
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
            if (!l.periodic[d] || l.is_split(d)) continue;
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
  drains.push_back(1);  // all that the fluid leaves is one
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
  const char* solid = grid_.obstacles.solid();
  for_each_place(grid_.all_cells(), [&](const std::array<int, 3>& at) {
    const std::ptrdiff_t c = l.index(at);
    if (part_of_[static_cast<std::size_t>(c)] != nowhere || (solid != nullptr && solid[c] != 0)) return;
    drains.push_back(0);
    reach(at);
    spread();
  });
  if (!l.is_cut()) {
    sealed_parts_ = static_cast<int>(drains.size()) - 1;
    sealed_of_.clear();
    for (int part = 0; part <= sealed_parts_; ++part) sealed_of_.push_back(part - 1);
    return;
  }
  if (!parts_) parts_.emplace(grid_);
  parts_->join(part_of_, drains, aperture);
  sealed_of_ = parts_->sealed_of();
  sealed_parts_ = parts_->sealed();
}

void ContinuityTree::close(const Boundary& boundary, const FaceField& flux_s, FaceField& flux_c) {
  gain_.fill(0.0);
  subtract_divergence(grid_, 1.0, flux_s, gain_);
  subtract_divergence(grid_, 1.0, flux_c, gain_);
  if (parts_) parts_->even_out(gain_, flux_c);
  for (auto at = steps_.rbegin(); at != steps_.rend(); ++at) {
    const Step& step = *at;
    const double gain = gain_[step.cell];
    flux_c[step.direction][step.face] += step.sign * grid_.h[step.direction] * gain;
    if (step.next >= 0) gain_[step.next] += gain;
  }
  for (int d = 0; d < grid_.dim; ++d) boundary.exchange(flux_c[d]);
}

}  // namespace granvof
