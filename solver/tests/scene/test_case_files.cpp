// Files: inheritance, names, and every case that is shipped.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "solver/tests/cases_directory.hpp"
#include "solver/tests/scene/case_fixture.hpp"
#include "solver/tests/temporary_directory.hpp"

namespace granvof::test {
namespace {

namespace fs = std::filesystem;

class CaseFiles : public ::testing::Test {
 protected:
  void SetUp() override { write("small.toml", small_case); }

  fs::path write(const std::string& name, std::string_view text) const {
    std::ofstream(directory_ / name) << text;
    return directory_ / name;
  }
  std::string refused(const fs::path& file, const std::vector<std::string>& overrides = {}) const {
    return refusal([&] { load_scene(file, overrides); });
  }
  std::string path(const std::string& name) const { return (directory_ / name).string(); }

 private:
  TemporaryDirectory temporary_;
  const fs::path& directory_ = temporary_.path();
};

TEST_F(CaseFiles, DeriveFromABase) {
  write(
      "middle.toml",
      "base = \"small.toml\"\n[scene]\nname = \"middle\"\n[solid]\ndensity = 600\n[bed]\ny = \"floating\"\n");
  const auto file =
      write("last.toml",
            "base = \"middle.toml\"\ngate = false\n[scene]\nname = \"last\"\n[solid]\nfriction = 0.3\n");
  const Scene scene = load_scene(file);
  EXPECT_EQ(scene.name, "last");
  EXPECT_EQ(scene.solid.density, 600.0);
  EXPECT_EQ(scene.solid.friction, 0.3);
  EXPECT_EQ(scene.solid.diameter, 0.8e-3);
  EXPECT_DOUBLE_EQ(scene.bed->box.lower[1], 0.04);
  EXPECT_FALSE(scene.gate);
  EXPECT_EQ(scene.resolved.find("base"), std::string::npos);
}

// A material, which is no case, over one that is, and the file's own over both.
TEST_F(CaseFiles, DeriveFromSeveralBasesInTheirOrder) {
  write("material.toml", "[solid]\nfriction = 0.3\n[contact]\nsolid_fraction_min = 0.58\n");
  const std::string own =
      "[scene]\nname = \"last\"\n[bed]\nsolid_fraction = 0.585\n[contact]\nsolid_fraction_max = 0.64\n";
  const Scene scene = load_scene(write("last.toml", "base = [\"small.toml\", \"material.toml\"]\n" + own));
  EXPECT_EQ(scene.solid.friction, 0.3);
  EXPECT_EQ(scene.solid.density, 2500.0);
  EXPECT_EQ(scene.contact.solid_fraction_min, 0.58);
  EXPECT_EQ(scene.contact.solid_fraction_max, 0.64);
  EXPECT_EQ(
      load_scene(write("last.toml", "base = [\"material.toml\", \"small.toml\"]\n" + own)).solid.friction,
      0.4);
}

// A preset of the case holds over that of its first base, whatever the bases between say of other keys.
TEST_F(CaseFiles, APresetOfALaterBaseHolds) {
  write("model.toml", "[model]\npreset = \"sourced\"\n");
  const auto file = write("last.toml", "base = [\"small.toml\", \"model.toml\"]\n[scene]\nname = \"last\"\n");
  EXPECT_TRUE(load_scene(file).model.agitation_drag);
}

TEST_F(CaseFiles, RefuseListsThatAreNoneOrNeverEnd) {
  EXPECT_EQ(refused(write("empty.toml", "base = []\n")),
            path("empty.toml") + ":1:8: base: got [], allowed: a file name in quotes, or a list of such");
  EXPECT_NE(refused(write("mixed.toml", "base = [\"small.toml\", 3]\n")).find("mixed.toml:1:8: base: got"),
            std::string::npos);
  EXPECT_NE(refused(write("lost.toml", "base = [\"small.toml\", \"none.toml\"]\n"))
                .find("lost.toml:1:23: base: got \"none.toml\", allowed: a case file; there is no"),
            std::string::npos);
  std::string before = "small.toml";
  for (int n = 0; n < 7; ++n) {  // each takes the one before it thrice
    const std::string name = fmt::format("three{}.toml", n);
    write(name, fmt::format("base = [\"{0}\", \"{0}\", \"{0}\"]\n", before));
    before = name;
  }
  EXPECT_NE(refused(path(before)).find("allowed: at most 32 files in all"), std::string::npos);
}

TEST_F(CaseFiles, OverridesComeAfterTheLastFile) {
  const auto file =
      write("last.toml", "base = \"small.toml\"\n[scene]\nname = \"last\"\n[solid]\nfriction = 0.3\n");
  EXPECT_EQ(load_scene(file, std::vector<std::string>{"solid.friction=0.2"}).solid.friction, 0.2);
}

TEST_F(CaseFiles, AnErrorNamesTheFileWhereTheValueStands) {
  write("bad.toml", "base = \"small.toml\"\n[scene]\nname = \"bad\"\n\n[solid]\nfriction = -1\n");
  const auto file = write("last.toml", "base = \"bad.toml\"\n[scene]\nname = \"last\"\n");
  EXPECT_EQ(refused(file), path("bad.toml") + ":6:12: solid.friction: got -1, allowed: a number >= 0");
}

TEST_F(CaseFiles, RefuseAMissingBaseAndACircle) {
  EXPECT_NE(
      refused(write("lost.toml", "base = \"none.toml\"\n")).find("lost.toml:1:8: base: got \"none.toml\""),
      std::string::npos);
  EXPECT_NE(refused(write("round.toml", "base = \"round.toml\"\n")).find("without a circle"),
            std::string::npos);
  EXPECT_NE(refused(write("number.toml", "base = 3\n")).find("number.toml:1:8: base: got 3"),
            std::string::npos);
}

TEST_F(CaseFiles, RefuseANameThatIsNotTheFiles) {
  EXPECT_EQ(refused(write("other.toml", small_case)),
            path("other.toml") + ":2:8: scene.name: got \"small\", allowed: \"other\", the file's stem");
}

TEST_F(CaseFiles, RefuseWhatCannotBeRead) {
  EXPECT_EQ(refused(path("none.toml")),
            path("none.toml") + ": cannot be read (No such file or directory), allowed: a case file (TOML)");
  EXPECT_NE(refused(fs::temp_directory_path()).find("cannot be read (Is a directory)"), std::string::npos);
  EXPECT_NE(refused("/dev/zero").find("/dev/zero: cannot be read (it is a device or a pipe)"),
            std::string::npos);
  ASSERT_EQ(::mkfifo(path("pipe.toml").c_str(), 0600), 0);
  EXPECT_NE(refused(path("pipe.toml")).find("pipe.toml: cannot be read (it is a device or a pipe)"),
            std::string::npos);
  fs::resize_file(write("huge.toml", ""), std::uintmax_t{1} << 29U);
  EXPECT_NE(refused(path("huge.toml")).find("has 536870912 bytes"), std::string::npos);
}

TEST_F(CaseFiles, TheResolvedFileLoadsToTheSameScene) {
  const Scene scene = load_scene(path("small.toml"));
  write("small.toml", scene.resolved);
  EXPECT_EQ(load_scene(path("small.toml")), scene);
}

std::vector<std::string> shipped() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(cases_directory())) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

class Shipped : public ::testing::TestWithParam<std::string> {};

TEST_P(Shipped, LoadsAndReadsBack) {
  const Scene scene = load_scene(fmt::format("{}/{}.toml", cases_directory().string(), GetParam()));
  EXPECT_EQ(scene.name, GetParam());
  EXPECT_NE(scene.title, scene.name) << "a shipped case has a title";
  Scene again = parse_scene(scene.resolved, "resolved");
  again.file = scene.file;
  EXPECT_EQ(scene, again);
}

std::string test_name(const ::testing::TestParamInfo<std::string>& shipped_case) {
  std::string name = shipped_case.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Cases, Shipped, ::testing::ValuesIn(shipped()), test_name);

TEST(ShippedCases, AreThoseOfThePaperAndTheLadder) {
  const auto names = shipped();
  for (const char* name : {"s1", "s2", "s1-loose", "s1-dense", "sw", "fw", "float-full-r08-nodrag",
                           "float-free-r02", "dam-break"}) {
    ASSERT_TRUE(std::count(names.begin(), names.end(), name)) << name;
    const Scene scene = load_scene(fmt::format("{}/{}.toml", cases_directory().string(), name));
    EXPECT_NE(scene.resolved.find("\npreset = \"paper\"\n"), std::string::npos) << name;
  }
}

// What `granvof-compare advise` found, beside the cases they are made of.
TEST(ShippedCases, AdvisedOnesLoad) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(cases_directory() / "advised")) {
    const Scene scene = load_scene(entry.path());
    EXPECT_EQ(scene.name, entry.path().stem().string());
    EXPECT_NE(scene.resolved, load_scene(scene.file.parent_path() / ".." /
                                         (scene.name.substr(0, scene.name.rfind("-advised")) + ".toml"))
                                  .resolved);
    ++count;
  }
  EXPECT_GE(count, 1);
}

