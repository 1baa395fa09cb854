// The run engine with a stand-in for granvof: lanes, how a run ended, what is not made again.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "compare/engine/engine.hpp"
#include "compare/tests/files_stated.hpp"
#include "compare/tests/stand_in.hpp"
#include "solver/output/seal.hpp"
#include "solver/scene/load_scene.hpp"
#include "solver/tests/cases_directory.hpp"
#include "solver/tests/temporary_directory.hpp"

namespace granvof::compare {
namespace {

namespace fs = std::filesystem;
using test::calls_beside;

class RunEngine : public testing::Test {
 protected:
  Engine engine(const std::string& body, int at_a_time = 1,
                const std::string& version = "granvof 1.0 (abc)") {
    test::write_stand_in(program_, body, version);
    return Engine({{program_.string()}, at_a_time, root_ / "accounts.csv"});
  }
  Order order(const std::string& id) const {
    Order wanted{id, cases_directory() / "canary.toml", {"time.end=2"}, root_ / id};
    return wanted;
  }
  std::vector<std::string> lines(const fs::path& file) const {
    std::ifstream in(root_ / file);
    std::vector<std::string> found;
    for (std::string line; std::getline(in, line);) found.push_back(line);
    return found;
  }
  // A run.json of the kind, by shell.
  static std::string leaves(const std::string& kind) {
    return "mkdir -p \"$out\"; echo '{\"exit\": {\"state\": \"failed\", \"kind\": \"" + kind +
           "\", \"reason\": \"why not\"}, \"core_seconds\": 0.5}' > \"$out/run.json\"; ";
  }

