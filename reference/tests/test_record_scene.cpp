// One small case from preparation to its run directory.
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "reference/demvof/program/record_chute.hpp"
#include "reference/demvof/program/record_element.hpp"
#include "reference/demvof/program/record_scene.hpp"
#include "reference/demvof/program/scratch_folder.hpp"
#include "reference/tests/small_case.hpp"
#include "solver/output/output_error.hpp"
#include "solver/output/series_file.hpp"
#include "solver/tests/temporary_directory.hpp"

namespace {

namespace fs = std::filesystem;

struct Recorded {
  int code;
  std::string facts;  // run.json
  granvof::Series series;
};

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

Recorded recorded(const std::vector<std::string>& overrides) {
  const granvof::test::TemporaryDirectory directory;
  const fs::path& out = directory.path();
  demvof::RecordOptions options;
  options.out = out / "run";
  options.scratch = out / "scratch";
  options.command = "test";
  const int code = demvof::record_scene(demvof::test::small(overrides), options);
  return {code, text_of(options.out / "run.json"), granvof::read_series(options.out / "series.csv")};
}

}  // namespace

// Grains in air: nothing to lose, so nothing is lost; the column stands or falls as its grains do.
TEST(RecordScene, ACaseWithoutLiquidRuns) {
  const Recorded dry = recorded({"liquid=false"});
  EXPECT_EQ(dry.code, 0);
  EXPECT_NE(dry.facts.find("\"liquid_volume_error\": 0.0"), std::string::npos) << dry.facts;
  const auto change = dry.series.column("liquid_volume_change");
  ASSERT_EQ(change.size(), 6U);
  for (const auto& value : change) EXPECT_EQ(value, 0.0);
  EXPECT_GT(*dry.series.column("u_s_max").back(), 0.02);  // it does fall
  EXPECT_LT(*dry.series.column("u_s_max").back(), 0.5);
}

// The same with water, which is kept.
TEST(RecordScene, ACaseWithLiquidKeepsIt) {
  const Recorded wet = recorded({});
  EXPECT_EQ(wet.code, 0);
  for (const auto& value : wet.series.column("liquid_volume_change")) EXPECT_LT(std::abs(*value), 1e-8);
  EXPECT_GT(*wet.series.column("liquid_volume").back(), 0.0);
}

// Over a step, with and without a gate before it: to the end, and nothing is lost.
TEST(RecordScene, ACaseWithAnObstacleRunsAndKeepsWhatItHas) {
  for (const bool gate : {false, true}) {
    std::vector<std::string> changes{"reference.hold=0.005", "time.end=0.04"};
    if (gate) changes.emplace_back("gate={position=0.01, speed=1}");
    // The column leans on it where there is no gate.
    changes.push_back(
        fmt::format("obstacle={{x0=[{}], x1=[0.0175], y0=[0], y1=[0.0025]}}", gate ? 0.0125 : 0.01));
    const Recorded wet = recorded(changes);
    ASSERT_EQ(wet.code, 0) << wet.facts;
    const auto solid = wet.series.column("solid_volume");
    for (const auto& value : wet.series.column("liquid_volume_change")) EXPECT_LT(std::abs(*value), 1e-7);
    for (const auto& value : solid) EXPECT_NEAR(*value, *solid.front(), 1e-9 * *solid.front());
    EXPECT_GT(*wet.series.column("front_quantile").back(), 0.0102);
    // The water stands 15 mm high, and its surface has not moved by more than 2 mm.
    EXPECT_NEAR(*wet.series.column("p_base").back(), 9.81 * (15e-3 - 1.25e-3) * 1000.0, 25.0);
  }
}

// On an obstacle its base is there: the water over it has its own weight, and the bed rests.
TEST(RecordScene, ABedOnAnObstacleHasItsBaseThere) {
  const Recorded wet =
      recorded({"obstacle={x0=[0], x1=[0.0125], y0=[0], y1=[0.005]}", "bed.y=0.005", "bed.height=0.004"});
  ASSERT_EQ(wet.code, 0) << wet.facts;
  const double own = 9810.0 * (15e-3 - 5e-3 - 1.25e-3);
  EXPECT_NEAR(*wet.series.column("p_base").front(), own, 1.0);
  EXPECT_NEAR(*wet.series.column("excess_base_pressure").front(), 0.0, 1.0);
  EXPECT_NEAR(*wet.series.column("excess_base_pressure").back(), 0.0, 40.0);
}

// A column 7 beads high packs looser at its boundaries than asked for: it says so, and by how much.
TEST(RecordScene, APreparationThatMissesItsPackingSaysSo) {
  const auto warned = [](const Recorded& r) {
    return r.facts.find("reference.packing asks for") != std::string::npos;
  };
  const Recorded missed = recorded({"reference.packing=0.64"});
  EXPECT_EQ(missed.code, 0);
  EXPECT_TRUE(warned(missed)) << missed.facts;
  EXPECT_NE(missed.facts.find("asks for 0.64; released at 0.4"), std::string::npos) << missed.facts;
  const Recorded suspended = recorded({"reference.packing=0.3"});  // exact by construction
  EXPECT_EQ(suspended.code, 0);
  EXPECT_FALSE(warned(suspended)) << suspended.facts;
}

