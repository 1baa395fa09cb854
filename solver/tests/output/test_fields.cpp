#include <cstdint>
#include <fstream>

#include <gtest/gtest.h>

#include "solver/output/atomic_file.hpp"
#include "solver/output/fields_file.hpp"
#include "solver/output/hdf5_file.hpp"
#include "solver/output/output_error.hpp"
#include "solver/tests/output/samples.hpp"

using namespace granvof;
using namespace granvof::test;

namespace {

void expect_same(const CellFields& read, const CellFields& written) {
  EXPECT_EQ(read.time, written.time);
  EXPECT_EQ(read.cells, written.cells);
  Vec3 shown = written.spacing;
  if (written.cells[2] == 1) shown[2] = shown[0];  // a slab is shown as thick as a cell is long
  EXPECT_EQ(read.spacing, shown);
  EXPECT_EQ(read.f_s, written.f_s);
  EXPECT_EQ(read.alpha, written.alpha);
  EXPECT_EQ(read.p_c, written.p_c);
  EXPECT_EQ(read.p_s, written.p_s);
  EXPECT_EQ(read.theta, written.theta);
  EXPECT_EQ(read.phi, written.phi);
  for (std::size_t d = 0; d < 3; ++d) {
    const std::vector<double> zero(written.f_s.size(), 0.0);
    EXPECT_EQ(read.u_s[d], written.u_s[d].empty() ? zero : written.u_s[d]);
    EXPECT_EQ(read.u_c[d], written.u_c[d].empty() ? zero : written.u_c[d]);
  }
}

class FieldsFileOf : public testing::TestWithParam<int> {
 protected:
  Scene scene() const { return GetParam() == 2 ? small_scene() : small_scene_3d(); }
};

TEST_P(FieldsFileOf, ReadsBackWhatWasWrittenLinkedAndJoined) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "fields.h5";
  auto file = FieldsFile::create(directory.path(), scene());
  EXPECT_TRUE(read_field_times(path).empty());
  auto first = numbered_fields(scene(), 0.0);
  auto second = numbered_fields(scene(), 1.0 / 3.0);
  second.p_s = second.phi;
  second.f_s[1] = 0.5;
  file.append(first);
  file.append(second);
  const auto check = [&] {
    EXPECT_EQ(read_field_times(path), (std::vector<double>{0.0, 1.0 / 3.0}));
    expect_same(read_fields(path, 0), first);
    expect_same(read_fields(path, 1), second);
    const CellFields part = read_solid_fraction(path, 1);
    EXPECT_EQ(part.time, second.time);
    EXPECT_EQ(part.cells, second.cells);
    EXPECT_EQ(part.f_s, second.f_s);
    EXPECT_THROW(read_fields(path, 2), OutputError);
  };
  check();
  ASSERT_TRUE(file.join());
  EXPECT_FALSE(std::filesystem::exists(directory.path() / "fields"));
  check();
}

// As a record of the reference: some fields only.
TEST(FieldsFile, TheSolidFractionIsReadWithoutTheOtherFields) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "fields.h5";
  {
    const auto file = hdf5::create_in_memory();
    hdf5::write_attribute(file, "cells", std::vector<int>{2, 1, 1});
    hdf5::write_attribute(file, "spacing", std::vector<double>{0.1, 0.1, 1.0});
    const auto group = hdf5::create_group(file, "t0000");
    hdf5::write_attribute(group, "time", 0.5);
    hdf5::write_compressed(group, "f_s", std::vector<hsize_t>{1, 1, 2}, std::vector<float>{0.25F, 0.5F});
    const auto wrong = hdf5::create_group(file, "t0001");
    hdf5::write_attribute(wrong, "time", 1.0);
    hdf5::write_compressed(wrong, "f_s", std::vector<hsize_t>{1, 1, 1}, std::vector<float>{0.25F});
    write_file_atomically(path, hdf5::content_of(file));
  }
  EXPECT_EQ(read_solid_fraction(path, 0).f_s, (std::vector<double>{0.25, 0.5}));
  EXPECT_EQ(read_solid_fraction(path, 0).time, 0.5);
  EXPECT_THROW(read_fields(path, 0), OutputError);
  EXPECT_NE(message_of<OutputError>([&] { read_solid_fraction(path, 1); }).find("1 values for 2 cells"),
            std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, FieldsFileOf, testing::Values(2, 3));

