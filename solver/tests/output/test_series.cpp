#include <fstream>
#include <limits>

#include <fcntl.h>
#include <gtest/gtest.h>

#include "solver/output/output_error.hpp"
#include "solver/output/series_file.hpp"
#include "solver/tests/output/samples.hpp"

using namespace granvof;
using namespace granvof::test;

namespace {

const std::vector<Column> columns{{"time", "s", ""}, {"y_c", "m", ""}, {"f_s_max", "-", ""}};

void put(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path) << text;
}

std::vector<Value> row(Value a, Value b, Value c) {
  return {a, b, c};
}

TEST(SeriesFile, ReadsBackWhatWasWrittenBitForBit) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "series.csv";
  auto file = SeriesFile::create(path, columns);
  file.append(row(0.0, std::nullopt, 1.0 / 3.0));
  file.append(row(0.1, 1e-300, -123456789.123456789));
  EXPECT_EQ(read_file(path),
            "time [s],y_c [m],f_s_max [-]\n0,,0.3333333333333333\n0.1,1e-300,-123456789.12345679\n");
  const auto series = read_series(path);
  ASSERT_EQ(series.columns.size(), 3U);
  EXPECT_EQ(series.columns[1].name, "y_c");
  EXPECT_EQ(series.columns[1].unit, "m");
  EXPECT_EQ(series.column("f_s_max"), (std::vector<Value>{1.0 / 3.0, -123456789.123456789}));
  EXPECT_EQ(series.column("y_c"), (std::vector<Value>{std::nullopt, 1e-300}));
  EXPECT_TRUE(series.has("time"));
  EXPECT_FALSE(series.has("front"));
  EXPECT_NE(message_of<std::out_of_range>([&] { series.column("front"); }).find("'front'"),
            std::string::npos);
}

TEST(SeriesFile, RefusesRowsThatDoNotFitOrAreNotFinite) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "series.csv";
  auto file = SeriesFile::create(path, columns);
  const std::vector<Value> two{0.0, 1.0};
  EXPECT_THROW(file.append(two), std::invalid_argument);
  EXPECT_THROW(file.append(row(0.0, std::numeric_limits<double>::quiet_NaN(), 0.0)), std::invalid_argument);
  EXPECT_THROW(file.append(row(0.0, std::numeric_limits<double>::infinity(), 0.0)), std::invalid_argument);
  EXPECT_TRUE(read_series(path).rows.empty());
}

TEST(SeriesFile, ResumeCutsLaterAndTornRows) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "series.csv";
  const std::string header = "time [s],y_c [m],f_s_max [-]\n";
  put(path, header + "0,,1\n0.1,2,3\n0.2,4,5\n0.3,6");
  auto file = SeriesFile::resume(path, columns, std::vector{0.0, 0.1});
  EXPECT_EQ(read_file(path), header + "0,,1\n0.1,2,3\n");
  file.append(row(0.2, 7.0, 8.0));
  EXPECT_EQ(read_file(path), header + "0,,1\n0.1,2,3\n0.2,7,8\n");
}

TEST(SeriesFile, ResumeRefusesOtherColumnsAndAMissingFile) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "series.csv";
  EXPECT_THROW(SeriesFile::resume(path, columns, {}), OutputError);
  put(path, "time [s],y_c [m]\n0,1\n");
  const auto text = message_of<OutputError>([&] { SeriesFile::resume(path, columns, {}); });
  EXPECT_NE(text.find("columns"), std::string::npos);
  EXPECT_EQ(read_file(path), "time [s],y_c [m]\n0,1\n");
}

TEST(SeriesFile, AFullDiskIsReportedAndLeavesWholeRows) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "series.csv";
  auto file = SeriesFile::create(path, columns);
  file.append(row(0.0, 1.0, 2.0));
  const auto before = read_file(path);
  {
    const FullDisk full(before.size() + 4);  // the next row gets a few bytes in, not all
    const auto text = message_of<OutputError>([&] { file.append(row(0.125, 1.5, 2.5)); });
    EXPECT_NE(text.find(path.string()), std::string::npos) << text;
    EXPECT_NE(text.find("File too large"), std::string::npos) << text;
  }
  EXPECT_EQ(read_file(path), before);
  file.append(row(0.125, 1.5, 2.5));  // and goes on when there is room again
  EXPECT_EQ(read_file(path), before + "0.125,1.5,2.5\n");
}

TEST(SeriesFile, NoSpaceOnTheDeviceIsReported) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "series.csv";
  put(path, "time [s],y_c [m],f_s_max [-]\n");
  const Descriptor full(::open("/dev/full", O_WRONLY));
  if (!full.valid()) GTEST_SKIP() << "this system has no /dev/full";
  const auto text = message_of<OutputError>([&] { write_all(full, "0,1,2\n", "/dev/full"); });
  EXPECT_EQ(text, "cannot write /dev/full: No space left on device");
}

TEST(ReadSeries, NamesLineAndColumnOfWhatIsWrong) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "series.csv";
  const auto error_for = [&](const std::string& text) {
    put(path, text);
    return message_of<OutputError>([&] { read_series(path); });
  };
  EXPECT_NE(error_for("time [s],y_c [m]\n0,1\n1,nan\n").find("line 3, y_c: 'nan'"), std::string::npos);
  EXPECT_NE(error_for("time [s],y_c [m]\n0,inf\n").find("line 2, y_c: 'inf'"), std::string::npos);
  EXPECT_NE(error_for("time [s],y_c [m]\n0,1x\n").find("'1x'"), std::string::npos);
  EXPECT_NE(error_for("time [s],y_c [m]\n0\n").find("line 2 has 1 fields"), std::string::npos);
  EXPECT_NE(error_for("").find("header"), std::string::npos);
  std::filesystem::remove(path);
  EXPECT_THROW(read_series(path), OutputError);
}

TEST(AtomicFile, AFailedWriteLeavesTheOldFile) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "file";
  write_file_atomically(path, "old");
  {
    const FullDisk full(100);
    EXPECT_THROW(write_file_atomically(path, std::string(1000, 'x')), OutputError);
  }
  EXPECT_EQ(read_file(path), "old");
  EXPECT_FALSE(std::filesystem::exists(directory.path() / "file.tmp"));
  const auto text =
      message_of<OutputError>([&] { write_file_atomically(directory.path() / "no" / "file", "x"); });
  EXPECT_NE(text.find("No such file or directory"), std::string::npos) << text;
}

}  // namespace
