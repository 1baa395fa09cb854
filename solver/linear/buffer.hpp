// Memory of the linear solvers: rows padded to whole vectors and aligned to cache lines.
#pragma once

#include <array>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>

#include "solver/grid/layout.hpp"

namespace granvof::linear {

inline constexpr int lanes = 16;  // values a row is padded to: one cache line of float, two of double

inline int padded(int n) {
  return (n + lanes - 1) / lanes * lanes;
}

// Zero-initialised values on a cache line; rows of different buffers start at different cache sets.
template <typename T>
class Buffer {
 public:
  Buffer() = default;
  explicit Buffer(std::size_t size) {
    const std::size_t bytes = (size * sizeof(T) + 63) / 64 * 64;
    data_.reset(static_cast<T*>(std::aligned_alloc(64, bytes)));
    if (!data_) throw std::bad_alloc();
    std::memset(static_cast<void*>(data_.get()), 0, bytes);
  }
  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }

 private:
  struct Free {
    void operator()(T* p) const { std::free(p); }
  };
  std::unique_ptr<T, Free> data_;
};

// The layout of the solvers' own values. Rows start on a cache line and are padded to whole vectors with
// values that stay 0, so that loops need no remainder. Ghost rows exist only in directions of several cells;
// along x a ghost is needed only where the direction is periodic (else the faces on both ends are 0).
inline Layout padded_layout(const std::array<int, 3>& n, const std::array<bool, 3>& periodic) {
  Layout l;
  l.n = n;
  for (int d = 0; d < 3; ++d) l.periodic[d] = n[d] > 1 && periodic[d];
  l.ghost = {l.periodic[0] ? 1 : 0, n[1] > 1 ? 1 : 0, n[2] > 1 ? 1 : 0};
  std::ptrdiff_t row = padded(n[0] + 2 * l.ghost[0]);
  if (row % 512 == 0) row += lanes;  // rows a power of two apart evict each other from the first-level cache
  l.stride = {1, row, row * (n[1] + 2 * l.ghost[1])};
  l.origin = lanes + l.ghost[1] * l.stride[1] + l.ghost[2] * l.stride[2];
  l.size = static_cast<std::size_t>(2 * lanes + l.stride[2] * (n[2] + 2 * l.ghost[2]));
  return l;
}

inline bool any_periodic(const Layout& l) {
  return l.periodic[0] || l.periodic[1] || l.periodic[2];
}

}  // namespace granvof::linear