TEST(FieldsFile, ResumeRemovesLaterInstantsLinkedOrJoined) {
  const auto scene = small_scene();
  for (const bool joined : {false, true}) {
    const TemporaryDirectory directory;
    const auto path = directory.path() / "fields.h5";
    auto first = FieldsFile::create(directory.path(), scene);
    for (const double t : {0.0, 0.1, 0.2, 0.3}) first.append(numbered_fields(scene, t));
    if (joined) {
      ASSERT_TRUE(first.join());
    }
    auto file = FieldsFile::resume(directory.path(), scene, std::vector{0.0, 0.1});
    EXPECT_EQ(read_field_times(path), (std::vector<double>{0.0, 0.1}));
    file.append(numbered_fields(scene, 0.25));
    EXPECT_EQ(read_field_times(path), (std::vector<double>{0.0, 0.1, 0.25}));
    expect_same(read_fields(path, 1), numbered_fields(scene, 0.1));
    EXPECT_FALSE(std::filesystem::exists(directory.path() / "fields" / "t0003.h5"));
    EXPECT_EQ(read_file(directory.path() / "fields.xdmf").find("t0003"), std::string::npos);
    ASSERT_TRUE(file.join());
    expect_same(read_fields(path, 2), numbered_fields(scene, 0.25));
  }
}

// A run that was joined, gone on with to the same end and joined again is the same file.
TEST(FieldsFile, JoinedResumedAndJoinedAgainIsTheSameToTheByte) {
  const TemporaryDirectory directory;
  const auto scene = small_scene();
  const std::vector times{0.0, 0.1};
  auto first = FieldsFile::create(directory.path(), scene);
  for (const double t : times) first.append(numbered_fields(scene, t));
  const std::string piece = read_file(directory.path() / "fields/t0001.h5");
  ASSERT_TRUE(first.join());
  const std::string joined = read_file(directory.path() / "fields.h5");
  auto again = FieldsFile::resume(directory.path(), scene, times);
  EXPECT_TRUE(read_file(directory.path() / "fields/t0001.h5") == piece);
  ASSERT_TRUE(again.join());
  EXPECT_TRUE(read_file(directory.path() / "fields.h5") == joined);
}

// On another disk, say: it goes on through the link, which is the user's and stays.
TEST(FieldsFile, AFolderOfInstantsMayBeALink) {
  const auto scene = make_scene(2, {8, 6, 1}, {1.0, 1.0, 1.0});
  const TemporaryDirectory directory, elsewhere;
  const std::vector times{0.0, 1.0};
  auto first = FieldsFile::create(directory.path(), scene);
  for (const double t : times) first.append(numbered_fields(scene, t));
  const auto folder = directory.path() / "fields", target = elsewhere.path() / "fields";
  std::filesystem::copy(folder, target);
  std::filesystem::remove_all(folder);
  std::filesystem::create_symlink(target, folder);
  auto again = FieldsFile::resume(directory.path(), scene, times);
  EXPECT_NO_THROW(again.check_still_there());
  ASSERT_TRUE(again.join());
  EXPECT_TRUE(std::filesystem::is_symlink(folder));
}

