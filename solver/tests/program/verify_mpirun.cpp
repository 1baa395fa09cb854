// The program under mpirun, from outside: what several processes write, go on from, refuse and survive.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include "solver/tests/cases_directory.hpp"
#include "solver/tests/temporary_directory.hpp"

namespace {

class Mpirun : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::string(GRANVOF_MPIRUN).empty()) GTEST_SKIP() << "built without MPI";
  }

  struct Outcome {
    int code = -1;
    std::string said;  // stderr
  };
  Outcome shell(const std::string& command) const {
    const std::string all =
        "cd '" + directory_.string() + "' && ( " + command + " ) >/dev/null 2>stderr.txt </dev/null";
    const int status = std::system(all.c_str());
    Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, text("stderr.txt")};
    std::filesystem::remove(directory_ / "stderr.txt");
    return outcome;
  }
  static std::string mpirun() {
    return "'" GRANVOF_MPIRUN "' --oversubscribe --allow-run-as-root --bind-to none ";
  }
  Outcome granvof(int processes, const std::string& arguments) const {
    const std::string program = "'" GRANVOF_PROGRAM "' " + arguments;
    return shell(processes == 1 ? program : mpirun() + "-np " + std::to_string(processes) + " " + program);
  }

  // The column that collapses in water, behind its gate, so far that grains cross the cuts of the tank.
  static std::string column(double end, const std::string& more) {
    std::ostringstream arguments;
    arguments << "run " << shipped("canary")
              << " --set output.series_interval=0.02 --set output.field_times=[0]"
              << " --set time.end=" << end << ' ' << more;
    return arguments.str();
  }
  static std::string shipped(const std::string& name) {
    return "'" + granvof::cases_directory().string() + "/" + name + ".toml'";
  }

  std::string text(const std::string& name) const {
    std::ifstream in(directory_ / name);
    std::ostringstream content;
    content << in.rdbuf();
    return content.str();
  }
  // Columns of series.csv by name; empty cells are not a number.
  std::vector<std::vector<double>> rows(const std::string& run) const {
    std::istringstream in(text(run + "/series.csv"));
    std::vector<std::vector<double>> all;
    for (std::string line; std::getline(in, line);) {
      if (line.empty() || line[0] == '#') continue;
      std::istringstream cells(line);
      std::vector<double> row;
      for (std::string cell; std::getline(cells, cell, ',');) {
        char* end = nullptr;
        const double value = std::strtod(cell.c_str(), &end);
        row.push_back(cell.empty() || *end != '\0' ? std::nan("") : value);
      }
      all.push_back(row);
    }
    return all;
  }
  void expect_alike(const std::string& one, const std::string& many) const {
    const auto a = rows(one), b = rows(many);
    ASSERT_GT(a.size(), 4U);
    ASSERT_EQ(a.size(), b.size());
    std::size_t compared = 0;
    for (std::size_t i = 1; i < a.size(); ++i) {  // the first names the columns
      ASSERT_EQ(a[i].size(), b[i].size());
      for (std::size_t c = 0; c < a[i].size(); ++c) {
        if (counts_of_solvers <= c && c < after_counts) continue;
        ASSERT_EQ(std::isnan(a[i][c]), std::isnan(b[i][c]));
        if (std::isnan(a[i][c])) continue;
        ++compared;
        EXPECT_NEAR(b[i][c], a[i][c], 1e-5 * std::fabs(a[i][c]) + 1e-8) << "row " << i << ", column " << c;
      }
    }
    EXPECT_GT(compared, 100U);
  }
  int times_said(const std::string& what, const std::string& where) const {
    int times = 0;
    for (std::size_t at = where.find(what); at != std::string::npos; at = where.find(what, at + 1)) ++times;
    return times;
  }
  void expect_refused(const Outcome& outcome, const std::string& why) const {
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(times_said(why, outcome.said), 1) << outcome.said;
    EXPECT_TRUE(std::filesystem::is_empty(directory_));
  }

  granvof::test::TemporaryDirectory temporary_;
  const std::filesystem::path& directory_ = temporary_.path();

 private:
  static constexpr std::size_t counts_of_solvers = 2, after_counts = 7;  // iterations, errors of rounding
};

TEST_F(Mpirun, WritesTheRunOfOneProcess) {
  ASSERT_EQ(granvof(1, column(0.3, "--out one")).code, 0);
  for (const int processes : {2, 3}) {
    const std::string out = "with_" + std::to_string(processes);
    const Outcome outcome = granvof(processes, column(0.3, "--out " + out));
    ASSERT_EQ(outcome.code, 0) << outcome.said;
    EXPECT_EQ(times_said("finished", outcome.said), 1) << outcome.said;
    EXPECT_EQ(times_said("messages", outcome.said), 1) << outcome.said;
    EXPECT_NE(text(out + "/run.json").find("\"ranks\": " + std::to_string(processes)), std::string::npos);
    expect_alike("one", out);
  }
}

