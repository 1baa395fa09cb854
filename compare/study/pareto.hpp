// The points of an error-against-cost chart that no other point beats.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace granvof::compare {

struct WorkPrecision {
  double cost = 0.0;            // > 0
  std::optional<double> error;  // >= 0; nothing: failed, or not measured
};

// Indices of the points that no other point beats: none is at most as dear and at most as wrong, and better
// in one of the two. Ascending in cost. A point without an error is never on the front; of equal points the
// first is.
inline std::vector<std::size_t> pareto_front(const std::vector<WorkPrecision>& points) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].error) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return points[a].cost != points[b].cost ? points[a].cost < points[b].cost
                                            : *points[a].error < *points[b].error;
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : order)
    if (front.empty() || *points[i].error < *points[front.back()].error) front.push_back(i);
  return front;
}

// The cheapest point with an error of at most `tolerance`.
inline std::optional<std::size_t> cheapest_within(const std::vector<WorkPrecision>& points,
                                                  double tolerance) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].error && *points[i].error <= tolerance && (!best || points[i].cost < points[*best].cost))
      best = i;
  return best;
}

}  // namespace granvof::compare
