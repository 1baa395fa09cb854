// The memory of all values on grids: one allocator, so that where they live (cache lines, huge pages, a
// device) is decided in one place.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace granvof {

// The first value on a cache line.
template <typename T>
struct CacheLineAllocator {
  using value_type = T;
  static constexpr std::align_val_t cache_line{64};

  CacheLineAllocator() = default;
  template <typename U>
  explicit CacheLineAllocator(const CacheLineAllocator<U>&) {}
  T* allocate(std::size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), cache_line)); }
  void deallocate(T* values, std::size_t) { ::operator delete(values, cache_line); }
  friend bool operator==(const CacheLineAllocator&, const CacheLineAllocator&) { return true; }
};

// Values of a box, ghosts and padding included; zero where nothing else is said.
template <typename T>
using Buffer = std::vector<T, CacheLineAllocator<T>>;

}  // namespace granvof