// What was written stands in the joined file in the end: an instant that cannot be read is not gone on from.
TEST(FieldsFile, ADamagedInstantIsRefusedOnResumeLinkedOrJoined) {
  const auto scene = make_scene(2, {100, 100, 1}, {1.0, 1.0, 1.0});  // most of a file is compressed numbers
  for (const bool joined : {false, true}) {
    const TemporaryDirectory directory;
    auto file = FieldsFile::create(directory.path(), scene);
    const std::vector times{0.0, 1.0};
    for (const double t : times) file.append(numbered_fields(scene, t));
    if (joined) {
      ASSERT_TRUE(file.join());
    }
    EXPECT_NO_THROW(FieldsFile::check_instants(directory.path(), times));
    const auto damaged = directory.path() / (joined ? "fields.h5" : "fields/t0001.h5");
    std::string bytes = read_file(damaged);
    // Within the numbers of the first fields, wherever HDF5 puts its own between them.
    for (std::size_t byte = bytes.size() / 3; byte < 2 * bytes.size() / 3; ++byte)
      bytes[byte] = static_cast<char>(bytes[byte] ^ 1);
    write_file_atomically(damaged, bytes);
    const auto text = message_of<OutputError>([&] { FieldsFile::check_instants(directory.path(), times); });
    EXPECT_NE(text.find("fields.h5"), std::string::npos) << text;
    EXPECT_THROW(FieldsFile::resume(directory.path(), scene, times), OutputError);
    EXPECT_EQ(read_file(damaged), bytes);
  }
}

// An instant of the same time that another run has written, or of a file whose cells lie in another order.
TEST(FieldsFile, AnInstantOfAnotherRunIsRefusedOnResumeLinkedOrJoined) {
  const auto scene = small_scene();
  const std::vector times{0.0, 0.1};
  for (const bool joined : {false, true}) {
    const TemporaryDirectory ours, others;
    auto file = FieldsFile::create(ours.path(), scene), other = FieldsFile::create(others.path(), scene);
    for (const double t : times) {
      auto fields = numbered_fields(scene, t);
      file.append(fields);
      if (t > 0.0) fields.u_c[1].back() += 1.0;
      other.append(fields);
    }
    const std::string written = file.sha256(0.1);
    if (joined) {
      ASSERT_TRUE(file.join() && other.join());
    }
    EXPECT_NO_THROW(FieldsFile::check_instants(ours.path(), times, written));
    // A checkpoint of before the last of them knows those up to it.
    EXPECT_NO_THROW(FieldsFile::check_instants(ours.path(), std::vector{0.0}, file.sha256(0.05)));
    EXPECT_NO_THROW(FieldsFile::check_instants(ours.path(), {}, file.sha256(-1.0)));
    EXPECT_EQ(FieldsFile::resume(ours.path(), scene, times).sha256(0.1), written);
    if (joined) {
      ASSERT_TRUE(FieldsFile::resume(ours.path(), scene, times).join());
    }
    const char* name = joined ? "fields.h5" : "fields/t0001.h5";
    write_file_atomically(ours.path() / name, read_file(others.path() / name));
    const auto text =
        message_of<OutputError>([&] { FieldsFile::check_instants(ours.path(), times, written); });
    EXPECT_NE(text.find("not what the run has written"), std::string::npos) << text;
  }
}

TEST(FieldsFile, CellsInAnotherOrderAreRefused) {
  const TemporaryDirectory directory;
  const auto scene = small_scene();
  auto file = FieldsFile::create(directory.path(), scene);
  file.append(numbered_fields(scene, 0.0));
  {
    const auto piece = hdf5::open_for_writing(directory.path() / "fields/t0000.h5");
    const auto group = hdf5::open_group(piece, "instant");
    ASSERT_GE(H5Ldelete(group, "alpha", H5P_DEFAULT), 0);
    const hsize_t shape[] = {8, 5, 1};
    hdf5::write_compressed(group, "alpha", shape, std::vector<float>(40, 1.0F));
  }
  const auto text = message_of<OutputError>([&] { read_fields(directory.path() / "fields.h5", 0); });
  EXPECT_NE(text.find("alpha has the shape (8, 5, 1), allowed: (1, 5, 8)"), std::string::npos) << text;
}

