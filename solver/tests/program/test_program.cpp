// The program from outside: exit codes, what goes to which stream, and that bad input writes nothing.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include "solver/tests/cases_directory.hpp"
#include "solver/tests/temporary_directory.hpp"

namespace {

struct Outcome {
  int code = -1;
  std::string out, err;
};

// A fresh working directory for each test.
class Program : public ::testing::Test {
 protected:
  // `before` is what the shell does first; a redirection at the end of the arguments has the last word.
  Outcome granvof(const std::string& arguments, const std::string& before = "") const {
    const std::string command = "cd '" + directory_.string() + "' && " + before + " '" GRANVOF_PROGRAM "' " +
                                " >stdout.txt 2>stderr.txt </dev/null " + arguments;
    const int status = std::system(command.c_str());
    Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, text("stdout.txt"), text("stderr.txt")};
    std::filesystem::remove(directory_ / "stdout.txt");
    std::filesystem::remove(directory_ / "stderr.txt");
    return outcome;
  }

  void expect_refused(const std::string& arguments, const std::string& part,
                      const std::string& before = "") const {
    const Outcome outcome = granvof(arguments, before);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_TRUE(std::filesystem::is_empty(directory_)) << arguments;
  }

  std::string record() const { return text("out/run.json"); }
  std::string log() const { return text("out/run.log"); }

  static std::string shipped(const std::string& name) {
    return "'" + granvof::cases_directory().string() + "/" + name + ".toml'";
  }

 private:
  std::string text(const std::string& name) const {
    std::ifstream in(directory_ / name);
    std::ostringstream content;
    content << in.rdbuf();
    return content.str();
  }

  granvof::test::TemporaryDirectory temporary_;
  const std::filesystem::path& directory_ = temporary_.path();
};

TEST_F(Program, PrintsVersionAndHelp) {
  const Outcome version = granvof("--version");
  EXPECT_EQ(version.code, 0);
  EXPECT_EQ(version.out.rfind("granvof ", 0), 0U) << version.out;
  const Outcome help = granvof("--help");
  EXPECT_EQ(help.code, 0);
  for (const char* word : {"run", "check", "report", "sweep", "restate", "keys"})
    EXPECT_NE(help.out.find(word), std::string::npos) << word;
}

TEST_F(Program, ChecksACase) {
  const Outcome outcome = granvof("check " + shipped("s1") + " --set grid.dx=0.00125 --set time.end=2");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out.rfind("# s1: 320 x 96 x 1 cells", 0), 0U) << outcome.out;
  EXPECT_NE(outcome.out.find("\nend = 2\n"), std::string::npos);
}

TEST_F(Program, SaysWhichPartsOfTheModelAct) {
  const std::string out = granvof("check " + shipped("s1") + " --set model.drag=false").out;
  const auto model = out.find("\n# model: "), rest = out.find("\n# not in this scene: ");
  ASSERT_LT(model, rest) << out.substr(0, 600);
  ASSERT_LT(rest, out.find("\n[scene]\n"));
  EXPECT_LT(out.find("; friction (17)", model), rest);
  EXPECT_GT(out.find("drag (8), (9)"), rest);
  EXPECT_NE(out.find("drag (8), (9)"), std::string::npos);
}

TEST_F(Program, EstimatesWhatARunTakes) {
  const std::string out = granvof("check " + shipped("s1")).out;
  double steps = 0.0, seconds = 0.0, megabytes = 0.0;
  const auto at = out.find("# estimated:");
  ASSERT_NE(at, std::string::npos) << out.substr(0, 300);
  ASSERT_EQ(std::sscanf(out.c_str() + at, "# estimated: %lf steps, %lf s on one core, %lf MB", &steps,
                        &seconds, &megabytes),
            3);
  EXPECT_NEAR(steps, 241.0, 120.0);  // what make verify takes
  EXPECT_GT(seconds, 0.5);
  EXPECT_LT(seconds, 20.0);
  EXPECT_GT(megabytes, 10.0);
}