// No step is cut for a row or a field: with more of them the rows that both have are equal to the bit.
TEST(RecordScene, OutputDoesNotSteerTheRun) {
  // Powers of two: both have their rows at the same times to the bit.
  const Recorded seldom = recorded({"output.series_interval=0.00390625"});
  const Recorded often =
      recorded({"output.series_interval=0.001953125", "output.field_times=[0, 0.004, 0.0071]"});
  ASSERT_EQ(seldom.code + often.code, 0);
  ASSERT_EQ(seldom.series.rows.size(), 4U);  // the last at the end
  ASSERT_EQ(often.series.rows.size(), 7U);
  for (std::size_t r = 0; r < 3; ++r) EXPECT_EQ(seldom.series.rows[r], often.series.rows[2 * r]) << r;
  EXPECT_EQ(seldom.series.rows.back(), often.series.rows.back());
}

// Whatever it is doing, preparing the bed or moving it: it ends with its state in run.json.
TEST(RecordScene, ASignalEndsItAndItSaysSo) {
  const std::vector<std::pair<int, std::string>> signals{{SIGTERM, "SIGTERM"}, {SIGINT, "SIGINT"},
                                                         {SIGHUP, "SIGHUP"},   {SIGUSR1, "SIGUSR1"},
                                                         {SIGXCPU, "SIGXCPU"}, {SIGPIPE, "SIGPIPE"}};
  bool while_it_moves = true;
  for (const auto& [number, name] : signals) {
    const granvof::test::TemporaryDirectory directory;
    demvof::RecordOptions options;
    options.out = directory.path() / "run";
    options.scratch = directory.path() / "scratch";
    const fs::path sign = options.out / (while_it_moves ? "series.csv" : "run.json");
    const auto has_begun = [&] {
      return fs::exists(sign) && (!while_it_moves || text_of(sign).find("\n0.002,") != std::string::npos);
    };
    std::thread sender([&, signal = number] {
      for (int tries = 0; tries < 60000 && !has_begun(); ++tries)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      ::kill(::getpid(), signal);
    });
    const int code = demvof::record_scene(demvof::test::small({"time.end=10"}), options);
    sender.join();
    EXPECT_EQ(code, 1) << name;
    const std::string facts = text_of(options.out / "run.json");
    EXPECT_NE(facts.find("\"state\": \"stopped\""), std::string::npos) << facts;
    EXPECT_NE(facts.find("stopped by a signal (" + name + ")"), std::string::npos) << facts;
    EXPECT_NE(facts.find("\"resume_from\": null"), std::string::npos) << facts;
    while_it_moves = !while_it_moves;
  }
}

namespace {

demvof::RecordOptions options_in(const fs::path& directory) {
  demvof::RecordOptions options;
  options.out = directory / "run";
  options.scratch = directory / "scratch";
  return options;
}

// What run.json says of a scene that fails before its first step.
std::string facts_of_failed(const granvof::Scene& scene) {
  const granvof::test::TemporaryDirectory directory;
  const demvof::RecordOptions options = options_in(directory.path());
  EXPECT_EQ(demvof::record_scene(scene, options), 1);
  const std::string facts = text_of(options.out / "run.json");
  EXPECT_NE(facts.find("\"state\": \"failed\""), std::string::npos) << facts;
  return facts;
}

}  // namespace

// Contacts so stiff that reference.dt is too long for them.
TEST(RecordScene, AFailureBeforeTheFirstStepIsAnEndThatIsWritten) {
  const std::string facts = facts_of_failed(demvof::test::small({"reference.young=1e9"}));
  EXPECT_NE(facts.find("beads have left the tank"), std::string::npos) << facts;
}

// LIGGGHTS ends the program where it finds an error, as it does in a restitution that no case file may have.
TEST(RecordScene, AnEndByLiggghtsIsAnEndThatIsWritten) {
  granvof::Scene scene = demvof::test::small();
  scene.reference->bead_restitution = 2.0;
  const std::string facts = facts_of_failed(scene);
  EXPECT_NE(facts.find("LIGGGHTS ended the program with exit code 1: ERROR"), std::string::npos) << facts;
}

// OpenFOAM drops blanks and quotes from names, LIGGGHTS ends a word at a quote.
TEST(RecordScene, AScratchFolderMayHaveAnyName) {
  for (const char* name : {" ", "~", "a \"b\" it's\n$HOME #c \xc3\xa4\\d"}) {
    const granvof::test::TemporaryDirectory directory;
    demvof::RecordOptions options = options_in(directory.path());
    options.scratch = directory.path() / name;
    EXPECT_EQ(demvof::record_scene(demvof::test::small({"time.end=0.002"}), options), 0) << name;
    EXPECT_FALSE(fs::exists(options.scratch)) << name << ": it made the folder, and nothing is left in it";
  }
}

