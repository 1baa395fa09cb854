#include "solver/grid/communicator.hpp"

namespace granvof {
namespace {

// Copies whole slabs, lower directions' ghosts included, so that corners are right after the last direction.
template <typename T>
void wrap(const Layout& l, T* values) {
  for (int d = 0; d < 3; ++d) {
    if (!l.periodic[d] || l.ghost[d] == 0) continue;
    const int e = (d + 1) % 3, f = (d + 2) % 3;
    for (int g = 1; g <= l.ghost[d]; ++g) {
      const int from_upper = ((l.n[d] - g) % l.n[d] + l.n[d]) % l.n[d];
      const int from_lower = (g - 1) % l.n[d];
      for (int b = -l.ghost[f]; b < l.n[f] + l.ghost[f]; ++b) {
        for (int a = -l.ghost[e]; a < l.n[e] + l.ghost[e]; ++a) {
          T* line = values + l.origin + a * l.stride[e] + b * l.stride[f];
          line[-g * l.stride[d]] = line[from_upper * l.stride[d]];
          line[(l.n[d] - 1 + g) * l.stride[d]] = line[from_lower * l.stride[d]];
        }
      }
    }
  }
}

}  // namespace

void join_ends(const Layout& layout, double* values) {
  wrap(layout, values);
}
void join_ends(const Layout& layout, float* values) {
  wrap(layout, values);
}

}  // namespace granvof
