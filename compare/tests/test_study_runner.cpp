// Runs of the study by a stand-in for the program: what fails, hangs or leaves nothing behind is a point, not
// an end.
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "compare/study/runner.hpp"
#include "compare/tests/stand_in.hpp"
#include "solver/output/seal.hpp"
#include "solver/tests/cases_directory.hpp"
#include "solver/tests/temporary_directory.hpp"

namespace granvof::compare {
namespace {

namespace fs = std::filesystem;
using namespace std::string_literals;

class StudyRunner : public testing::Test {
 protected:
  // A program that says its version, and for a run does `body`, a shell script; $out is the run directory.
  CachedRunner runner(const std::string& body, double timeout = 60.0) {
    const fs::path program = root_ / "program";
    test::write_stand_in(program, body);
    RunnerOptions options{program, root_ / "cache"};
    options.timeout = timeout;
    options.progress = false;
    return CachedRunner(options);
  }
  std::size_t calls() const { return test::calls_beside(root_ / "program").size(); }
  const Job job_{cases_directory() / "canary.toml", {"time.end=2"}};
  const granvof::test::TemporaryDirectory directory_;
  const fs::path& root_ = directory_.path();
};

// What a run that ended early leaves behind.
const std::string half_a_run = "mkdir -p $out; cat > $out/run.json <<'END'\n" +
                               sealed(
                                   "{\n  \"exit\": {\"state\": \"failed\", \"reason\": \"step collapse\"},\n"
                                   "  \"core_seconds\": 3.5,\n  \"simulated_time\": 0.5\n}") +
                               "END\n";

TEST_F(StudyRunner, AFailedRunSaysWhyAndWhatItCost) {
  CachedRunner made = runner(half_a_run + "echo first >&2; echo 'step collapse at t = 0.5 s' >&2; exit 1"s);
  const Outcome failed = made.run(job_);
  EXPECT_FALSE(failed.run);
  EXPECT_FALSE(failed.refused);
  EXPECT_EQ(failed.failure, "step collapse");
  EXPECT_DOUBLE_EQ(failed.core_seconds, 3.5);
  EXPECT_DOUBLE_EQ(failed.cost(), 7.0);
  EXPECT_TRUE(made.has(job_));
  EXPECT_FALSE(made.has({job_.case_file, {"time.end=3"}}));
  const Outcome again = made.run(job_);
  EXPECT_TRUE(again.kept);
  EXPECT_EQ(again.failure, failed.failure);
  EXPECT_DOUBLE_EQ(again.cost(), 7.0);
  EXPECT_EQ(calls(), 1U);
}

TEST_F(StudyRunner, ARunBeyondItsTimeIsEndedAndMadeAgainOnlyForALongerOne) {
  const std::string hangs = half_a_run + "exec sleep 30"s;
  const auto begin = std::chrono::steady_clock::now();
  const Outcome ended = runner(hangs, 0.3).run(job_);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
  EXPECT_FALSE(ended.run);
  EXPECT_EQ(ended.failure, "ended after 0.3 s of wall-clock time");
  EXPECT_DOUBLE_EQ(ended.cost(), 7.0);
  EXPECT_TRUE(runner(hangs, 0.3).run(job_).kept);
  EXPECT_TRUE(runner(hangs, 0.2).run(job_).kept);
  EXPECT_EQ(calls(), 1U);
  EXPECT_FALSE(runner(hangs, 0.4).run(job_).kept);
  EXPECT_EQ(calls(), 2U);
}

// Somebody ended it: no point of a chart, and not kept.
TEST_F(StudyRunner, ARunThatWasStoppedFromOutsideIsNoResult) {
  const std::string told =
      "mkdir -p $out; echo '{\"exit\": {\"state\": \"stopped\", \"kind\": \"signal\"}}' > $out/run.json; ";
  for (const std::string& body : {told + "exit 1", "kill -TERM $$"s}) {
    CachedRunner made = runner(body);
    EXPECT_THROW(made.run(job_), std::runtime_error) << body;
    EXPECT_FALSE(made.has(job_)) << body;
  }
}

// Whoever waits for a run may be killed; the run must not go on, and hold its directory, without it.
TEST_F(StudyRunner, NoRunOutlivesTheStudy) {
  const fs::path number = root_ / "number";
  const pid_t study = fork();
  if (study == 0) {
    runner("echo $$ > " + number.string() + "; exec sleep 60").run(job_);
    _exit(0);
  }
  pid_t run = 0;
  for (int i = 0; i < 500 && run == 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    std::ifstream(number) >> run;
  }
  ASSERT_GT(run, 0);
  kill(study, SIGKILL);
  waitpid(study, nullptr, 0);
  bool ended = false;
  for (int i = 0; i < 500 && !ended; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    std::ifstream state("/proc/" + std::to_string(run) + "/stat");
    std::string id, name, letter;
    ended = !(state >> id >> name >> letter) || letter == "Z";
  }
  EXPECT_TRUE(ended);
  if (!ended) kill(run, SIGKILL);
}

TEST_F(StudyRunner, ARunThatCrashesHasFailed) {
  const Outcome crashed = runner("kill -SEGV $$").run(job_);
  EXPECT_NE(crashed.failure.find("exit code 139"), std::string::npos) << crashed.failure;
}

TEST_F(StudyRunner, ARunThatLeavesNothingHasFailed) {
  const Outcome nothing = runner("exit 0").run(job_);
  EXPECT_FALSE(nothing.run);
  EXPECT_FALSE(nothing.failure.empty());
  EXPECT_EQ(nothing.cost(), 0.0);
}

TEST_F(StudyRunner, ARunThatSaysItFailedHasFailedWhateverItsExitCode) {
  const Outcome failed = runner(half_a_run).run(job_);
  EXPECT_FALSE(failed.run);
  EXPECT_NE(failed.failure.find("step collapse"), std::string::npos) << failed.failure;
}

// Bad input ends the study: the same would be wrong with every run.
TEST_F(StudyRunner, BadInputOfTheProgramIsNoPoint) {
  CachedRunner made = runner("echo 'cannot write there' >&2; exit 2");
  try {
    made.run(job_);
    FAIL() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "cannot write there");
  }
}

TEST_F(StudyRunner, ACaseThatIsRefusedIsNotStarted) {
  const Outcome refused = runner("exit 0").run({job_.case_file, {"numerics.cfl=7"}});
  EXPECT_TRUE(refused.refused);
  EXPECT_NE(refused.failure.find("numerics.cfl"), std::string::npos) << refused.failure;
  EXPECT_EQ(calls(), 0U);
}

TEST_F(StudyRunner, ASecondStudyInTheSameCacheIsToldWhoHasIt) {
  {
    const CachedRunner first = runner("exit 0");
    try {
      runner("exit 0");
      FAIL() << "accepted";
    } catch (const std::runtime_error& error) {
      const std::string said = error.what();
      EXPECT_NE(said.find("is in use: process " + std::to_string(getpid()) + " since "), std::string::npos)
          << said;
      EXPECT_NE(said.find("--cache"), std::string::npos) << said;
    }
  }
  EXPECT_NO_THROW(runner("exit 0"));
}

TEST_F(StudyRunner, LeavesNoLockBehind) {
  const fs::path lock = root_ / "cache/lock";
  {
    const CachedRunner made = runner("exit 0");
    EXPECT_TRUE(fs::exists(lock));
  }
  EXPECT_FALSE(fs::exists(lock));
}

// A study that was killed leaves its own; what somebody else has put there is not written over.
TEST_F(StudyRunner, TakesOverALockOfAStudyAlone) {
  const fs::path lock = root_ / "cache/lock";
  fs::create_directory(root_ / "cache");
  std::ofstream(lock) << "process 1 since 2020-01-01T00:00:00Z: killed";
  EXPECT_NO_THROW(runner("exit 0"));
  std::ofstream(lock) << "of the front door";
  EXPECT_THROW(runner("exit 0"), std::runtime_error);
  std::string kept;
  std::getline(std::ifstream(lock), kept);
  EXPECT_EQ(kept, "of the front door");
}

TEST_F(StudyRunner, AProgramThatIsNoneIsSaidBeforeAnythingIsWritten) {
  fs::create_directory(root_ / "directory");
  std::ofstream(root_ / "garbage") << "none";
  fs::permissions(root_ / "garbage", fs::perms::owner_all);
  for (const char* program : {"missing", "directory", "garbage"}) {
    EXPECT_THROW(CachedRunner({root_ / program, root_ / "cache"}), std::runtime_error) << program;
    EXPECT_FALSE(fs::exists(root_ / "cache")) << program;
  }
}

}  // namespace
}  // namespace granvof::compare