TEST_F(Program, DrawsTheStart) {
  const granvof::test::TemporaryDirectory pictures;
  const std::filesystem::path file = pictures.path() / "start.svg";
  const auto drawn = [&](const std::string& arguments) {
    EXPECT_EQ(granvof("check " + arguments + " --picture " + file.string()).code, 0);
    std::ifstream in(file);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  const auto count = [](const std::string& text, const std::string& part) {
    int found = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
  };
  const std::string s1 = drawn(shipped("s1") + " --set grid.dx=0.01");
  // 720 px are 0.4 m, from 60 px; the tank is 0.12 m high, so that its floor is at 276 px.
  EXPECT_NE(s1.find("class=\"liquid\" x=\"60.00\" y=\"150.00\" width=\"720.00\" height=\"126.00\""),
            std::string::npos)
      << s1;
  EXPECT_NE(s1.find("class=\"bed\" points=\"60.00,276.00 235.50,276.00 235.50,187.80 60.00,187.80\""),
            std::string::npos)
      << s1;
  EXPECT_NE(s1.find("class=\"gate\" x1=\"235.50\""), std::string::npos) << s1;
  EXPECT_EQ(count(s1, "class=\"grid\""), 39 + 11);
  EXPECT_EQ(count(s1, "class=\"side\""), 4);
  EXPECT_EQ(count(s1, "stroke-dasharray"), 1);  // the open top
  EXPECT_EQ(count(drawn(shipped("s1") + " --set grid.dx=0.00125"), "class=\"grid\""), 0);
  const std::string dam = drawn(shipped("dam-break"));
  EXPECT_EQ(count(dam, "class=\"bed\"") + count(dam, "class=\"gate\""), 0);
  const std::string channel = drawn(shipped("channel"));
  EXPECT_EQ(count(channel, ">inlet<") + count(channel, ">outlet<"), 2) << channel;
  EXPECT_EQ(count(channel, ">no-slip<"), 2);
  EXPECT_EQ(count(drawn(shipped("step")), "class=\"obstacle\""), 2);
  expect_refused("check " + shipped("s1") + " --picture /nonexistent/start.svg", "/nonexistent");
  // A picture is drawn over a picture, and over nothing else: the case itself, say.
  const std::filesystem::path other = pictures.path() / "s1.toml";
  std::ofstream(other) << "scene";
  expect_refused("check " + shipped("s1") + " --picture " + other.string(), "holds something else");
  EXPECT_EQ(std::filesystem::file_size(other), 5U);
}

TEST_F(Program, RestatesACase) {
  const Outcome outcome = granvof("restate " + shipped("s1") + " --mass 2 --length 0.25 --time 0.5");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out.rfind("# s1: mass x 2, length x 0.25, time x 0.5\n", 0), 0U) << outcome.out;
  EXPECT_NE(outcome.out.find("\nsize = [0.1, 0.03]\n"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("\ndensity = 320000\n"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("\nend = 10\n"), std::string::npos) << outcome.out;
  expect_refused("restate " + shipped("s1") + " --length 0", "--length");
  expect_refused("restate " + shipped("s1") + " --length long", "--length");
  for (const char* value : {"nan", "inf", "-1", "1e308", "1e-320"})
    expect_refused("restate " + shipped("s1") + " --mass " + value,
                   "given, allowed: a number in [1e-30, 1e30]");
}

TEST_F(Program, TakesListsAndInlineTablesAsOverrides) {
  const Outcome outcome =
      granvof("check --set 'tank.size=[0.3, 0.12]' --set 'walls.left={ fluid = \"slip\" }' " + shipped("s1"));
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("size = [0.3, 0.12]"), std::string::npos);
  EXPECT_NE(outcome.out.find("left.fluid = \"slip\""), std::string::npos);
}

TEST_F(Program, PrintsTheKeys) {
  const Outcome outcome = granvof("keys");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.out.find("| friction | a number >= 0 | required |"), std::string::npos) << outcome.out;
}

