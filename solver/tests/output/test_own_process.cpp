#include <csignal>
#include <fstream>
#include <stdexcept>

#include <gtest/gtest.h>

#include "solver/output/own_process.hpp"
#include "solver/tests/temporary_directory.hpp"

using namespace granvof;

namespace {

TEST(OwnProcess, SaysWhetherTheWorkWasDone) {
  const test::TemporaryDirectory directory;
  EXPECT_TRUE(succeeds_in_own_process(directory.path(), [] { std::ofstream("file") << "done"; }));
  std::string word;
  std::ifstream(directory.path() / "file") >> word;
  EXPECT_EQ(word, "done");
  EXPECT_FALSE(succeeds_in_own_process(directory.path(), [] { throw std::runtime_error("no"); }));
  EXPECT_FALSE(succeeds_in_own_process(directory.path() / "none", [] {}));
}

TEST(OwnProcess, ACrashIsNoneOfThisProcess) {
  EXPECT_FALSE(succeeds_in_own_process(".", [] { std::raise(SIGKILL); }));
  std::signal(SIGSEGV, SIG_DFL);
  EXPECT_FALSE(succeeds_in_own_process(".", [] { std::raise(SIGSEGV); }));
}

}  // namespace
