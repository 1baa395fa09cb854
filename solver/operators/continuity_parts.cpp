#include "solver/operators/continuity_parts.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace granvof {

// visit(lower part, upper part, cell of this process) for the first open face of every pair of parts on a
// seam: both its processes find the same faces in the same order.
template <typename Visit>
void ContinuityParts::for_each_link(bool upper, const Aperture& aperture, Visit&& visit) const {
  const Layout& l = grid_.cells;
  if (!l.seam(cut_, upper)) return;
  Range faces = grid_.all_cells();
  faces.lower[cut_] = upper ? l.n[cut_] : 0;
  faces.upper[cut_] = faces.lower[cut_] + 1;
  const std::ptrdiff_t s = l.stride[cut_];
  std::set<std::pair<int, int>> seen;
  for_each_place(faces, [&](const std::array<int, 3>& at) {
    const std::ptrdiff_t face = l.index(at);
    if (aperture[cut_][face] == 0.0) return;
    const std::pair<int, int> parts{static_cast<int>(label_[face - s]), static_cast<int>(label_[face])};
    if (seen.insert(parts).second) visit(parts.first, parts.second, upper ? face - s : face);
  });
}

// Those of all processes, one after another; where each one's begin.
std::vector<ContinuityParts::Link> ContinuityParts::gather(const std::vector<Link>& mine,
                                                           std::vector<std::size_t>& begins) const {
  const Communicator& processes = *grid_.cells.communicator;
  std::vector<double> counts(static_cast<std::size_t>(processes.size()), 0.0);
  counts[static_cast<std::size_t>(processes.rank())] = static_cast<double>(mine.size());
  processes.sum(counts);
  std::vector<std::size_t> sizes;
  begins.assign(1, 0);
  for (const double count : counts) {
    sizes.push_back(static_cast<std::size_t>(count) * sizeof(Link));
    begins.push_back(begins.back() + static_cast<std::size_t>(count));
  }
  std::vector<Link> all(begins.back());
  processes.gather(std::as_bytes(std::span(mine)), sizes, std::as_writable_bytes(std::span(all)), true);
  return all;
}

void ContinuityParts::join(const std::vector<int>& part_of, const std::vector<char>& drains,
                           const Aperture& aperture) {
  const Layout& l = grid_.cells;
  const Communicator& processes = *l.communicator;
  const auto size = static_cast<std::size_t>(processes.size()),
             own = static_cast<std::size_t>(processes.rank());
  for (int d = 0; d < 3; ++d)
    if (l.is_split(d)) cut_ = d;
  std::vector<double> counts(size, 0.0);
  counts[own] = static_cast<double>(drains.size());
  processes.sum(counts);
  double before = 0.0, total = 0.0;
  for (std::size_t p = 0; p < size; ++p) {
    if (p == own) before = total;
    total += counts[p];
  }
  first_ = static_cast<int>(before);
  gain_.assign(static_cast<std::size_t>(total), 0.0);
  std::vector<double> all_drains(gain_.size(), 0.0);
  for (std::size_t part = 0; part < drains.size(); ++part)
    all_drains[static_cast<std::size_t>(first_) + part] = drains[part] != 0 ? 1.0 : 0.0;
  processes.sum(all_drains);

  cells_.assign(drains.size(), {});
  for_each_place(grid_.all_cells(), [&](const std::array<int, 3>& at) {
    const std::ptrdiff_t c = l.index(at);
    const int part = part_of[static_cast<std::size_t>(c)];
    if (part < 0) return;
    label_[c] = first_ + part;
    cells_[static_cast<std::size_t>(part)].push_back(c);
  });
  exchange(l, label_.data());
  std::vector<Link> mine;
  std::vector<std::size_t> begins;
  for_each_link(false, aperture, [&](int lower, int upper, std::ptrdiff_t) {
    mine.push_back({lower, upper});
  });
  const std::vector<Link> links = gather(mine, begins);
  // A link is the process's above it, as its face is.
  const auto places = [&](bool upper, std::size_t process) {
    std::vector<Place> beside;
    std::size_t link = begins[process];
    for_each_link(upper, aperture, [&](int, int, std::ptrdiff_t cell) { beside.push_back({link++, cell}); });
    return beside;
  };
  above_ = places(false, own);
  below_ = places(true, (own + 1) % size);
  flux_.assign(links.size(), 0.0);
  grow(links, all_drains);
}

// Outwards from the parts that drain; from the first one of what none of them reaches, where the gains of all
// sum to zero.
void ContinuityParts::grow(const std::vector<Link>& links, const std::vector<double>& drains) {
  std::vector<std::vector<std::size_t>> links_of(drains.size());
  for (std::size_t link = 0; link < links.size(); ++link)
    for (const int part : {links[link].lower, links[link].upper})
      links_of[static_cast<std::size_t>(part)].push_back(link);
  steps_.clear();
  std::vector<char> reached(drains.size(), 0);
  std::vector<int> row;
  std::size_t done = 0;
  const auto reach = [&](int part) {
    char& seen = reached[static_cast<std::size_t>(part)];
    if (seen != 0) return false;
    seen = 1;
    row.push_back(part);
    return true;
  };
  const auto spread = [&] {
    for (; done < row.size(); ++done) {
      const int to = row[done];
      for (const std::size_t link : links_of[static_cast<std::size_t>(to)]) {
        const bool up = links[link].upper == to;
        const int from = up ? links[link].lower : links[link].upper;
        if (reach(from)) steps_.push_back({from, to, link, up ? 1.0 : -1.0});
      }
    }
  };
  for (std::size_t part = 0; part < drains.size(); ++part)
    if (drains[part] != 0.0) reach(static_cast<int>(part));
  spread();
  sealed_of_.assign(cells_.size(), -1);
  sealed_ = 0;
  for (std::size_t part = 0; part < drains.size(); ++part) {
    const std::size_t begin = done;
    if (!reach(static_cast<int>(part))) continue;
    spread();
    for (std::size_t at = begin; at < done; ++at) {
      const int own = row[at] - first_;
      if (own >= 0 && own < static_cast<int>(sealed_of_.size()))
        sealed_of_[static_cast<std::size_t>(own)] = sealed_;
    }
    ++sealed_;
  }
}

void ContinuityParts::even_out(Field& gain, FaceField& flux_c) {
  std::fill(gain_.begin(), gain_.end(), 0.0);
  for (std::size_t part = 0; part < cells_.size(); ++part) {
    double& sum = gain_[static_cast<std::size_t>(first_) + part];
    for (const std::ptrdiff_t c : cells_[part]) sum += gain[c];
  }
  grid_.cells.communicator->sum(gain_);
  std::fill(flux_.begin(), flux_.end(), 0.0);
  for (auto at = steps_.rbegin(); at != steps_.rend(); ++at) {
    const double handed = gain_[static_cast<std::size_t>(at->from)];
    flux_[at->link] = at->sign * handed;  // along the axis, in gains of a cell
    gain_[static_cast<std::size_t>(at->to)] += handed;
  }
  for (const Place& beside : above_) {
    flux_c[cut_][beside.cell] += grid_.h[cut_] * flux_[beside.link];
    gain[beside.cell] += flux_[beside.link];
  }
  for (const Place& beside : below_) gain[beside.cell] -= flux_[beside.link];
}

}  // namespace granvof