TEST(FieldsFile, AFullDiskIsReportedAndLeavesTheEarlierInstants) {
  const auto scene = make_scene(2, {100, 100, 1}, {1.0, 1.0, 1.0});
  const TemporaryDirectory directory;
  const auto path = directory.path() / "fields.h5";
  auto file = FieldsFile::create(directory.path(), scene);
  file.append(numbered_fields(scene, 0.0));
  {
    const FullDisk full(10000);
    const auto text = message_of<OutputError>([&] { file.append(numbered_fields(scene, 1.0)); });
    EXPECT_NE(text.find("t0001.h5: File too large"), std::string::npos) << text;
    EXPECT_FALSE(file.join());
  }
  EXPECT_EQ(read_field_times(path), (std::vector<double>{0.0}));
  expect_same(read_fields(path, 0), numbered_fields(scene, 0.0));
  file.append(numbered_fields(scene, 1.0));
  EXPECT_TRUE(file.join());
  expect_same(read_fields(path, 1), numbered_fields(scene, 1.0));
}

// Bytes that this process has handed to write() and its like so far; none where the system does not count
// them.
std::int64_t bytes_written() {
  std::ifstream counters("/proc/self/io");
  std::string name;
  for (std::int64_t value = 0; counters >> name >> value;)
    if (name == "wchar:") return value;
  return 0;
}

// Twice the instants, twice the bytes; where every instant rewrites the list of all of them, four times.
TEST(FieldsFile, WhatAnInstantCostsDoesNotGrowWithTheirNumber) {
  const auto scene = make_scene(2, {2, 2, 1}, {0.1, 0.1, 0.1});
  const auto cost_of = [&](int instants) {
    const TemporaryDirectory directory;
    auto file = FieldsFile::create(directory.path(), scene);
    const std::int64_t before = bytes_written();
    for (int n = 0; n < instants; ++n) file.append(numbered_fields(scene, n));
    file.bring_up_to_date();
    EXPECT_EQ(read_field_times(directory.path() / "fields.h5").size(), static_cast<std::size_t>(instants));
    return bytes_written() - before;
  };
  const std::int64_t some = cost_of(100);
  if (some == 0) GTEST_SKIP() << "the system does not count what is written";
  EXPECT_LT(static_cast<double>(cost_of(200)), 2.4 * static_cast<double>(some));
}

// A reader of a run that goes on, or was killed, finds all instants of a short one and nearly all of a long
// one.
TEST(FieldsFile, TheListOfInstantsIsNeverFarBehind) {
  const auto scene = make_scene(2, {2, 2, 1}, {0.1, 0.1, 0.1});
  const TemporaryDirectory directory;
  const auto path = directory.path() / "fields.h5";
  auto file = FieldsFile::create(directory.path(), scene);
  for (std::size_t n = 1; n <= 60; ++n) {
    file.append(numbered_fields(scene, static_cast<double>(n)));
    const std::size_t listed = read_field_times(path).size();
    EXPECT_GE(listed, n - n / 16) << n;
  }
  EXPECT_EQ(file.instants(), 60U);
  ASSERT_TRUE(file.join());
  EXPECT_EQ(read_field_times(path).size(), 60U);
}

TEST(FieldsFile, RefusesArraysOfAnotherSize) {
  const auto scene = small_scene();
  const TemporaryDirectory directory;
  auto file = FieldsFile::create(directory.path(), scene);
  auto fields = numbered_fields(scene, 0.0);
  fields.u_s[1].clear();
  EXPECT_NE(message_of<std::invalid_argument>([&] { file.append(fields); }).find("u_s"), std::string::npos);
  EXPECT_THROW(file.append(numbered_fields(small_scene_3d(), 0.0)), std::invalid_argument);
  EXPECT_TRUE(read_field_times(directory.path() / "fields.h5").empty());
}

TEST(FieldsFile, ReadingADamagedOrMissingFileNamesIt) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "fields.h5";
  EXPECT_NE(message_of<OutputError>([&] { read_field_times(path); }).find(path.string()), std::string::npos);
  write_file_atomically(path, "not HDF5");
  EXPECT_NE(message_of<OutputError>([&] { read_field_times(path); }).find(path.string()), std::string::npos);
  EXPECT_THROW(FieldsFile::resume(directory.path(), small_scene(), {}), OutputError);
}

}  // namespace