// The beads' material over the paper's cases: same scales and place, less height of what fills it.
TEST(ShippedCases, OfBeadsHaveTheirMaterialAndTheScalesOfTheirCase) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(cases_directory() / "beads")) {
    const Scene scene = load_scene(entry.path());
    EXPECT_EQ(scene.name, entry.path().stem().string());
    const std::string of = scene.name.substr(0, scene.name.rfind("-beads"));
    const Scene plain = load_scene(cases_directory() / (of + ".toml"));
    EXPECT_EQ(scene.times, plain.times);
    EXPECT_EQ(scene.bed->nominal_height, plain.bed->nominal_height);
    EXPECT_EQ(scene.bed->box.upper[0], plain.bed->box.upper[0]);
    EXPECT_LT(scene.bed->box.upper[1], plain.bed->box.upper[1]);
    EXPECT_LT(scene.solid.friction, plain.solid.friction);
    constexpr double band = 0.0021;  // of the loosest packing that bears its weight, as measured
    EXPECT_GT(scene.bed->solid_fraction, scene.contact.solid_fraction_min - band);
    EXPECT_FALSE(scene.reference);  // its friction is the bulk's, not a bead's
    ++count;
  }
  EXPECT_GE(count, 1);
}

// Table 1 and 2 of the paper, written down here a second time on purpose.
TEST(ShippedCases, KeepThePapersNumbers) {
  const std::string cases = cases_directory();
  const Scene s1 = load_scene(cases + "/s1.toml");
  EXPECT_EQ(s1.solid, (Solid{2500, 0.8e-3, 0.9, 0.40}));
  EXPECT_EQ(s1.bed->box.upper[0], 0.0975);
  EXPECT_EQ(s1.bed->box.upper[1], 0.049);
  EXPECT_EQ(s1.liquid_boxes[0].upper[1], 0.07);
  EXPECT_EQ(s1.gate->speed, 1.0);
  EXPECT_DOUBLE_EQ(s1.times.end, 10 * std::sqrt(0.049 / 9.81));
  const Scene s2 = load_scene(cases + "/s2.toml");
  EXPECT_EQ(s2.bed->box.upper[0], 0.0575);
  EXPECT_EQ(s2.bed->box.upper[1], 0.084);
  EXPECT_EQ(s2.liquid_boxes[0].upper[1], 0.10);
  EXPECT_DOUBLE_EQ(s2.times.end, 10 * std::sqrt(0.084 / 9.81));
  const Scene fw = load_scene(cases + "/fw.toml");
  EXPECT_EQ(fw.solid, (Solid{910, 3.2e-3, 0.9, 0.47}));
  EXPECT_EQ(fw.liquid.density, 998);
  EXPECT_EQ(fw.bed->box.upper[0], 0.109);
  EXPECT_FALSE(fw.gate);
  const Scene r06 = load_scene(cases + "/float-full-r06.toml");
  EXPECT_EQ(r06.solid, (Solid{600, 2e-3, 0.9, 0.3}));
  EXPECT_EQ(r06.bed->solid_fraction, 0.5);
}

}  // namespace
}  // namespace granvof::test
