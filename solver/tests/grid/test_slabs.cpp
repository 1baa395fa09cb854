// A box that is cut into slabs: where the cuts are, what passes between slabs, and the box in one piece
// again.
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "solver/grid/reduce.hpp"
#include "solver/grid/slabs.hpp"
#include "solver/grid/whole_box.hpp"
#include "solver/tests/cut_box.hpp"

namespace granvof {
namespace {

constexpr double untouched = -1e9;

TEST(Slabs, HoldEveryRowOnceAndEnoughOfThem) {
  for (const int ranks : {1, 2, 3, 4, 7})
    for (int rows = ranks * least_rows_of_a_slab; rows < 600; ++rows) {
      int next = 0;
      for (int rank = 0; rank < ranks; ++rank) {
        const Slab s = slab(rows, ranks, rank);
        EXPECT_EQ(s.first, next) << rows << " rows, " << ranks << " processes";
        EXPECT_GE(s.rows, least_rows_of_a_slab) << rows << " rows, " << ranks << " processes";
        EXPECT_LE(s.rows, 1.0 + 17.0 / 16.0 * rows / ranks) << rows << " rows, " << ranks << " processes";
        next = s.first + s.rows;
      }
      EXPECT_EQ(next, rows);
    }
}

TEST(Slabs, LargeOnesBeginWhereSeveralCoarseLevelsDo) {
  EXPECT_EQ(slab(1000, 2, 1).first % 16, 0);
  EXPECT_EQ(slab(999, 3, 2).first % 16, 0);
}

// Each begins at the nearest place that is a whole unit: the last one takes no more than half of one for it.
TEST(Slabs, BeginNearestToTheirShare) {
  for (const auto& [rows, ranks, unit] :
       {std::array{10, 4, 1}, std::array{130, 4, 2}, std::array{999, 3, 16}})
    for (int rank = 0; rank < ranks; ++rank)
      EXPECT_LE(std::fabs(slab(rows, ranks, rank).first - 1.0 * rows * rank / ranks), 0.5 * unit)
          << rank << " of " << ranks;
}

TEST(Slabs, AreCutAcrossTheLongestDirectionOfTheFloor) {
  EXPECT_EQ(direction_of_cut({20, 90, 1}, 2), 0);
  EXPECT_EQ(direction_of_cut({20, 90, 40}, 3), 2);
  EXPECT_EQ(direction_of_cut({40, 90, 20}, 3), 0);
  EXPECT_EQ(direction_of_cut({40, 90, 40}, 3), 2);  // whose layers lie together in memory
  EXPECT_EQ(most_slabs({20, 90, 1}, 2), 5);
  EXPECT_EQ(most_slabs({3, 90, 1}, 2), 1);
}

using test::Cut;

class CutBox : public ::testing::TestWithParam<Cut> {
 protected:
  // Values of the whole box by their place, ghosts untouched.
  std::vector<double> numbered() const {
    std::vector<double> values(whole_.size, untouched);
    for_each_place(Range::all(whole_), [&](const std::array<int, 3>& at) {
      values[static_cast<std::size_t>(whole_.index(at))] = at[0] + 100.0 * at[1] + 1e4 * at[2];
    });
    return values;
  }
  template <typename Work>
  void in_all(Work&& work) {
    test::in_all_slabs(GetParam(), whole_, work);
  }

  Layout whole_ = Layout::make(GetParam().n, {2, 2, GetParam().dim == 3 ? 2 : 0}, GetParam().periodic);
};

TEST_P(CutBox, GhostsAreThoseOfTheWholeBox) {
  std::vector<double> whole = numbered();
  exchange(whole_, whole.data());
  in_all([&](const Layout& l) {
    const WholeBox box(l, whole_, WholeBox::Values::box_and_ghosts);
    std::vector<double> part(l.size, untouched), expected(l.size, 0.0);
    box.take(whole.data(), expected.data());
    std::vector<float> single(l.size, static_cast<float>(untouched));
    for_each_place(Range::all(l), [&](const std::array<int, 3>& at) {
      const auto i = static_cast<std::size_t>(l.index(at));
      part[i] = expected[i];
      single[i] = static_cast<float>(expected[i]);
    });
    exchange(l, part.data());
    exchange(l, single.data());
    EXPECT_EQ(part, expected) << "process " << l.communicator->rank();
    EXPECT_EQ(std::vector<double>(single.begin(), single.end()), expected);
  });
}

TEST_P(CutBox, IsCollectedWhole) {
  std::vector<double> whole = numbered();
  exchange(whole_, whole.data());
  in_all([&](const Layout& l) {
    for (const auto values : {WholeBox::Values::box, WholeBox::Values::box_and_ghosts}) {
      const WholeBox box(l, whole_, values);
      std::vector<double> part(l.size, untouched), collected(whole_.size, untouched);
      box.take(whole.data(), part.data());
      const std::vector<double> expected = values == WholeBox::Values::box ? numbered() : whole;
      box.collect(part.data(), collected.data(), true);
      EXPECT_EQ(collected, expected) << "process " << l.communicator->rank();
      const bool lowest = l.communicator->rank() == 0;
      std::fill(collected.begin(), collected.end(), untouched);
      box.collect(part.data(), lowest ? collected.data() : nullptr, false);
      EXPECT_EQ(collected == expected, lowest);
    }
  });
}

TEST_P(CutBox, MomentsCountFromTheEndOfTheWhole) {
  const std::vector<double> whole = numbered();
  const auto moment = [](const Layout& l, const std::vector<double>& values, int d) {
    return moment_over(l, Range::all(l), d, [v = values.data()](std::ptrdiff_t c) { return v[c]; });
  };
  in_all([&](const Layout& l) {
    const WholeBox box(l, whole_, WholeBox::Values::box);
    std::vector<double> part(l.size, untouched);
    box.take(whole.data(), part.data());
    for (int d = 0; d < 3; ++d) EXPECT_DOUBLE_EQ(moment(l, part, d), moment(whole_, whole, d)) << d;
  });
}

INSTANTIATE_TEST_SUITE_P(
    Boxes, CutBox,
    ::testing::Values(Cut{"two", {13, 5, 1}, 2, {false, false, false}, 2},
                      Cut{"three", {13, 5, 1}, 2, {false, true, false}, 3},
                      Cut{"a_ring_of_two", {9, 4, 1}, 2, {true, false, false}, 2},
                      Cut{"a_ring_of_three", {14, 4, 1}, 2, {true, true, false}, 3},
                      Cut{"across_z", {6, 4, 13}, 3, {false, false, true}, 3},
                      Cut{"across_x_in_three_dimensions", {13, 4, 5}, 3, {true, false, true}, 2}),
    test::name_of_cut);

}  // namespace
}  // namespace granvof
