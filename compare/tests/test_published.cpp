#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "compare/input/published.hpp"
#include "compare/metrics/solid_level.hpp"
#include "solver/output/output_error.hpp"
#include "solver/tests/cases_directory.hpp"
#include "solver/tests/temporary_directory.hpp"

namespace granvof::compare {
namespace {

Curve read(const std::string& text, const char* column) {
  const test::TemporaryDirectory directory;
  const auto file = directory.path() / "published.tsv";
  std::ofstream(file) << text;
  return read_published(file, column);
}

std::string refusal(const std::string& text, const char* column = "y") {
  try {
    read(text, column);
  } catch (const OutputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Published, ReadsTheNamedColumn) {
  const Curve curve = read("# who\nx [s]\ty [m]\tz [m]\n0\t1\t2\n1.5\t-3e-2\t4\n", "z");
  EXPECT_EQ(curve.time, (std::vector<double>{0.0, 1.5}));
  EXPECT_EQ(curve.value, (std::vector<double>{2.0, 4.0}));
}

TEST(Published, BadInputIsNamedWithItsLine) {
  EXPECT_NE(refusal("x [s]\tz [m]\n0\t1\n").find("line 1: no column 'y'"), std::string::npos);
  EXPECT_NE(refusal("x\ty\n0\t1\n1\n").find("line 3 has 1 fields"), std::string::npos);
  EXPECT_NE(refusal("x\ty\n0\tnan\n").find("line 2: 'nan'"), std::string::npos);
  EXPECT_NE(refusal("x\ty\n1\t1\n1\t2\n").find("line 3: the first column does not ascend"),
            std::string::npos);
  EXPECT_THROW(read_published("no/such.tsv", "y"), OutputError);
}

TEST(Published, TheProjectsOwnSeriesAreReadable) {
  const std::filesystem::path published = cases_directory() / "published";
  EXPECT_EQ(read_published(published / "martin_moyce_1952.tsv", "delta").value.front(), 1.0);
  EXPECT_GT(read_published(published / "pham_van_bang_fronts.tsv", "packed_front").size(), 20u);
}

TEST(SolidLevel, IsLinearBetweenRows) {
  // 2 x 4 x 1 cells of height 0.1; rows 0.6, 0.5, 0.1, 0.
  const std::vector<double> f_s{0.6, 0.6, 0.4, 0.6, 0.1, 0.1, 0.0, 0.0};
  EXPECT_NEAR(*solid_level(f_s, {2, 4, 1}, 0.1, 0.3), 0.2, 1e-12);   // halfway between rows 1 and 2
  EXPECT_NEAR(*solid_level(f_s, {2, 4, 1}, 0.1, 0.55), 0.1, 1e-12);  // halfway between rows 0 and 1
  EXPECT_FALSE(solid_level(f_s, {2, 4, 1}, 0.1, 0.7));
  EXPECT_NEAR(*solid_level({0.5, 0.5}, {1, 2, 1}, 0.1, 0.3), 0.2, 1e-12);
}

}  // namespace
}  // namespace granvof::compare
