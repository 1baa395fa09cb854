#include "solver/grid/whole_box.hpp"

namespace granvof {

WholeBox::WholeBox(const Layout& part, const Layout& whole, Values values)
    : part_(part), whole_(whole), ghosts_(values == Values::box_and_ghosts) {
  for (int d = 0; d < 3; ++d)
    if (part.is_split(d)) cut_ = d;
  const Communicator& processes = *part.communicator;
  const auto size = static_cast<std::size_t>(processes.size()),
             own = static_cast<std::size_t>(processes.rank());
  std::vector<double> rows(size, 0.0);
  rows[own] = part.n[cut_];
  processes.sum(rows);
  int begin = 0;
  for (const double n : rows) {
    layers_.push_back({begin, begin + static_cast<int>(n)});
    begin = layers_.back().end;
  }
  if (!ghosts_) return;
  layers_.front().begin -= part.ghost[cut_];
  layers_.back().end += part.ghost[cut_];
}

template <typename Visit>
void WholeBox::for_each_value_of_a_layer(Visit&& visit) const {
  const int e = cut_ == 0 ? 1 : 0, f = 3 - cut_ - e;
  const int ge = ghosts_ ? part_.ghost[e] : 0, gf = ghosts_ ? part_.ghost[f] : 0;
  const auto index = [=](const Layout& l, int a, int b) {
    return l.origin + a * l.stride[e] + b * l.stride[f];
  };
  std::size_t number = 0;
  for (int b = -gf; b < part_.n[f] + gf; ++b)
    for (int a = -ge; a < part_.n[e] + ge; ++a) visit(index(part_, a, b), index(whole_, a, b), number++);
}

std::size_t WholeBox::values_of_a_layer() const {
  std::size_t count = 1;
  for (int d = 0; d < 3; ++d)
    if (d != cut_) count *= static_cast<std::size_t>(part_.n[d] + (ghosts_ ? 2 * part_.ghost[d] : 0));
  return count;
}

template <typename T>
void WholeBox::collect(const T* part, T* whole, bool everywhere) const {
  const Communicator& processes = *part_.communicator;
  const std::size_t width = values_of_a_layer();
  std::vector<std::size_t> sizes;
  std::size_t total = 0;
  for (const Layers& l : layers_) {
    sizes.push_back(static_cast<std::size_t>(l.end - l.begin) * width * sizeof(T));
    total += sizes.back();
  }
  const auto own = static_cast<std::size_t>(processes.rank());
  mine_.resize(sizes[own]);
  const bool receives = everywhere || own == 0;
  all_.resize(receives ? total : 0);
  T* out = reinterpret_cast<T*>(mine_.data());
  for (int at = layers_[own].begin; at < layers_[own].end; ++at, out += width) {
    const T* layer = part + (at - part_.first[cut_]) * part_.stride[cut_];
    for_each_value_of_a_layer(
        [=](std::ptrdiff_t i, std::ptrdiff_t, std::size_t number) { out[number] = layer[i]; });
  }
  processes.gather(mine_, sizes, all_, everywhere);
  if (!receives) return;
  const T* in = reinterpret_cast<const T*>(all_.data());
  for (int at = layers_.front().begin; at < layers_.back().end; ++at, in += width) {
    T* layer = whole + at * whole_.stride[cut_];
    for_each_value_of_a_layer(
        [=](std::ptrdiff_t, std::ptrdiff_t i, std::size_t number) { layer[i] = in[number]; });
  }
}
template void WholeBox::collect(const double* part, double* whole, bool everywhere) const;
template void WholeBox::collect(const float* part, float* whole, bool everywhere) const;

template <typename T>
void WholeBox::take(const T* whole, T* part) const {
  const int ghost = ghosts_ ? part_.ghost[cut_] : 0;
  for (int at = -ghost; at < part_.n[cut_] + ghost; ++at) {
    T* to = part + at * part_.stride[cut_];
    const T* from = whole + (at + part_.first[cut_]) * whole_.stride[cut_];
    for_each_value_of_a_layer([=](std::ptrdiff_t i, std::ptrdiff_t j, std::size_t) { to[i] = from[j]; });
  }
}
template void WholeBox::take(const double* whole, double* part) const;
template void WholeBox::take(const float* whole, float* part) const;

}  // namespace granvof
