// What is no file is neither opened nor replaced, and an HDF5 file leads nowhere but to its own instants.
#include <atomic>
#include <chrono>
#include <fstream>
#include <functional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/stat.h>

#include "solver/output/atomic_file.hpp"
#include "solver/output/digest.hpp"
#include "solver/output/fields_file.hpp"
#include "solver/output/hdf5_file.hpp"
#include "solver/output/output_error.hpp"
#include "solver/output/series_file.hpp"
#include "solver/tests/output/run_directory.hpp"

using namespace granvof;
using namespace granvof::test;

namespace {

namespace fs = std::filesystem;

using Place = std::function<void(const fs::path&)>;

// Opening the first waits for its other end, the second has no end.
const std::vector<std::pair<std::string, Place>> no_files{
    {"pipe", [](const fs::path& path) { ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0); }},
    {"device", [](const fs::path& path) { fs::create_symlink("/dev/zero", path); }},
    {"socket", [](const fs::path& path) { ASSERT_EQ(::mknod(path.c_str(), S_IFSOCK | 0600, 0), 0); }},
    {"directory", [](const fs::path& path) { fs::create_directory(path); }},
    {"link to nothing", [](const fs::path& path) { fs::create_symlink("nothing", path); }},
    {"link to itself", [](const fs::path& path) { fs::create_symlink(path.filename(), path); }}};

class NotAFile : public RunDirectory {
 protected:
  // A run with two instants, each in a file of its own.
  void write_linked() const {
    auto writer = fresh();
    for (const double time : {0.0, 0.1}) {
      write_row(writer, time);
      writer.write_fields(numbered_fields(scene, time));
    }
    writer.write_checkpoint(state(0.1), progress(0.1));
  }
};

void write_dataset_elsewhere(hid_t group, const char* name, const std::string& file, bool is_virtual) {
  const hsize_t shape[] = {4};
  const hid_t space = H5Screate_simple(1, shape, nullptr), made = H5Pcreate(H5P_DATASET_CREATE);
  if (is_virtual) {
    ASSERT_GE(H5Pset_virtual(made, space, file.c_str(), "x", space), 0);
  } else {
    ASSERT_GE(H5Pset_external(made, file.c_str(), 0, H5F_UNLIMITED), 0);
  }
  H5Ldelete(group, name, H5P_DEFAULT);
  const hid_t set = H5Dcreate2(group, name, H5T_IEEE_F32LE, space, H5P_DEFAULT, made, H5P_DEFAULT);
  ASSERT_GE(set, 0);
  H5Dclose(set);
  H5Pclose(made);
  H5Sclose(space);
}

// Changes the group of the first instant in an HDF5 file.
void in_group(const fs::path& path, const char* name, const std::function<void(hid_t)>& change) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  const hid_t group = H5Gopen2(file, name, H5P_DEFAULT);
  ASSERT_GE(group, 0);
  change(group);
  H5Gclose(group);
  H5Fclose(file);
}

TEST_F(NotAFile, IsReadByNobody) {
  fs::create_directories(run);
  for (const auto& [kind, put] : no_files) {
    const fs::path path = run / kind;
    put(path);
    EXPECT_THROW(read_file(path), OutputError) << kind;
    EXPECT_THROW(digest_of_file(path), OutputError) << kind;
    EXPECT_THROW(read_series(path), OutputError) << kind;
    EXPECT_THROW(read_field_times(path), OutputError) << kind;
    EXPECT_THROW(read_fields(path, 0), OutputError) << kind;
  }
}

// What was opened is asked what it is: a pipe that takes the name of a file a moment later is not waited for.
TEST_F(NotAFile, MayTakeAFilesNameMeanwhile) {
  fs::create_directories(run);
  write_linked();
  const fs::path name = directory.path() / "given", draft = directory.path() / "draft";
  std::atomic<bool> over = false;
  fs::copy_file(run / "fields/t0000.h5", name);
  std::thread other([&] {
    while (!over) {
      fs::copy_file(run / "fields/t0000.h5", draft);
      fs::rename(draft, name);
      ASSERT_EQ(::mkfifo(draft.c_str(), 0600), 0);
      fs::rename(draft, name);
    }
  });
  const hdf5::QuietErrors quiet;
  int read = 0, refused = 0;
  const auto ask = [&](const std::function<void()>& reader) {
    try {
      reader();
      ++read;
    } catch (const OutputError&) {
      ++refused;
    }
  };
  // How often the other comes to its turn is the machine's affair.
  const auto latest = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  const auto goes_on = [&] {
    return (read == 0 || refused == 0) && std::chrono::steady_clock::now() < latest;
  };
  for (int attempt = 0; attempt < 300 || goes_on(); ++attempt) {
    ask([&] { read_file(name); });
    ask([&] { digest_of_file(name); });
    ask([&] { hdf5::open_for_reading(name); });
  }
  over = true;
  other.join();
  EXPECT_GT(read, 0);
  EXPECT_GT(refused, 0);
}

