#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "solver/scene/keys.hpp"

namespace granvof::case_file {
namespace {

constexpr std::size_t longest_asked = 60;  // twice that of any key

int edit_distance(std::string_view a, std::string_view b) {
  std::vector<int> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    int diagonal = std::exchange(row[0], static_cast<int>(i));
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int replace = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, replace}));
    }
  }
  return row[b.size()];
}

}  // namespace

std::string nearest_key(std::string_view name) {
  if (name.size() > longest_asked) return "";
  const auto distance = [&](const Key& k) { return edit_distance(name, k.name); };
  const auto best = std::ranges::min_element(keys(), {}, distance);
  const int near = std::max(2, static_cast<int>(name.size()) / 3);
  return distance(*best) <= near ? best->name : "";
}

}  // namespace granvof::case_file
