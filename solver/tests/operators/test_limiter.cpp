// Limiters against their printed forms.
#include <gtest/gtest.h>

#include "solver/operators/limiter.hpp"

namespace granvof {
namespace {

TEST(Limiters, OfEqualDifferencesAreThese) {
  for (const double slope : {-2.0, 1e-3, 3.0}) {
    EXPECT_DOUBLE_EQ(van_leer(slope, slope), slope);
    EXPECT_DOUBLE_EQ(superbee(slope, slope), slope);
  }
}

// van Leer: 2 a b / (a + b); superbee: the larger of the smaller of (2a, b) and of (a, 2b).
TEST(Limiters, OfUnequalDifferencesAreThePrintedMeans) {
  EXPECT_DOUBLE_EQ(van_leer(1.0, 3.0), 1.5);
  EXPECT_DOUBLE_EQ(superbee(1.0, 3.0), 2.0);
  EXPECT_DOUBLE_EQ(superbee(1.0, 1.5), 1.5);
}

TEST(Limiters, AreSymmetricAndOdd) {
  for (const auto limiter : {van_leer, superbee}) {
    EXPECT_DOUBLE_EQ(limiter(1.0, 3.0), limiter(3.0, 1.0));
    EXPECT_DOUBLE_EQ(limiter(-1.0, -3.0), -limiter(1.0, 3.0));
  }
}

TEST(Limiters, AreFlatAtAnExtremum) {
  for (const auto limiter : {van_leer, superbee}) {
    EXPECT_EQ(limiter(1.0, -3.0), 0.0);
    EXPECT_EQ(limiter(0.0, 3.0), 0.0);
  }
}

}  // namespace
}  // namespace granvof