TEST_F(NotAFile, NorIsWhatNoMemoryHolds) {
  fs::create_directories(run);
  const fs::path path = run / "with holes";
  std::ofstream(path) << "time [s]\n";
  fs::resize_file(path, std::uintmax_t{1} << 40U);
  EXPECT_NE(message_of<OutputError>([&] { read_file(path); }).find("1099511627776 bytes"), std::string::npos);
  EXPECT_THROW(read_series(path), OutputError);
}

TEST_F(NotAFile, IsNotReachedThroughALink) {
  for (const auto& [kind, put] : no_files) {
    write_linked();
    const auto piece = run / "fields/t0000.h5";
    fs::remove(piece);
    put(piece);
    const auto said = message_of<OutputError>([&] { resume(); });
    EXPECT_NE(said.find("fields/t0000.h5"), std::string::npos) << kind << ": " << said;
    EXPECT_THROW(read_field_times(run / "fields.h5"), OutputError) << kind;
    EXPECT_THROW(read_solid_fraction(run / "fields.h5", 0), OutputError) << kind;
    fs::remove_all(run);
  }
}

TEST_F(NotAFile, IsNotReplaced) {
  fs::create_directories(run);
  for (const auto& [kind, put] : no_files) {
    if (kind.starts_with("link to")) continue;  // what stands there is nothing
    put(run / kind);
    EXPECT_THROW(write_file_atomically(run / kind, "x"), OutputError) << kind;
    EXPECT_FALSE(fs::is_regular_file(fs::status(run / kind))) << kind;
    EXPECT_FALSE(fs::exists(run / (kind + ".tmp"))) << kind;
  }
}

TEST_F(NotAFile, NothingOfAnInstantLiesInAnotherFile) {
  const auto pipe = directory.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const std::vector<std::function<void(hid_t)>> changes{
      [&](hid_t group) {
        H5Ldelete(group, "f_s", H5P_DEFAULT);
        H5Lcreate_external(pipe.c_str(), "/x", group, "f_s", H5P_DEFAULT, H5P_DEFAULT);
      },
      [&](hid_t group) {
        H5Ldelete(group, "f_s", H5P_DEFAULT);
        H5Lcreate_external(pipe.c_str(), "/x", group, "between", H5P_DEFAULT, H5P_DEFAULT);
        H5Lcreate_soft("between/x", group, "f_s", H5P_DEFAULT, H5P_DEFAULT);
      },
      [&](hid_t group) { write_dataset_elsewhere(group, "f_s", pipe, false); },
      [&](hid_t group) { write_dataset_elsewhere(group, "f_s", pipe, true); }};
  for (std::size_t change = 0; change < changes.size(); ++change) {
    write_linked();
    in_group(run / "fields/t0000.h5", "instant", changes[change]);
    EXPECT_THROW(resume(), OutputError) << change;
    EXPECT_THROW(read_solid_fraction(run / "fields.h5", 0), OutputError) << change;
    fs::remove_all(run);
  }
}

TEST_F(NotAFile, AnInstantLinksToItsOwnFileAlone) {
  write_linked();
  in_group(run / "fields.h5", "/", [&](hid_t root) {
    H5Ldelete(root, "t0000", H5P_DEFAULT);
    H5Lcreate_external("../fields/t0001.h5", "/instant", root, "t0000", H5P_DEFAULT, H5P_DEFAULT);
  });
  const auto said = message_of<OutputError>([&] { read_field_times(run / "fields.h5"); });
  EXPECT_NE(said.find("t0000 links to /instant in ../fields/t0001.h5, allowed: /instant in fields/t0000.h5"),
            std::string::npos)
      << said;
}

// HDF5 writes as many values as there are over what was meant for one.
TEST_F(NotAFile, AListInThePlaceOfANumberIsRefused) {
  write_linked();
  in_group(run / "fields/t0000.h5", "instant", [](hid_t group) {
    const hsize_t shape[] = {1000};
    const std::vector<double> many(1000, 1.0);
    const hid_t space = H5Screate_simple(1, shape, nullptr);
    H5Adelete(group, "time");
    const hid_t time = H5Acreate2(group, "time", H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(time, H5T_NATIVE_DOUBLE, many.data());
    H5Aclose(time);
    H5Sclose(space);
  });
  EXPECT_NE(
      message_of<OutputError>([&] { read_field_times(run / "fields.h5"); }).find("more or less than one"),
      std::string::npos);
}

TEST_F(NotAFile, ASizeThatNoMemoryHoldsIsRefused) {
  write_linked();
  in_group(run / "fields/t0000.h5", "instant", [](hid_t group) {
    const hsize_t shape[] = {hsize_t{1} << 50U}, chunk[] = {1024};
    const hid_t space = H5Screate_simple(1, shape, nullptr), made = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(made, 1, chunk);
    H5Ldelete(group, "f_s", H5P_DEFAULT);
    H5Dclose(H5Dcreate2(group, "f_s", H5T_IEEE_F32LE, space, H5P_DEFAULT, made, H5P_DEFAULT));
    H5Pclose(made);
    H5Sclose(space);
  });
  const auto said = message_of<OutputError>([&] { read_fields(run / "fields.h5", 0); });
  EXPECT_NE(said.find("no memory for 1125899906842624 values"), std::string::npos) << said;
}

}  // namespace
