#include <stdexcept>

#include <gtest/gtest.h>

#include "solver/scene/duration.hpp"

namespace granvof {
namespace {

TEST(Duration, IsReadWithItsUnits) {
  EXPECT_EQ(read_duration("10min"), 600.0);
  EXPECT_EQ(read_duration("90s"), 90.0);
  EXPECT_EQ(read_duration("1.5h"), 5400.0);
  EXPECT_EQ(read_duration("3h50m"), 13800.0);
  EXPECT_EQ(read_duration("1h0min30s"), 3630.0);
}

TEST(Duration, AnythingElseIsRefused) {
  for (const char* wrong : {"", "10", "min", "-3s", "0s", "10 min", "10minutes", "nans", "3h50", "50m3h",
                            "3h3h", "1h-30m", "1m1min", "1e9h"})
    EXPECT_THROW(read_duration(wrong), std::invalid_argument) << wrong;
}

TEST(Duration, IsWrittenShort) {
  EXPECT_EQ(duration_text(6.0), "6 s");
  EXPECT_EQ(duration_text(720.0), "12 min");
  EXPECT_EQ(duration_text(9000.0), "2.5 h");
}

}  // namespace
}  // namespace granvof