TEST_F(Program, RefusesBadCommands) {
  expect_refused("", "subcommand");
  expect_refused("fly", "fly");
  expect_refused("run", "case is required");
  expect_refused("run " + shipped("s1") + " --threads 0", "--threads");
  expect_refused("run " + shipped("s1") + " --thread 2", "--thread");
  expect_refused("run " + shipped("s1") + " --stop-after 50", "--stop-after");
}

TEST_F(Program, RefusesBadCasesAndWritesNothing) {
  expect_refused("run " + shipped("s1") + " --set solid.friction=-0.4",
                 "--set: solid.friction: got -0.4, allowed: a number >= 0");
  expect_refused("check no-such-case.toml", "no-such-case.toml");
  expect_refused("check /dev/zero", "/dev/zero: cannot be read (it is a device or a pipe)");
  expect_refused("run " + shipped("s1") + " --out ''", "--out");
}

TEST_F(Program, NamesAllFaultsOnALineEach) {
  const Outcome outcome =
      granvof("run " + shipped("s1") + " --set solid.friction=-1 --set grid.dx=0.03 --set bed.colour=red");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 3) << outcome.err;
}

TEST_F(Program, RefusesAGridThatDoesNotFitIntoMemory) {
  expect_refused(
      "run " + shipped("sw") + " --set grid.dx=0.0005 --set solid.diameter=2e-4 --set reference=false",
      "192000000 cells need 576 GB");
  expect_refused(
      "run " + shipped("s1") + " --set grid.dx=0.0003125 --set solid.diameter=2e-4 --set reference=false",
      "need 1 GB and there are 0.512 GB", "ulimit -v 500000 && ");
}

TEST_F(Program, WarnsOfImplausibleValuesOnceEach) {
  const std::string mistaken =
      shipped("s1") + " --set solid.friction=21.8 --set solid.diameter=0.8 --set time.end=0.01";
  for (const std::string command : {"check ", "run "}) {
    const Outcome outcome = granvof(command + mistaken +
                                    " --set output.series_interval=0.01 "
                                    "--set 'output.field_times=[0]'");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    for (const char* part : {"s1: warning: solid.friction = 21.8: usual is 0.05 to 1.5",
                             "s1: warning: solid.diameter = 0.8 m: usual is 1e-05 to 0.1 m"}) {
      const auto at = outcome.err.find(part);
      ASSERT_NE(at, std::string::npos) << outcome.err;
      EXPECT_EQ(outcome.err.find(part, at + 1), std::string::npos) << outcome.err;
    }
  }
}

// A start so dense that the run warns, over in no time.
const std::string dense =
    " --set bed.solid_fraction=0.62 --set grid.dx=0.005 --set time.end=0.05 --set "
    "output.series_interval=0.01";

TEST_F(Program, WarnsOnStderrWhateverBecomesOfStdout) {
  for (const char* redirection : {"", " >&-", " >/dev/full", " <&- >&-"}) {
    const Outcome outcome = granvof("run " + shipped("canary-dry") + dense + " --out out" + redirection);
    EXPECT_EQ(outcome.code, 0) << redirection << outcome.err;
    EXPECT_EQ(outcome.out, "") << redirection;
    EXPECT_NE(outcome.err.find("[warning]"), std::string::npos) << redirection << outcome.err;
  }
  // with stderr closed as well, nothing of it gets into a result
  EXPECT_EQ(granvof("run " + shipped("canary-dry") + dense + " --out out <&- >&- 2>&-").code, 0);
  EXPECT_NE(record().find("\"state\": \"finished\""), std::string::npos);
}

// Nobody can read it: as on a full disk.
TEST_F(Program, ResultsThatCannotBePrintedAreNoSuccess) {
  for (const char* redirection : {" >/dev/full", " >&-", " <&- >&-"}) {
    for (const char* command : {"check ", "restate "}) {
      const Outcome outcome = granvof(command + shipped("canary-dry") + redirection);
      EXPECT_EQ(outcome.code, 1) << command << redirection;
      EXPECT_NE(outcome.err.find("granvof: cannot write to standard output"), std::string::npos)
          << command << redirection << outcome.err;
    }
  }
  EXPECT_EQ(granvof("check " + shipped("canary-dry") + " 2>&-").code, 0);
}

