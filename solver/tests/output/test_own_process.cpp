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
  const auto file = directory.path() / "file";
  EXPECT_TRUE(succeeds_in_own_process([&] { std::ofstream(file) << "done"; }));
  std::string word;
  std::ifstream(file) >> word;
  EXPECT_EQ(word, "done");
  EXPECT_FALSE(succeeds_in_own_process([] { throw std::runtime_error("no"); }));
}

TEST(OwnProcess, ACrashIsNoneOfThisProcess) {
  EXPECT_FALSE(succeeds_in_own_process([] { std::raise(SIGKILL); }));
  std::signal(SIGSEGV, SIG_DFL);
  EXPECT_FALSE(succeeds_in_own_process([] { std::raise(SIGSEGV); }));
}

}  // namespace
