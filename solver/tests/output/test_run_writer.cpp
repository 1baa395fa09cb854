#include <csignal>
#include <fstream>
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "solver/output/output_error.hpp"
#include "solver/output/run_writer.hpp"
#include "solver/tests/output/samples.hpp"

using namespace granvof;
using namespace granvof::test;

namespace {

const std::vector<Column> monitors{{"dt", "s", "time step"}};

class RunDirectory : public testing::Test {
 protected:
  RunWriter fresh() const { return RunWriter::fresh(run, scene, start, monitors); }
  RunWriter resume(double time) const { return RunWriter::resume(run, scene, start, monitors, time); }

  void write_row(RunWriter& writer, double time) const {
    const std::vector<Value> dt{0.01};
    writer.write_series_row(time, dt, extract_scalars(empty_fields(scene), scene));
  }

  // A whole short run with rows and instants at 0, 0.1, ... and a checkpoint at 0.2.
  void write_run(int rows) const {
    auto writer = fresh();
    for (int r = 0; r < rows; ++r) {
      const double time = 0.1 * r;
      write_row(writer, time);
      writer.write_fields(numbered_fields(scene, time));
      if (r == 2) writer.write_checkpoint(state(time), progress(time));
    }
    writer.finish(progress(0.1 * rows), {ExitState::finished, ""});
  }

  static CheckpointView state(double time) {
    CheckpointView view;
    view.time = time;
    view.scalars["dt"] = time;
    return view;
  }

  static RunProgress progress(double time) {
    RunProgress p;
    p.steps = 50;
    p.cells = 40;
    p.simulated_time = time;
    p.wall_seconds = 4.0;
    p.core_seconds = 8.0;
    p.cost = {{"pressure", 3.0}, {"drag", 1.0}};
    p.solid_volume_error = 1e-13;
    p.liquid_volume_error = std::numeric_limits<double>::quiet_NaN();
    p.solid_fraction_max = 0.61;
    p.monitors = {{"newton_iterations", 3.5}};
    return p;
  }

  nlohmann::json record() const { return nlohmann::json::parse(read_file(run / "run.json")); }
  std::vector<Value> row_times() const { return read_series(run / "series.csv").column("time"); }