TEST_F(Program, RefusesAStackThatIsTooSmall) {
  expect_refused("run " + shipped("canary-dry") + " --out out",
                 "granvof: a stack of 512 kB (ulimit -s), needed: 1024", "ulimit -s 512 &&");
  EXPECT_EQ(
      granvof("run " + shipped("canary-dry") + dense + " --threads 2 --out out", "ulimit -s 1024 &&").code,
      0);
}

TEST_F(Program, StopsAtItsWallClockLimitWithAnExitCodeOfItsOwn) {
  const Outcome stopped =
      granvof("run " + shipped("canary-dry") + " --set grid.dx=0.005 --out out --stop-after 0.0001s");
  EXPECT_EQ(stopped.code, 3);
  EXPECT_NE(stopped.err.find("--resume goes on from t = "), std::string::npos) << stopped.err;
  EXPECT_NE(record().find("\"kind\": \"wall-clock limit\""), std::string::npos) << record();
}

TEST_F(Program, AFileThatMayNotGrowIsAnErrorLikeAFullDisk) {
  const Outcome outcome =
      granvof("run " + shipped("canary-dry") + dense + " --out out", "ulimit -f 36 &&");  // of 512 bytes
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_NE(outcome.err.find("File too large"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("there is no checkpoint to go on from"), std::string::npos) << outcome.err;
  EXPECT_NE(record().find("\"state\": \"failed\""), std::string::npos) << record();
  EXPECT_NE(record().find("File too large"), std::string::npos) << record();
}

TEST_F(Program, ReplacesAnotherCasesRunOnlyIfForced) {
  ASSERT_EQ(granvof("run " + shipped("canary-dry") + dense + " --out out").code, 0);
  const std::string other = "run " + shipped("canary-dry") + dense + " --set solid.friction=0.3 --out out";
  const Outcome refused = granvof(other);
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("solid.friction was 0.4, is 0.3"), std::string::npos) << refused.err;
  EXPECT_EQ(granvof(other + " --resume").code, 2);
  EXPECT_EQ(granvof(other + " --resume --force").code, 2);
  EXPECT_EQ(granvof(other + " --force").code, 0);
}

// A shorter run of the same case has less to say than the one that it would remove.
TEST_F(Program, ReplacesARunThatCameFurtherOnlyIfForced) {
  const std::string whole = "run " + shipped("canary-dry") + dense + " --out out",
                    shorter = whole + " --set time.end=0.02";
  ASSERT_EQ(granvof(whole).code, 0);
  const std::string before = record();
  const Outcome refused = granvof(shorter);
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("it is a run that came to t = "), std::string::npos) << refused.err;
  EXPECT_EQ(record(), before);
  EXPECT_EQ(granvof(whole).code, 0);  // the same again
  EXPECT_EQ(granvof(shorter + " --force").code, 0);
}

// The maker of the report is compare/show, in the tree as it is installed.
TEST_F(Program, HandsRunsOverToTheReport) {
  ASSERT_EQ(granvof("run " + shipped("canary-dry") + dense + " --out out").code, 0);
  const Outcome outcome = granvof("report out");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("report.html"), std::string::npos) << outcome.out;
  EXPECT_EQ(granvof("report nothing-here").code, 2);
}

TEST_F(Program, EndsWithOneLineAndKeepsALog) {
  const Outcome outcome = granvof("run " + shipped("canary-dry") + dense + " --out out");
  const std::size_t at = outcome.err.find("canary-dry: finished, t = ");
  ASSERT_NE(at, std::string::npos) << outcome.err;
  EXPECT_TRUE(outcome.err.ends_with("next: granvof report out\n")) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin() + static_cast<std::ptrdiff_t>(at), outcome.err.end(), '\n'), 1);
  EXPECT_NE(log().find("canary-dry: finished"), std::string::npos);
}

}  // namespace
