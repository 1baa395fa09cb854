#include "solver/grid/communicator.hpp"

#include <stdexcept>

namespace granvof {
namespace {

// body(index of layer 0 on a line along d) for every line, those of the other directions' ghosts included, so
// that corners are right after the last direction.
template <typename Body>
void for_each_line(const Layout& l, int d, Body&& body) {
  const int e = d == 0 ? 1 : 0, f = 3 - d - e;  // e: the direction whose values lie closest
  for (int b = -l.ghost[f]; b < l.n[f] + l.ghost[f]; ++b)
    for (int a = -l.ghost[e]; a < l.n[e] + l.ghost[e]; ++a)
      body(l.origin + a * l.stride[e] + b * l.stride[f]);
}

template <typename T>
void join_ends_along(const Layout& l, int d, T* values) {
  for (int g = 1; g <= l.ghost[d]; ++g) {
    const int from_upper = ((l.n[d] - g) % l.n[d] + l.n[d]) % l.n[d];
    const int from_lower = (g - 1) % l.n[d];
    for_each_line(l, d, [=](std::ptrdiff_t index) {
      T* line = values + index;
      line[-g * l.stride[d]] = line[from_upper * l.stride[d]];
      line[(l.n[d] - 1 + g) * l.stride[d]] = line[from_lower * l.stride[d]];
    });
  }
}

// Layers from `first` on of all lines along d, to or from a buffer.
template <typename T>
void pack(const Layout& l, int d, int first, const T* values, T* out) {
  for (int g = 0; g < l.ghost[d]; ++g) {
    const T* layer = values + (first + g) * l.stride[d];
    for_each_line(l, d, [&](std::ptrdiff_t line) { *out++ = layer[line]; });
  }
}
template <typename T>
void unpack(const Layout& l, int d, int first, const T* in, T* values) {
  for (int g = 0; g < l.ghost[d]; ++g) {
    T* layer = values + (first + g) * l.stride[d];
    for_each_line(l, d, [&](std::ptrdiff_t line) { layer[line] = *in++; });
  }
}

std::size_t values_of_an_end(const Layout& l, int d) {
  std::size_t count = static_cast<std::size_t>(l.ghost[d]);
  for (int e = 0; e < 3; ++e)
    if (e != d) count *= static_cast<std::size_t>(l.n[e] + 2 * l.ghost[e]);
  return count;
}

}  // namespace

void Communicator::trade(const End& /*below*/, const End& /*above*/) const {
  throw std::logic_error("processes with whole boxes have no neighbours");
}
void Communicator::gather(std::span<const std::byte> /*mine*/, std::span<const std::size_t> /*sizes*/,
                          std::span<std::byte> /*all*/, bool /*everywhere*/) const {
  throw std::logic_error("processes with whole boxes have nothing to gather");
}
void Communicator::broadcast(std::span<std::byte> /*bytes*/) const {
  throw std::logic_error("processes with whole boxes are told nothing");
}

template <typename T>
void Communicator::exchange(const Layout& l, T* values) const {
  for (int d = 0; d < 3; ++d) {
    if (l.ghost[d] == 0) continue;
    if (!l.is_split(d)) {
      if (l.periodic[d]) join_ends_along(l, d, values);
      continue;
    }
    const std::size_t bytes = values_of_an_end(l, d) * sizeof(T);
    std::array<End, 2> ends;
    for (const bool upper : {false, true}) {
      if (!l.seam(d, upper)) continue;
      std::vector<std::byte>&out = buffers_[upper ? 2 : 0], &in = buffers_[upper ? 3 : 1];
      if (out.size() < bytes) out.resize(bytes);
      if (in.size() < bytes) in.resize(bytes);
      pack(l, d, upper ? l.n[d] - l.ghost[d] : 0, values, reinterpret_cast<T*>(out.data()));
      ends[upper ? 1 : 0] = {{out.data(), bytes}, {in.data(), bytes}};
    }
    trade(ends[0], ends[1]);
    for (const bool upper : {false, true})
      if (l.seam(d, upper))
        unpack(l, d, upper ? l.n[d] : -l.ghost[d], reinterpret_cast<const T*>(ends[upper ? 1 : 0].in.data()),
               values);
  }
}
template void Communicator::exchange(const Layout& layout, double* values) const;
template void Communicator::exchange(const Layout& layout, float* values) const;

template <typename T>
void join_ends(const Layout& layout, T* values) {
  for (int d = 0; d < 3; ++d)
    if (layout.periodic[d] && layout.ghost[d] > 0) join_ends_along(layout, d, values);
}
template void join_ends(const Layout& layout, double* values);
template void join_ends(const Layout& layout, float* values);

}  // namespace granvof
