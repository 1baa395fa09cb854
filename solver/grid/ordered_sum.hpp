// Sums that come out the same whatever the number of threads: rows are added up in fixed blocks, and the
// blocks in their order. (A reduction of OpenMP adds up in the order in which threads arrive.)
#pragma once

#include <array>
#include <cstddef>

namespace granvof {

// Blocks of a sum; more threads than that have nothing to do in it.
inline constexpr int sum_blocks = 64;

// Sum of body(row) over the rows of one block.
template <typename Body>
inline auto sum_of_block(int rows, int block, Body&& body) {
  const auto begin = [=](int b) { return static_cast<int>(static_cast<long>(rows) * b / sum_blocks); };
  decltype(body(0)) sum{};
  for (int row = begin(block); row < begin(block + 1); ++row) sum += body(row);
  return sum;
}

template <typename Sum>
inline Sum sum_of_blocks(const std::array<Sum, sum_blocks>& partial) {
  Sum total{};
  for (const Sum& part : partial) total += part;
  return total;
}

}  // namespace granvof
