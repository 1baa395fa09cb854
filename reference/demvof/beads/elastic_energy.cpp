#include "reference/demvof/beads/elastic_energy.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "reference/demvof/beads/input_files.hpp"

namespace demvof {

namespace {

// Beads by boxes at least one diameter wide, so that whoever touches is in the same or a neighbouring box.
class Boxes {
 public:
  Boxes(const BeadSettings& s, const std::vector<double>& position) : s_(s), position_(position) {
    const WorkBox work = work_box(s);
    lower_ = work.lower;
    std::size_t total = 1;
    for (std::size_t d = 0; d < 3; ++d) {
      count_[d] = std::max(1, static_cast<int>((work.upper[d] - work.lower[d]) / s.diameter));
      size_[d] = (work.upper[d] - work.lower[d]) / count_[d];
      total *= static_cast<std::size_t>(count_[d]);
    }
    first_.assign(total, -1);
    next_.assign(position.size() / 3, -1);
    for (std::size_t bead = 0; bead < next_.size(); ++bead) {
      int& first = first_[index(place(bead))];
      next_[bead] = first;
      first = static_cast<int>(bead);
    }
  }

  // visit(other) for all beads after `bead` in the same and the neighbouring boxes, each once.
  template <class Visit>
  void neighbours(std::size_t bead, Visit&& visit) const {
    const std::array<int, 3> here = place(bead);
    std::array<int, 27> seen{};
    int boxes = 0;
    for (int n = 0; n < 27; ++n) {
      const std::array<int, 3> step{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
      std::array<int, 3> there = here;
      bool inside = true;
      for (std::size_t d = 0; d < 3; ++d) {
        there[d] += step[d];
        if (periodic(d)) there[d] = (there[d] + count_[d]) % count_[d];
        inside = inside && there[d] >= 0 && there[d] < count_[d];
      }
      if (!inside) continue;
      const auto box = static_cast<int>(index(there));
      // In a direction of fewer than three boxes a neighbour is met from both sides.
      if (std::find(seen.begin(), seen.begin() + boxes, box) != seen.begin() + boxes) continue;
      seen[static_cast<std::size_t>(boxes++)] = box;
      for (int other = first_[static_cast<std::size_t>(box)]; other >= 0;
           other = next_[static_cast<std::size_t>(other)])
        if (static_cast<std::size_t>(other) > bead) visit(static_cast<std::size_t>(other));
    }
  }

  // Of the nearest images [m].
  double distance(std::size_t a, std::size_t b) const {
    std::array<double, 3> apart{};
    for (std::size_t d = 0; d < 3; ++d) {
      apart[d] = position_[3 * a + d] - position_[3 * b + d];
      if (periodic(d)) apart[d] -= s_.tank[d] * std::round(apart[d] / s_.tank[d]);
    }
    return std::hypot(apart[0], apart[1], apart[2]);
  }

 private:
  const BeadSettings& s_;
  const std::vector<double>& position_;
  Vector lower_{}, size_{};
  std::array<int, 3> count_{};
  std::vector<int> first_, next_;

  bool periodic(std::size_t d) const {
    return (d == 0 && s_.periodic_length) || (d == 2 && s_.periodic_depth);
  }
  std::array<int, 3> place(std::size_t bead) const {
    std::array<int, 3> box{};
    for (std::size_t d = 0; d < 3; ++d) {
      const int n = static_cast<int>(std::floor((position_[3 * bead + d] - lower_[d]) / size_[d]));
      box[d] = periodic(d) ? (n % count_[d] + count_[d]) % count_[d] : std::clamp(n, 0, count_[d] - 1);
    }
    return box;
  }
  std::size_t index(const std::array<int, 3>& box) const {
    return static_cast<std::size_t>((box[2] * count_[1] + box[1]) * count_[0] + box[0]);
  }
};

// visit(distance) for what a bead at x faces of obstacles, in its cell's neighbours: their faces, and the
// edges and corners that stand out.
template <class Visit>
void for_each_obstacle(const Obstacles& o, const double* x, Visit&& visit) {
  const std::size_t directions = o.cells[2] == 1 ? 2 : 3;
  std::array<int, 3> here{};
  for (std::size_t d = 0; d < directions; ++d)
    here[d] = std::clamp(static_cast<int>(std::floor(x[d] / o.spacing[d])), 0, o.cells[d] - 1);
  const int layers = directions == 3 ? 27 : 9;
  for (int n = 0; n < layers; ++n) {
    const std::array<int, 3> step{n % 3 - 1, n / 3 % 3 - 1, directions == 3 ? n / 9 - 1 : 0};
    std::array<int, 3> there = here;
    double square = 0.0;
    for (std::size_t d = 0; d < directions; ++d) {
      there[d] += step[d];
      if (step[d] == 0) continue;
      const double away = step[d] < 0 ? x[d] - here[d] * o.spacing[d] : (here[d] + 1) * o.spacing[d] - x[d];
      square += away * away;
    }
    if (there == here || !o.fill(there)) continue;
    // Behind a nearer obstacle it is not met.
    bool stands_out = true;
    for (int m = 1; m < 7; ++m) {
      std::array<int, 3> between = here;
      for (std::size_t d = 0; d < 3; ++d)
        if ((m >> d & 1) != 0) between[d] = there[d];
      stands_out = stands_out && (between == here || between == there || !o.fill(between));
    }
    if (stands_out) visit(std::sqrt(square));
  }
}

}  // namespace

ElasticEnergy elastic_energy(const BeadSettings& s, const std::vector<double>& mobile,
                             const std::vector<double>& frozen, std::optional<double> gate_edge) {
  const double modulus = s.law.young / (2.0 * (1.0 - s.law.poisson * s.law.poisson));
  const auto stored = [&](double overlap, double radius) {
    return overlap > 0.0 ? 8.0 / 15.0 * modulus * std::sqrt(radius) * std::pow(overlap, 2.5) : 0.0;
  };
  std::vector<double> all = mobile;
  all.insert(all.end(), frozen.begin(), frozen.end());
  const Boxes boxes(s, all);
  ElasticEnergy energy;
  const double d = s.diameter;
  for (std::size_t bead = 0; 3 * bead < mobile.size(); ++bead) {
    boxes.neighbours(
        bead, [&](std::size_t other) { energy.beads += stored(d - boxes.distance(bead, other), 0.25 * d); });
    const double* x = &mobile[3 * bead];
    const auto plane = [&](double away) { energy.walls += stored(0.5 * d - away, 0.5 * d); };
    if (!s.periodic_length) {
      plane(x[0]);
      plane(s.tank[0] - x[0]);
    }
    plane(x[1]);
    plane(s.tank[1] - x[1]);
    if (!s.periodic_depth) {
      plane(x[2]);
      plane(s.tank[2] - x[2]);
    }
    if (!s.obstacles.closed.empty()) for_each_obstacle(s.obstacles, x, plane);
    if (s.gate && gate_edge && x[1] > *gate_edge) plane(std::abs(x[0] - *s.gate));
  }
  return energy;
}

}  // namespace demvof
