// The program from outside: exit codes, what goes to which stream, and that bad input writes nothing.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>
#include <sys/wait.h>

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

  void expect_refused(const std::string& arguments, const std::string& part) const {
    const Outcome outcome = granvof(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_TRUE(std::filesystem::is_empty(directory_)) << arguments;
  }

  std::string record() const { return text("out/run.json"); }

  static std::string shipped(const std::string& name) { return "'" GRANVOF_CASES_DIR "/" + name + ".toml'"; }

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
  for (const char* word : {"run", "check", "keys"}) EXPECT_NE(help.out.find(word), std::string::npos) << word;
}

TEST_F(Program, ChecksACase) {
  const Outcome outcome = granvof("check " + shipped("s1") + " --set grid.dx=0.005 --set time.end=2");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out.rfind("# s1: 80 x 24 x 1 cells", 0), 0U) << outcome.out;
  EXPECT_NE(outcome.out.find("\nend = 2\n"), std::string::npos);
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
}

TEST_F(Program, RefusesBadCasesAndWritesNothing) {
  expect_refused("run " + shipped("s1") + " --set solid.friction=-0.4",
                 "--set: solid.friction: got -0.4, allowed: a number >= 0");
  expect_refused("check no-such-case.toml", "no-such-case.toml");
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

TEST_F(Program, AFileThatMayNotGrowIsAnErrorLikeAFullDisk) {
  const Outcome outcome =
      granvof("run " + shipped("canary-dry") + dense + " --out out", "ulimit -f 30 &&");  // of 512 bytes
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

}  // namespace
