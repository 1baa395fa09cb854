#include "reference/demvof/preparation/disperse.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace demvof {

namespace {

constexpr int most_sweeps = 5000;
constexpr double tolerated_overlap = 0.01;  // diameters
constexpr double clearance = 1.002;         // distance aimed at, in diameters

class Cloud {
 public:
  Cloud(const Vector& lower, const Vector& upper, bool periodic, double diameter)
      : lower_(lower), upper_(upper), periodic_(periodic), reach_(clearance * diameter), diameter_(diameter) {
    for (std::size_t d = 0; d < 3; ++d) {
      bins_[d] = std::max(1, static_cast<int>((upper[d] - lower[d]) / reach_));
    }
    // Fewer than three bins round a periodic direction would meet the same neighbour twice.
    if (periodic_ && bins_[2] < 3) bins_[2] = 1;
  }

  // One sweep over all overlapping pairs; returns the deepest overlap met.
  double push_apart(std::vector<double>& x) {
    fill_bins(x);
    double deepest = 0.0;
    for (int a = 0; a < static_cast<int>(next_.size()); ++a) {
      const auto bin = bin_of(x, a);
      for (int dk = -1; dk <= 1; ++dk) {
        int k = bin[2] + dk;
        if (bins_[2] == 1 && dk != 0) continue;
        if (k < 0 || k >= bins_[2]) {
          if (!periodic_) continue;
          k = (k + bins_[2]) % bins_[2];
        }
        for (int j = std::max(0, bin[1] - 1); j <= std::min(bins_[1] - 1, bin[1] + 1); ++j) {
          for (int i = std::max(0, bin[0] - 1); i <= std::min(bins_[0] - 1, bin[0] + 1); ++i) {
            for (int b = first_[slot(i, j, k)]; b >= 0; b = next_[static_cast<std::size_t>(b)]) {
              if (b > a) deepest = std::max(deepest, push_pair(x, a, b));
            }
          }
        }
      }
    }
    keep_inside(x);
    return deepest;
  }

 private:
  std::size_t slot(int i, int j, int k) const {
    return static_cast<std::size_t>(k * bins_[1] + j) * static_cast<std::size_t>(bins_[0]) +
           static_cast<std::size_t>(i);
  }
  std::array<int, 3> bin_of(const std::vector<double>& x, int bead) const {
    std::array<int, 3> bin{};
    for (std::size_t d = 0; d < 3; ++d) {
      const double share = (x[3 * static_cast<std::size_t>(bead) + d] - lower_[d]) / (upper_[d] - lower_[d]);
      bin[d] = std::clamp(static_cast<int>(share * bins_[d]), 0, bins_[d] - 1);
    }
    return bin;
  }
  void fill_bins(const std::vector<double>& x) {
    first_.assign(static_cast<std::size_t>(bins_[0]) * static_cast<std::size_t>(bins_[1]) *
                      static_cast<std::size_t>(bins_[2]),
                  -1);
    next_.assign(x.size() / 3, -1);
    for (int bead = 0; bead < static_cast<int>(next_.size()); ++bead) {
      const auto bin = bin_of(x, bead);
      int& head = first_[slot(bin[0], bin[1], bin[2])];
      next_[static_cast<std::size_t>(bead)] = head;
      head = bead;
    }
  }
  double push_pair(std::vector<double>& x, int a, int b) const {
    double* pa = &x[3 * static_cast<std::size_t>(a)];
    double* pb = &x[3 * static_cast<std::size_t>(b)];
    Vector apart{};
    double square = 0.0;
    for (std::size_t d = 0; d < 3; ++d) {
      apart[d] = pa[d] - pb[d];
      if (d == 2 && periodic_) {
        const double depth = upper_[2] - lower_[2];
        apart[d] -= depth * std::round(apart[d] / depth);
      }
      square += apart[d] * apart[d];
    }
    if (square >= reach_ * reach_) return 0.0;
    const double distance = std::sqrt(square);
    const double share = distance > 0.0 ? 0.5 * (reach_ - distance) / distance : 0.0;
    for (std::size_t d = 0; d < 3; ++d) {
      pa[d] += share * apart[d];
      pb[d] -= share * apart[d];
    }
    return diameter_ - distance;
  }
  void keep_inside(std::vector<double>& x) const {
    for (std::size_t n = 0; n < x.size(); ++n) {
      const std::size_t d = n % 3;
      if (d == 2 && periodic_) {
        const double depth = upper_[2] - lower_[2];
        x[n] -= depth * std::floor((x[n] - lower_[2]) / depth);
      } else {
        x[n] = std::clamp(x[n], lower_[d] + 0.5 * diameter_, upper_[d] - 0.5 * diameter_);
      }
    }
  }

  Vector lower_, upper_;
  bool periodic_;
  double reach_, diameter_;
  std::array<int, 3> bins_{};
  std::vector<int> first_, next_;
};

}  // namespace

std::vector<double> disperse_beads(std::size_t count, const Vector& lower, const Vector& upper,
                                   bool periodic_depth, double diameter, std::mt19937& random) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::vector<double> x(3 * count);
  for (std::size_t n = 0; n < x.size(); ++n) {
    const std::size_t d = n % 3;
    const double margin = d == 2 && periodic_depth ? 0.0 : 0.5 * diameter;
    x[n] = lower[d] + margin + share(random) * (upper[d] - lower[d] - 2.0 * margin);
  }
  Cloud cloud(lower, upper, periodic_depth, diameter);
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    if (cloud.push_apart(x) < tolerated_overlap * diameter) return x;
  }
  throw std::runtime_error("the beads do not fit into their box without overlap");
}

}  // namespace demvof