TEST(RecordScene, AScratchFolderThatCannotBeUsedIsRefusedAndNothingIsWritten) {
  const granvof::test::TemporaryDirectory directory;
  demvof::RecordOptions options = options_in(directory.path());
  const fs::path file = directory.path() / "file", too_long(std::string(300, 'a'));
  std::ofstream(file) << "a file where a folder should be made";
  for (const fs::path& scratch : {file, file / "below", fs::path("/proc/nowhere"),
                                  directory.path() / too_long, directory.path() / "new" / too_long}) {
    options.scratch = scratch;
    EXPECT_THROW(demvof::record_scene(demvof::test::small(), options), granvof::OutputError) << scratch;
    EXPECT_FALSE(fs::exists(options.out)) << scratch;
    EXPECT_FALSE(fs::exists(directory.path() / "new")) << scratch;
  }
}

// What LIGGGHTS and OpenFOAM had written when one of them ended the program, or the program was killed.
TEST(RecordScene, NoScratchFileOutlivesItsRun) {
  const granvof::test::TemporaryDirectory directory;
  const demvof::RecordOptions options = options_in(directory.path());
  granvof::Scene scene = demvof::test::small({"time.end=0.002"});
  scene.reference->bead_restitution = 2.0;
  EXPECT_EQ(demvof::record_scene(scene, options), 1);
  EXPECT_FALSE(fs::exists(options.scratch));

  fs::create_directories(options.scratch / "demvof-killed/fluid-1-0");
  fs::create_directory(options.scratch / "mine");
  std::ofstream(options.scratch / "demvof-killed/gate-1.stl") << "solid";
  {
    const demvof::ScratchFolder living(options.scratch);
    std::ofstream(living.name() / "beads.data") << "beads";
    EXPECT_FALSE(fs::exists(options.scratch / "demvof-killed"));
    EXPECT_EQ(demvof::record_scene(demvof::test::small({"time.end=0.002"}), options), 0);
    EXPECT_TRUE(fs::exists(living.name() / "beads.data")) << "one that runs beside it";
  }
  fs::remove(options.scratch / "mine");
  EXPECT_TRUE(fs::is_empty(options.scratch));
}

TEST(RecordScene, ARunDirectoryThatIsRefusedLeavesNoScratchFolder) {
  const granvof::test::TemporaryDirectory directory;
  const demvof::RecordOptions options = options_in(directory.path());
  std::ofstream(options.out) << "a file where a run should be made";
  EXPECT_THROW(demvof::record_scene(demvof::test::small(), options), granvof::OutputError);
  EXPECT_FALSE(fs::exists(options.scratch));
}

// A recording of the same scene is none either: it took a day.
TEST(RecordChute, AnothersDirectoryIsRefusedBeforeTheWork) {
  const granvof::test::TemporaryDirectory directory;
  demvof::RecordOptions options = options_in(directory.path());
  const granvof::Scene scene = demvof::test::small({"time.end=0.002"});
  ASSERT_EQ(demvof::record_scene(scene, options), 0);
  const std::string recorded = text_of(options.out / "run.json");
  EXPECT_THROW(demvof::record_chute(scene, options), granvof::OutputError);
  EXPECT_EQ(text_of(options.out / "run.json"), recorded);
  const fs::path mine = directory.path() / "mine";
  fs::create_directory(mine);
  std::ofstream(mine / "series.csv") << "mine";
  for (const fs::path& out : {mine, mine / "series.csv"}) {
    options.out = out;
    EXPECT_THROW(demvof::record_chute(scene, options), granvof::OutputError) << out;
  }
  EXPECT_EQ(text_of(mine / "series.csv"), "mine");
}

// Nor are element tests a chute, which lacks most of them.
TEST(RecordElement, BadInputIsRefusedBeforeTheWorkAndNothingIsWritten) {
  const granvof::test::TemporaryDirectory directory;
  demvof::RecordOptions options = options_in(directory.path());
  const auto refused = [&](const granvof::Scene& scene) {
    return granvof::test::refusal([&] { demvof::record_element(scene, options); });
  };
  EXPECT_NE(refused(demvof::test::small({"reference=false"})).find("it has no [reference] table"),
            std::string::npos);
  EXPECT_NE(refused(demvof::test::small({"tank.gravity=0"})).find("tank.gravity is 0, allowed: > 0"),
            std::string::npos);
  EXPECT_FALSE(fs::exists(options.out));
  fs::create_directory(options.out);
  std::ofstream(options.out / "run.json") << R"({"scene": "small", "monitors": {"mu_s": 0.3}})";
  EXPECT_THROW(demvof::record_element(demvof::test::small(), options), granvof::OutputError);
  EXPECT_FALSE(fs::exists(options.out / "series.csv"));
}
