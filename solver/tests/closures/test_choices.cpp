#include <string>

#include <gtest/gtest.h>

#include "solver/model/choices.hpp"

namespace granvof::closures {
namespace {

struct One {
  static constexpr ClosureFacts facts{"one", "A"};
  double operator()() const { return 1.0; }
};
struct Two {
  static constexpr ClosureFacts facts{"two", "B"};
  double operator()() const { return 2.0; }
};
struct Three {
  static constexpr ClosureFacts facts{"three", "C"};
  double operator()() const { return 3.0; }
};
using List = Choices<One, Two, Three>;

TEST(Choices, EachIsPickedByItsPlace) {
  std::string words;
  for (std::size_t place = 0; place < List::facts.size(); ++place) {
    const Chosen<List> chosen(place);
    words.append(chosen.facts().word).append(chosen.facts().source);
    EXPECT_EQ(chosen.with([](auto closure) { return closure(); }), 1.0 + static_cast<double>(place));
  }
  EXPECT_EQ(words, "oneAtwoBthreeC");
}

TEST(Choices, TheFirstUnlessItIsSaid) {
  EXPECT_EQ(Chosen<List>(), Chosen<List>::of<One>());
  EXPECT_NE(Chosen<List>(), Chosen<List>::of<Two>());
  EXPECT_EQ(Chosen<List>::of<Three>().place(), 2U);
}

}  // namespace
}  // namespace granvof::closures