// Obstacles across the cut; an inlet that the first process has alone, and an outlet that the last has.
TEST_F(Mpirun, WritesTheRunOfOneProcessWithObstaclesAndFlowThrough) {
  for (const auto& [name, end] : {std::pair{"step", "0.1"}, std::pair{"channel", "0.4"}}) {
    const std::string run = "run " + shipped(name) + " --set time.end=" + end +
                            " --set output.series_interval=0.02 --set output.field_times=[0] --out " + name;
    ASSERT_EQ(granvof(1, run + "_1").code, 0);
    const Outcome outcome = granvof(2, run + "_2");
    ASSERT_EQ(outcome.code, 0) << outcome.said;
    expect_alike(std::string(name) + "_1", std::string(name) + "_2");
  }
}

TEST_F(Mpirun, GoesOnFromTheCheckpointOfAnyNumberOfProcesses) {
  ASSERT_EQ(granvof(1, column(0.24, "--out whole")).code, 0);
  ASSERT_EQ(granvof(1, column(0.06, "--out parts")).code, 0);
  ASSERT_EQ(granvof(3, column(0.12, "--out parts --resume")).code, 0);
  ASSERT_EQ(granvof(2, column(0.18, "--out parts --resume")).code, 0);
  ASSERT_EQ(granvof(1, column(0.24, "--out parts --resume")).code, 0);
  expect_alike("whole", "parts");
}

TEST_F(Mpirun, RefusesWhatItCannotCut) {
  expect_refused(granvof(3, "run " + shipped("canary") + " --set grid.dx=0.01"),
                 "allowed: at most 2 processes");
  expect_refused(granvof(2, "check " + shipped("canary")), "check: got 2 processes, allowed: one");
  expect_refused(granvof(2, "run nowhere.toml"), "nowhere.toml");
}

TEST_F(Mpirun, RefusesProcessesThatReadDifferentCases) {
  const std::string run = "-np 1 '" GRANVOF_PROGRAM "' run ", other = " --set solid.friction=0.3";
  expect_refused(shell(mpirun() + run + shipped("canary") + " : " + run + shipped("canary") + other),
                 "the processes read different cases");
  expect_refused(shell(mpirun() + run + shipped("canary") + " : " + run + "nowhere.toml"),
                 "another process cannot read the case");
}

TEST_F(Mpirun, EndsWithOneOfItsProcessesAndGoesOnFromItsCheckpoint) {
  const std::string run =
      "'" GRANVOF_PROGRAM "' " + column(500.0, "--out killed --set output.checkpoint_interval=0.2");
  const std::string doomed =
      "sh -c \"if [ \\$OMPI_COMM_WORLD_RANK = 1 ]; then "
      "(while [ ! -e killed/checkpoint.h5 ]; do sleep 0.1; done; kill -9 \\$\\$) & fi; exec " +
      run + "\"";
  const Outcome outcome = shell("timeout 60 " + mpirun() + "-np 2 " + doomed);
  EXPECT_NE(outcome.code, 0);
  EXPECT_NE(outcome.code, 124) << "still there after a minute";
  const Outcome resumed =
      granvof(2, column(500.0, "--out killed --resume --stop-after 1s --set output.checkpoint_interval=0.2"));
  EXPECT_EQ(resumed.code, 3) << resumed.said;
}

// A scheduler's warning, or the limit of its CPU time, may reach any of them, and alone.
TEST_F(Mpirun, EndsWithACheckpointAtASignalToOneOfItsProcesses) {
  for (const std::string signal : {"USR1", "XCPU"}) {
    const std::string out = "told_" + signal;
    const std::string told = "sh -c \"if [ \\$OMPI_COMM_WORLD_RANK = 1 ]; then (while [ ! -e " + out +
                             "/checkpoint.h5 ]; do sleep 0.1; done; kill -" + signal +
                             " \\$\\$) & fi; exec '" GRANVOF_PROGRAM "' " +
                             column(500.0, "--out " + out + " --set output.checkpoint_interval=0.2") + "\"";
    const Outcome outcome = shell("timeout 120 " + mpirun() + "-np 2 " + told);
    EXPECT_EQ(outcome.code, 1) << outcome.said;
    EXPECT_NE(outcome.said.find("stopped by a signal (SIG" + signal + ")"), std::string::npos)
        << outcome.said;
    EXPECT_NE(text(out + "/run.json").find("\"state\": \"stopped\""), std::string::npos);
  }
}

}  // namespace
