#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include "solver/output/atomic_file.hpp"
#include "solver/output/checkpoint.hpp"
#include "solver/output/output_error.hpp"
#include "solver/tests/output/samples.hpp"

using namespace granvof;
using namespace granvof::test;

namespace {

class CheckpointFile : public testing::Test {
 protected:
  CheckpointView state() {
    CheckpointView view;
    view.time = 1.0 / 3.0;
    view.arrays["f_s"] = values;
    view.arrays["empty"] = {};
    view.scalars["dt"] = 0.1;
    view.counters["steps"] = std::int64_t{1} << 60;
    return view;
  }

  TemporaryDirectory directory;
  std::filesystem::path path = directory.path() / "checkpoint.h5";
  Scene scene = small_scene();
  std::vector<double> values{0.1, -0.0, std::numeric_limits<double>::denorm_min(), 1e308,
                             std::nextafter(1.0, 2.0)};
};

TEST_F(CheckpointFile, ReadsBackBitForBit) {
  write_checkpoint(path, scene, state());
  const auto read = read_checkpoint(path, scene);
  EXPECT_EQ(read.time, 1.0 / 3.0);
  const auto& array = read.array("f_s", values.size());
  EXPECT_EQ(std::memcmp(array.data(), values.data(), values.size() * sizeof(double)), 0);
  EXPECT_TRUE(read.array("empty", 0).empty());
  EXPECT_EQ(read.scalar("dt"), 0.1);
  EXPECT_EQ(read.counter("steps"), std::int64_t{1} << 60);
}

TEST_F(CheckpointFile, SaysWhatIsMissing) {
  write_checkpoint(path, scene, state());
  const auto read = read_checkpoint(path, scene);
  EXPECT_NE(message_of<OutputError>([&] { read.array("u", 5); }).find("no array 'u'"), std::string::npos);
  EXPECT_NE(message_of<OutputError>([&] { read.array("f_s", 6); }).find("5 values, 6"), std::string::npos);
  EXPECT_NE(message_of<OutputError>([&] { read.scalar("u"); }).find("no scalar 'u'"), std::string::npos);
  EXPECT_NE(message_of<OutputError>([&] { read.counter("u"); }).find("no counter 'u'"), std::string::npos);
}

TEST_F(CheckpointFile, RefusesAnotherCaseAndAnotherGrid) {
  write_checkpoint(path, scene, state());
  auto other = scene;
  other.hash = "fedcba9876543210";
  const auto text = message_of<OutputError>([&] { read_checkpoint(path, other); });
  EXPECT_NE(text.find("0123456789abcdef"), std::string::npos) << text;
  EXPECT_NE(text.find("fedcba9876543210"), std::string::npos) << text;
  other = scene;
  other.grid.cells = {16, 10, 1};
  const auto grid = message_of<OutputError>([&] { read_checkpoint(path, other); });
  EXPECT_NE(grid.find("8 x 5 x 1"), std::string::npos) << grid;
  EXPECT_NE(grid.find("16 x 10 x 1"), std::string::npos) << grid;
}

TEST_F(CheckpointFile, RefusesMissingForeignAndDamagedFiles) {
  EXPECT_NE(message_of<OutputError>([&] { read_checkpoint(path, scene); }).find("No such file"),
            std::string::npos);
  write_file_atomically(path, "not HDF5 at all");
  EXPECT_THROW(read_checkpoint(path, scene), OutputError);
  write_checkpoint(path, scene, state());
  const auto whole = read_file(path);
  write_file_atomically(path, whole.substr(0, whole.size() / 2));
  EXPECT_THROW(read_checkpoint(path, scene), OutputError);
  for (std::size_t at = 0; at < whole.size(); at += 97) {  // one bit wrong, anywhere
    auto flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ 1);
    write_file_atomically(path, flipped);
    EXPECT_NE(message_of<OutputError>([&] { read_checkpoint(path, scene); }).find("damaged"),
              std::string::npos);
  }
}

TEST_F(CheckpointFile, AFullDiskLeavesThePreviousOne) {
  write_checkpoint(path, scene, state());
  const std::vector<double> large(100000, 1.0);
  auto later = state();
  later.time = 2.0;
  later.arrays["f_s"] = large;
  {
    const FullDisk full(50000);
    const auto text = message_of<OutputError>([&] { write_checkpoint(path, scene, later); });
    EXPECT_NE(text.find("File too large"), std::string::npos) << text;
  }
  EXPECT_EQ(read_checkpoint(path, scene).time, 1.0 / 3.0);
  write_checkpoint(path, scene, later);
  EXPECT_EQ(read_checkpoint(path, scene).array("f_s", large.size()), large);
}

}  // namespace
