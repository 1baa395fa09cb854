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
  Outcome granvof(const std::string& arguments) const {
    const std::string command = "cd '" + directory_.string() + "' && '" GRANVOF_PROGRAM "' " + arguments +
                                " >stdout.txt 2>stderr.txt </dev/null";
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
  for (const char* word : {"run", "check", "restate", "keys"})
    EXPECT_NE(help.out.find(word), std::string::npos) << word;
}

TEST_F(Program, ChecksACase) {
  const Outcome outcome = granvof("check " + shipped("s1") + " --set grid.dx=0.005 --set time.end=2");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out.rfind("# s1: 80 x 24 x 1 cells", 0), 0U) << outcome.out;
  EXPECT_NE(outcome.out.find("\nend = 2\n"), std::string::npos);
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

}  // namespace