  const granvof::test::TemporaryDirectory directory_;
  const fs::path& root_ = directory_.path();
  const fs::path program_ = root_ / "program";
};

// Each run notes its beginning and its end: of those beside each other some begin before others end, a timed
// one never shares its time.
TEST_F(RunEngine, ATimedRunGoesAlone) {
  Engine made =
      engine("n=$(basename $out); echo begin $n >> " + (root_ / "times").string() +
                 "; sleep 0.15; echo end $n >> " + (root_ / "times").string() + "; " + leaves("finished"),
             2);
  for (const char* id : {"t1", "a", "b", "c", "t2"}) {
    Order wanted = order(id);
    wanted.timed = id[0] == 't';
    made.submit(wanted);
  }
  std::map<std::string, Ending> endings;
  while (!made.idle()) {
    Ending ending = made.wait();
    endings.emplace(ending.id, ending);
  }
  ASSERT_EQ(endings.size(), 5U);
  int active = 0, most = 0;
  bool timed = false;
  for (const std::string& line : lines("times")) {
    const bool begins = line.starts_with("begin");
    if (begins) {
      EXPECT_FALSE(timed) << line << " beside a timed run";
    }
    if (line.find(" t") != std::string::npos) {
      EXPECT_EQ(active, begins ? 0 : 1) << line;
      timed = begins;
    }
    active += begins ? 1 : -1;
    most = std::max(most, active);
  }
  EXPECT_EQ(most, 2);
  EXPECT_EQ(endings.at("t1").beside, 0);
  EXPECT_EQ(endings.at("a").beside, 1);
  EXPECT_EQ(endings.at("t1").work_units.size(), 2U);
  EXPECT_GT(endings.at("t1").work_units[0], 0.0);
  EXPECT_EQ(endings.at("t1").core_seconds, std::vector<double>{0.5});
  EXPECT_TRUE(endings.at("a").work_units.empty());
}

TEST_F(RunEngine, ACheapRunIsTimedAsOftenAsAsked) {
  Engine made = engine(leaves("finished"));
  Order wanted = order("cheap");
  wanted.timed = true;
  wanted.timings = 3;
  EXPECT_EQ(made.make(wanted).core_seconds.size(), 3U);
  EXPECT_EQ(calls_beside(program_).size(), 3U);
}

TEST_F(RunEngine, HowARunEndedIsWhatRunJsonSays) {
  struct Way {
    const char* name;
    std::string body, kind, message;
  };
  const std::vector<Way> ways{
      {"whole", leaves("finished"), "finished", ""},
      // whatever is printed and returned
      {"collapse", leaves("step collapse") + "echo 'blow-up (SIGXCPU)'; exit 1", "step collapse", "why not"},
      {"alarm", leaves("alarm") + "exit 1", "alarm", "why not"},
      {"limit", leaves("wall-clock limit") + "exit 3", "wall-clock limit", "why not"},
      {"liar", leaves("finished") + "echo '[12:00] [error] no'; exit 1", "error", "exit code 1: no"},
      {"input", "echo first; echo 'got 1, allowed 2' >&2; exit 2", "bad input", "got 1, allowed 2"},
      {"segv", leaves("running") + "kill -SEGV $$", "crashed", "exit code 139: no message"},
      {"silent", "exit 0", "crashed", "it ended and left no run.json"},
      {"term", "kill -TERM $$", "signal", "exit code 143: no message"}};
  for (const Way& way : ways) {
    const Ending ending = engine(way.body).make(order(way.name));
    EXPECT_EQ(ending.kind, way.kind) << way.name;
    EXPECT_EQ(ending.message, way.message) << way.name;
    EXPECT_EQ(ending.finished(), way.kind == "finished") << way.name;
  }
}

TEST_F(RunEngine, WhatAnEarlierRunLeftSaysNothingOfThisOne) {
  EXPECT_TRUE(engine(leaves("finished")).make(order("a")).finished());
  EXPECT_EQ(engine("exit 0").make(order("a")).kind, "crashed");
}

TEST_F(RunEngine, LimitsOfTheClockAndOfTheProcessor) {
  Order slow = order("slow");
  slow.limits.wall_seconds = 0.2;
  const Ending late = engine("exec sleep 30").make(slow);
  EXPECT_EQ(late.kind, "time limit");
  EXPECT_LT(late.process.wall_seconds, 20.0);
  Order busy = order("busy");
  busy.limits.cpu_seconds = 1.0;
  const Ending spent = engine("while :; do :; done").make(busy);
  EXPECT_EQ(spent.kind, "CPU limit");
  EXPECT_GT(spent.process.cpu_seconds, 0.5);
}

TEST_F(RunEngine, WhatTheSameProgramMadeIsKept) {
  Order wanted = order("kept");
  wanted.keep = true;
  EXPECT_FALSE(engine(leaves("finished")).make(wanted).kept);
  EXPECT_TRUE(engine(leaves("finished")).make(wanted).kept);
  EXPECT_FALSE(engine(leaves("finished"), 1, "granvof 1.1 (abd)").make(wanted).kept);  // another version
  Order other = wanted;
  other.set = {"time.end=3"};
  EXPECT_FALSE(engine(leaves("finished"), 1, "granvof 1.1 (abd)").make(other).kept);  // another case
  fs::remove(root_ / "kept/run.json");
  EXPECT_FALSE(engine(leaves("finished"), 1, "granvof 1.1 (abd)").make(other).kept);  // it is gone
  EXPECT_EQ(calls_beside(program_).size(), 4U);
}

// Whoever reads it would refuse it: made anew, it is what it was.
TEST_F(RunEngine, AFinishedRunThatWasChangedSinceIsMadeAgain) {
  Order wanted = order("kept");
  wanted.keep = true;
  const std::string series = "time [s]\n0\n2\n";
  const auto record = [&](const std::string& resolved) {
    return nlohmann::json{{"exit", {{"state", "finished"}, {"kind", "finished"}}},
                          {"files", granvof::test::files_stated(series)},
                          {"resolved_case", resolved}}
        .dump(2);
  };
  const std::string text = record(load_scene(wanted.case_file, wanted.set).resolved);
  std::ofstream(root_ / "record") << sealed(text);
  std::ofstream(root_ / "series") << series;
  Engine made = engine("mkdir -p \"$out\"; cp " + (root_ / "record").string() + " \"$out/run.json\"; cp " +
                       (root_ / "series").string() + " \"$out/series.csv\"");
  EXPECT_FALSE(made.make(wanted).kept);
  EXPECT_TRUE(made.make(wanted).kept);
  std::ofstream(wanted.directory / "series.csv") << "time [s]\n0\n1\n";
  EXPECT_FALSE(made.make(wanted).kept);
  EXPECT_TRUE(made.make(wanted).kept);
  std::ofstream(wanted.directory / "run.json") << sealed(record("of another case"));
  EXPECT_FALSE(made.make(wanted).kept);
  std::ofstream(wanted.directory / "run.json") << text;  // without what it says of itself
  EXPECT_FALSE(made.make(wanted).kept);
  EXPECT_TRUE(made.make(wanted).kept);
}

TEST_F(RunEngine, AFailureThatWouldComeAgainIsKeptAndOneThatMightNotIsMadeAgain) {
  for (const auto& [kind, kept] : {std::pair("step collapse", true), std::pair("alarm", true),
                                   std::pair("output", false), std::pair("signal", false)}) {
    Order wanted = order(kind);
    wanted.keep = true;
    const std::string body = leaves(kind) + "exit 1";
    EXPECT_FALSE(engine(body).make(wanted).kept);
    const Ending again = engine(body).make(wanted);
    EXPECT_EQ(again.kept, kept) << kind;
    EXPECT_EQ(again.kind, kind);
    EXPECT_EQ(again.message, "why not");
  }
}

TEST_F(RunEngine, ARunThatWasCutShortIsGoneOnWithByTheSameVersionAlone) {
  Order wanted = order("cut");
  wanted.keep = true;
  const auto leave = [&](const char* kind) {
    fs::create_directories(root_ / "cut");
    std::ofstream(root_ / "cut/checkpoint.h5") << "state";
    std::ofstream(root_ / "cut/run.json")
        << nlohmann::json{{"version", "1.0"},
                          {"git_commit", "abc"},
                          {"exit", {{"state", "stopped"}, {"kind", kind}}},
                          {"resolved_case", load_scene(wanted.case_file, wanted.set).resolved}};
  };
  for (const char* kind : {"signal", "wall-clock limit", "running"}) {
    leave(kind);
    EXPECT_TRUE(engine(leaves("finished")).make(wanted).resumed) << kind;
    EXPECT_NE(calls_beside(program_).back().find("--resume"), std::string::npos);
  }
  leave("signal");
  EXPECT_FALSE(engine(leaves("finished"), 1, "granvof 1.0 (abd)").make(wanted).resumed);
  EXPECT_NE(calls_beside(program_).back().find("--force"), std::string::npos);
  leave("step collapse");
  EXPECT_FALSE(engine(leaves("finished")).make(wanted).resumed);
  leave("signal");
  wanted.set = {"time.end=3"};
  EXPECT_FALSE(engine(leaves("finished")).make(wanted).resumed);
}

TEST_F(RunEngine, EachRunIsALineOfTheAccounts) {
  Engine made = engine(leaves("finished"));
  made.make(order("a"));
  made.make(order("b"));
  const auto account = lines("accounts.csv");
  ASSERT_EQ(account.size(), 3U);
  EXPECT_TRUE(account[0].starts_with("date,run,kind,core_seconds [s],")) << account[0];
  EXPECT_NE(account[1].find(",a,finished,0.5,"), std::string::npos) << account[1];
  EXPECT_NE(account[2].find(",b,finished,0.5,"), std::string::npos) << account[2];
}

// What a killed run leaves goes; what is somebody's stays, and so does all beside it.
TEST_F(RunEngine, WhatIsClearedIsARunAndNothingElse) {
  Engine made = engine(leaves("finished"));
  Order wanted = order("kept");
  wanted.clear = true;
  fs::create_directories(root_ / "kept/fields");
  for (const char* left : {"run.json.tmp", "series.csv", "fields/t0000.h5", "run.log"})
    std::ofstream(root_ / "kept" / left) << "left by a run";
  EXPECT_EQ(made.make(wanted).kind, ending::finished);
  EXPECT_FALSE(fs::exists(root_ / "kept/series.csv"));
  for (const char* mine : {"notes.txt", "made.json", "run.json", "fields.h5.bak"}) {
    const fs::path folder = root_ / (std::string("of a user ") + mine);
    fs::create_directories(folder);
    std::ofstream(folder / mine) << "{\"mine\": 1}";
    std::ofstream(folder / "series.csv") << "mine";
    wanted.directory = folder;
    const Ending refused = made.make(wanted);
    EXPECT_EQ(refused.kind, ending::bad_input) << mine;
    EXPECT_NE(refused.message.find(mine), std::string::npos) << refused.message;
    EXPECT_TRUE(fs::exists(folder / mine) && fs::exists(folder / "series.csv")) << mine;
  }
  fs::create_directories(root_ / "series of a user");
  std::ofstream(root_ / "series of a user/series.csv") << "mine";
  wanted.directory = root_ / "series of a user";
  EXPECT_EQ(made.make(wanted).kind, ending::bad_input);
  EXPECT_TRUE(fs::exists(root_ / "series of a user/series.csv"));
  for (const fs::path& place : {root_ / "kept/..", root_, root_ / "program"}) {
    wanted.directory = place;
    EXPECT_EQ(made.make(wanted).kind, ending::bad_input) << place;
    EXPECT_TRUE(fs::exists(root_ / "of a user notes.txt/notes.txt") && fs::exists(root_ / "program"))
        << place;
  }
}

TEST_F(RunEngine, AccountsAreAddedToAccountsAndToNothingElse) {
  std::ofstream(root_ / "accounts.csv") << "of a user\n";
  EXPECT_THROW(engine(leaves("finished")), std::runtime_error);
  EXPECT_EQ(lines("accounts.csv"), std::vector<std::string>{"of a user"});
  fs::remove(root_ / "accounts.csv");
  EXPECT_EQ(engine(leaves("finished")).make(order("a")).kind, ending::finished);
  EXPECT_EQ(engine(leaves("finished")).make(order("b")).kind, ending::finished);
  EXPECT_EQ(lines("accounts.csv").size(), 3U);
}

TEST_F(RunEngine, AProgramThatIsNotThereIsSaid) {
  EXPECT_THROW(Engine({{(root_ / "nothing").string()}, 1, {}}), std::runtime_error);
}

TEST(Order, IsTheSameAfterALine) {
  Order order{"id", "cases/a b.toml", {"k=[1, 2]", "l=\"x\""}, "out/a b"};
  order.program = {"valgrind", "granvof"};
  order.threads = 2;
  order.timed = order.keep = order.clear = true;
  order.timings = 3;
  order.limits = {10.0, 5.0};
  EXPECT_EQ(order_line(read_order(order_line(order))), order_line(order));
  const Order read = read_order(order_line(order));
  EXPECT_EQ(read.set, order.set);
  EXPECT_EQ(read.limits.cpu_seconds, 5.0);
  EXPECT_TRUE(read.timed && read.keep && read.clear);
}

TEST(Order, WhatIsWrongWithALineIsSaid) {
  for (const char* wrong :
       {"", "{", "[]", "{}", R"({"id": "a", "case": "c"})", R"({"id": "a", "case": "c", "directory": ""})",
        R"({"id": 1, "case": "c", "directory": "d"})",
        R"({"id": "a", "case": "c", "directory": "d", "jobs": 2})",
        R"({"id": "a", "case": "c", "directory": "d", "threads": 0})",
        R"({"id": "a", "case": "c", "directory": "d", "wall_limit": -1})"})
    EXPECT_THROW(read_order(wrong), std::invalid_argument) << wrong;
}

// In words of its own: no name or number of the library that reads it.
TEST(Order, WhatIsWrongIsSaidForAPerson) {
  for (const auto& [wrong, part] : std::vector<std::pair<std::string, std::string>>{
           {"{", "parse error at line 1"},
           {"{}", "key 'id' not found"},
           {R"({"id": 1, "case": "c", "directory": "d"})", "type must be string"}}) {
    try {
      read_order(wrong);
      ADD_FAILURE() << wrong;
    } catch (const std::invalid_argument& error) {
      const std::string said = error.what();
      EXPECT_EQ(said.find("json.exception"), std::string::npos) << said;
      EXPECT_NE(said.find(part), std::string::npos) << said;
    }
  }
}

}  // namespace
}  // namespace granvof::compare
