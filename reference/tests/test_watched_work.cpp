// Work that a library ends from within.
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <mpi.h>
#include <unistd.h>

#include "reference/demvof/beads/bead_log.hpp"
#include "reference/demvof/beads/mpi_session.hpp"
#include "reference/demvof/program/watched_work.hpp"
#include "solver/output/stop_signals.hpp"
#include "solver/scene/case_error.hpp"
#include "solver/tests/temporary_directory.hpp"

using demvof::work_in_own_process;
using demvof::WorkEnd;

TEST(WatchedWork, ReturnsWhatTheWorkReturns) {
  EXPECT_EQ(work_in_own_process([] { return 0; }).code, 0);
  EXPECT_EQ(work_in_own_process([] { return 7; }).code, 7);
}

TEST(WatchedWork, AnExceptionIsSaidAndHasItsExitCode) {
  EXPECT_EQ(work_in_own_process([]() -> int { throw std::runtime_error("no"); }).code, 1);
  EXPECT_EQ(work_in_own_process([]() -> int { throw granvof::CaseError("no"); }).code, 2);
}

// As LIGGGHTS and OpenFOAM do.
TEST(WatchedWork, AnEndFromWithinIsNoReturn) {
  const WorkEnd left = work_in_own_process([]() -> int { std::exit(0); });
  EXPECT_FALSE(left.code);
  EXPECT_EQ(left.how, "exit code 0");
  EXPECT_EQ(work_in_own_process([]() -> int { std::exit(3); }).how, "exit code 3");
  EXPECT_EQ(work_in_own_process([]() -> int { std::abort(); }).how, "signal 6 (Aborted)");
  EXPECT_EQ(work_in_own_process([] { return ::kill(::getpid(), SIGKILL); }).how, "signal 9 (Killed)");
  const WorkEnd aborted = work_in_own_process([] {
    const demvof::MpiSession session;
    return MPI_Abort(MPI_COMM_WORLD, 4);
  });
  EXPECT_FALSE(aborted.code);
  EXPECT_NE(aborted.how, "exit code 0");
}

// A daemon of MPI would outlive what is killed, and hold what it had open.
TEST(WatchedWork, MpiStartsNoOtherProcess) {
  const WorkEnd done = work_in_own_process([] {
    const demvof::MpiSession session;
    std::ifstream children("/proc/self/task/" + std::to_string(::getpid()) + "/children");
    return static_cast<int>(std::distance(std::istream_iterator<int>(children), {}));
  });
  EXPECT_EQ(done.code, 0);
}

TEST(WatchedWork, ASignalToTheOneThatWaitsReachesTheWork) {
  granvof::listen_to_stop_signals();
  std::thread sender([] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    ::kill(::getpid(), SIGTERM);
  });
  const WorkEnd done = work_in_own_process([] {
    while (granvof::stop_signal() == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return granvof::stop_signal();
  });
  sender.join();
  EXPECT_EQ(done.code, SIGTERM);
}

TEST(WatchedWork, TheReasonIsWhatLiggghtsSays) {
  const granvof::test::TemporaryDirectory directory;
  const auto log = demvof::bead_log(directory.path(), 12);
  std::ofstream(log) << "run 0\nERROR: first\nERROR: Illegal run\x1b command (a.cpp:1)\nsorry\n";
  const WorkEnd end{std::nullopt, "exit code 1", 12};
  EXPECT_EQ(reason_of(end, directory.path()),
            "LIGGGHTS ended the program with exit code 1: ERROR: Illegal run\\u001B command (a.cpp:1)");
  EXPECT_FALSE(std::filesystem::exists(log));
  EXPECT_EQ(reason_of(end, directory.path()), "LIGGGHTS or OpenFOAM ended the program with exit code 1");
}