  TemporaryDirectory directory;
  std::filesystem::path run = directory.path() / "out" / "sample";
  Scene scene = small_scene();
  RunStart start{"granvof", "granvof run sample.toml", 1, 2};
};

TEST_F(RunDirectory, HoldsWhatTheContractSays) {
  write_run(3);
  const auto json = record();
  for (const char* key :
       {"scene", "version", "git_commit", "case_hash", "resolved_case", "command", "start_date", "cells",
        "steps", "simulated_time", "wall_seconds", "core_seconds", "cell_steps_per_second", "cost",
        "solid_volume_error", "liquid_volume_error", "solid_fraction_max", "exit", "host"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_EQ(json["scene"], "sample");
  EXPECT_EQ(json["title"], scene.title);
  EXPECT_EQ(json["resolved_case"], scene.resolved);
  EXPECT_EQ(json["steps"], 50);
  EXPECT_DOUBLE_EQ(json["cell_steps_per_second"], 500.0);
  EXPECT_EQ(json["cost"]["pressure"], 3.0);
  EXPECT_TRUE(json["liquid_volume_error"].is_null());  // NaN is no number in JSON
  EXPECT_EQ(json["exit"]["state"], "finished");
  EXPECT_GT(json["host"]["cores"], 0);
  EXPECT_FALSE(json["host"]["compiler"].get<std::string>().empty());
  EXPECT_EQ(json["start_date"].get<std::string>().size(), std::string("2000-01-01T00:00:00Z").size());

  const auto series = read_series(run / "series.csv");
  ASSERT_EQ(series.columns.size(), 2 + scalar_table().size());
  EXPECT_EQ(read_file(run / "series.csv").substr(0, 31), "time [s],dt [s],front_dense [m]");
  EXPECT_EQ(series.column("front_dense")[0], std::nullopt);
  EXPECT_EQ(read_field_times(run / "fields.h5").size(), 3U);
  EXPECT_EQ(read_checkpoint(run / "checkpoint.h5", scene).scalar("dt"), 0.2);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(run)) {
    EXPECT_NE(entry.path().extension(), ".tmp") << entry.path();
  }
}

TEST_F(RunDirectory, IsMarkedAsRunningUntilItEnds) {
  auto writer = fresh();
  write_row(writer, 0.0);
  EXPECT_EQ(record()["exit"]["state"], "running");
  writer.write_checkpoint(state(0.1), progress(0.1));
  EXPECT_EQ(record()["exit"]["state"], "running");
  EXPECT_EQ(record()["steps"], 50);
  writer.finish(progress(0.1), {ExitState::failed, "time step below dt_min"});
  EXPECT_EQ(record()["exit"]["state"], "failed");
  EXPECT_EQ(record()["exit"]["reason"], "time step below dt_min");
}

TEST_F(RunDirectory, RefusesADirectoryOfSomethingElse) {
  std::filesystem::create_directories(run);
  std::ofstream(run / "thesis.tex") << "years of work";
  const auto text = message_of<OutputError>([&] { fresh(); });
  EXPECT_NE(text.find(run.string()), std::string::npos) << text;
  std::ofstream(run / "run.json") << R"({"format": "something else"})";
  EXPECT_THROW(fresh(), OutputError);
  EXPECT_EQ(read_file(run / "thesis.tex"), "years of work");
  EXPECT_FALSE(std::filesystem::exists(run / "series.csv"));
}

TEST_F(RunDirectory, RefusesAFileInItsPlace) {
  std::filesystem::create_directories(run.parent_path());
  std::ofstream(run) << "a file";
  EXPECT_THROW(fresh(), OutputError);
  EXPECT_EQ(read_file(run), "a file");
}

TEST_F(RunDirectory, KeepsAnEarlierRunUntilTheNewOneWrites) {
  write_run(4);
  std::ofstream(run / "notes.txt") << "mine";
  {
    auto failed_at_start = fresh();
    EXPECT_EQ(row_times().size(), 4U);
  }
  EXPECT_EQ(row_times().size(), 4U);
  EXPECT_EQ(record()["exit"]["state"], "finished");
  auto writer = fresh();
  write_row(writer, 0.0);
  EXPECT_EQ(row_times().size(), 1U);
  EXPECT_TRUE(read_field_times(run / "fields.h5").empty());
  EXPECT_FALSE(std::filesystem::exists(run / "checkpoint.h5"));
  EXPECT_EQ(read_file(run / "notes.txt"), "mine");
}

TEST_F(RunDirectory, KeepsAnEarlierRunIfTheDiskIsFullAtTheStart) {
  write_run(4);
  {
    const FullDisk full(10);
    auto writer = fresh();
    EXPECT_THROW(write_row(writer, 0.0), OutputError);
  }
  EXPECT_EQ(row_times().size(), 4U);
  EXPECT_EQ(record()["exit"]["state"], "finished");
}

TEST_F(RunDirectory, TakesOneWriterAtATime) {
  const auto first = fresh();
  const auto text = message_of<OutputError>([&] { fresh(); });
  EXPECT_NE(text.find("another run"), std::string::npos) << text;
}

TEST_F(RunDirectory, ResumeCutsWhatIsLaterThanTheCheckpointAndGoesOn) {
  write_run(5);
  const auto start_date = record()["start_date"];
  {
    auto writer = resume(read_checkpoint(run / "checkpoint.h5", scene).time);
    write_row(writer, 0.35);
    EXPECT_EQ(record()["start_date"], start_date);  // untouched yet
    writer.write_fields(numbered_fields(scene, 0.35));
    writer.finish(progress(0.35), {ExitState::stopped, "signal 15"});
  }
  EXPECT_EQ(row_times(), (std::vector<Value>{0.0, 0.1, 0.2, 0.35}));
  EXPECT_EQ(read_field_times(run / "fields.h5"), (std::vector<double>{0.0, 0.1, 0.2, 0.35}));
  EXPECT_EQ(record()["start_date"], start_date);
  ASSERT_EQ(record()["resumptions"].size(), 1U);
  EXPECT_EQ(record()["resumptions"][0]["time"], 0.2);
  { resume(0.2).finish(progress(0.2), {ExitState::finished, ""}); }
  EXPECT_EQ(record()["resumptions"].size(), 2U);
}

TEST_F(RunDirectory, ResumeRefusesWhatIsNotItsRun) {
  EXPECT_THROW(resume(0.0), OutputError);
  write_run(3);
  const auto before = read_file(run / "series.csv");
  start.program = "demvof";
  EXPECT_NE(message_of<OutputError>([&] { resume(0.0); }).find("granvof"), std::string::npos);
  start.program = "granvof";
  scene.hash = "fedcba9876543210";
  EXPECT_NE(message_of<OutputError>([&] { resume(0.0); }).find("fedcba9876543210"), std::string::npos);
  EXPECT_EQ(read_file(run / "series.csv"), before);
}

TEST_F(RunDirectory, AKilledRunIsReadable) {
  const auto fields = numbered_fields(scene, 0.0);
  for (int attempt = 0; attempt < 12; ++attempt) {
    // Even attempts start a run, odd ones replace the one before.
    if (attempt % 2 == 0) std::filesystem::remove_all(run);
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      try {
        auto writer = fresh();
        for (int r = 0;; ++r) {
          write_row(writer, r);
          auto now = fields;
          now.time = r;
          writer.write_fields(now);
          writer.write_checkpoint(state(r), progress(r));
        }
      } catch (...) {
        ::_exit(1);
      }
    }
    // Differing times, so that the kill meets differing calls.
    while (!std::filesystem::exists(run / "checkpoint.h5")) ::usleep(1000);
    ::usleep(static_cast<useconds_t>(7300 * attempt + 1100));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status)) << "the writer failed";

    if (!std::filesystem::exists(run / "checkpoint.h5")) continue;  // killed while it replaced the run before
    const double time = read_checkpoint(run / "checkpoint.h5", scene).time;
    EXPECT_EQ(record()["exit"]["state"], "running");
    EXPECT_GE(read_series(run / "series.csv").rows.size(), static_cast<std::size_t>(time) + 1);
    const auto times = read_field_times(run / "fields.h5");
    ASSERT_GE(times.size(), static_cast<std::size_t>(time) + 1);
    for (std::size_t i = 0; i < times.size(); ++i)
      EXPECT_EQ(read_fields(run / "fields.h5", i).phi, fields.phi);

    auto writer = resume(time);
    write_row(writer, time + 1.0);
    auto next = fields;
    next.time = time + 1.0;
    writer.write_fields(next);
    EXPECT_EQ(row_times().size(), static_cast<std::size_t>(time) + 2);
    EXPECT_EQ(read_field_times(run / "fields.h5").size(), static_cast<std::size_t>(time) + 2);
  }
}

}  // namespace
