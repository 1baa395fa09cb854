#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "solver/output/output_error.hpp"
#include "solver/output/run_writer.hpp"
#include "solver/tests/output/run_directory.hpp"

using namespace granvof;
using namespace granvof::test;

namespace {

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
    auto writer = resume();
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
  { resume().finish(progress(0.2), {ExitState::finished, ""}); }
  EXPECT_EQ(record()["resumptions"].size(), 2U);
}

TEST_F(RunDirectory, ResumeRefusesWhatIsNotItsRun) {
  EXPECT_THROW(resume(), OutputError);
  write_run(3);
  const auto before = read_file(run / "series.csv");
  start.program = "demvof";
  EXPECT_NE(message_of<OutputError>([&] { resume(); }).find("granvof"), std::string::npos);
  start.program = "granvof";
  scene.hash = "fedcba9876543210";
  EXPECT_NE(message_of<OutputError>([&] { resume(); }).find("fedcba9876543210"), std::string::npos);
  EXPECT_EQ(read_file(run / "series.csv"), before);
}

TEST_F(RunDirectory, AKilledRunIsReadable) {
  const auto fields = numbered_fields(scene, 0.0);
  scene.times.row_times.clear();
  for (int r = 0; r < 10000; ++r) scene.times.row_times.push_back(r);
  scene.times.field_times = scene.times.row_times;
  scene.times.end = 10000.0;
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

    auto writer = resume();
    write_row(writer, time + 1.0);
    auto next = fields;
    next.time = time + 1.0;
    writer.write_fields(next);
    EXPECT_EQ(row_times().size(), static_cast<std::size_t>(time) + 2);
    EXPECT_EQ(read_field_times(run / "fields.h5").size(), static_cast<std::size_t>(time) + 2);
  }
}

TEST_F(RunDirectory, RefusesTheRunOfAnotherCaseUnlessForced) {
  write_run(3);
  const auto before = read_file(run / "run.json");
  const Scene same = scene;
  scene.resolved = "[scene]\nname = \"sample\"\n\n[numerics]\ncfl = 0.2\n";
  const auto text = message_of<OutputError>([&] { fresh(); });
  EXPECT_NE(text.find("numerics.cfl was not given, is 0.2"), std::string::npos) << text;
  EXPECT_NE(text.find("--force"), std::string::npos) << text;
  scene = same;
  scene.name = "other";
  EXPECT_NE(message_of<OutputError>([&] { fresh(); }).find("scene sample, this is other"), std::string::npos);
  scene = same;
  scene.hash = "fedcba9876543210";
  EXPECT_THROW(fresh(), OutputError);
  start.program = "demvof";
  EXPECT_THROW(fresh(), OutputError);
  EXPECT_EQ(read_file(run / "run.json"), before);
  EXPECT_EQ(row_times().size(), 3U);
  auto writer = RunWriter::fresh(run, scene, start, monitors, true);
  write_row(writer, 0.0);
  EXPECT_EQ(row_times().size(), 1U);
  EXPECT_EQ(record()["program"], "demvof");
}

// What is not ours stays: a folder that happens to be called as the one of our instants.
TEST_F(RunDirectory, LeavesTheUsersOwnFilesInTheFolderOfTheFields) {
  write_run(3);
  std::filesystem::create_directories(run / "fields" / "thesis");
  for (const char* name : {"fields/notes.txt", "fields/t12.h5", "fields/thesis/t0001.h5", "series.csv.bak"})
    std::ofstream(run / name) << "mine";
  write_run(2);
  auto writer = fresh();
  write_row(writer, 0.0);
  for (const char* name : {"fields/notes.txt", "fields/t12.h5", "fields/thesis/t0001.h5", "series.csv.bak"})
    EXPECT_EQ(read_file(run / name), "mine") << name;
  EXPECT_FALSE(std::filesystem::exists(run / "fields/t0000.h5"));
}

TEST_F(RunDirectory, StatesWhatItHolds) {
  write_run(3);
  const auto files = record()["files"];
  EXPECT_EQ(files["series.csv"]["rows"], 3);
  EXPECT_EQ(files["series.csv"]["end"], 0.2);
  EXPECT_EQ(files["series.csv"]["columns"].size(), 2 + scalar_table().size());
  EXPECT_EQ(files["series.csv"]["columns"][1], "dt [s]");
  EXPECT_EQ(files["series.csv"]["sha256"], digest_of_file(run / "series.csv"));
  EXPECT_EQ(files["fields.h5"]["instants"], 3);
  EXPECT_EQ(files["fields.h5"]["sha256"], digest_of_file(run / "fields.h5"));
  EXPECT_EQ(record()["exit"]["resume_from"], 0.2);
  auto writer = resume();
  write_row(writer, 0.3);
  writer.write_progress(progress(0.3));
  EXPECT_EQ(record()["files"]["series.csv"]["rows"], 4);
  EXPECT_EQ(record()["files"]["series.csv"]["sha256"], digest_of_file(run / "series.csv"));
  EXPECT_TRUE(record()["files"]["fields.h5"]["sha256"].is_null());  // links, while it runs
  std::filesystem::remove_all(run);
  fresh().write_progress(progress(0.0));
  EXPECT_TRUE(record()["exit"]["resume_from"].is_null());
  EXPECT_TRUE(record()["files"]["series.csv"]["end"].is_null());
}

// A disk so full that no draft fits leaves the room of the run.json that is there.
TEST_F(RunDirectory, TheEndIsWrittenOverTheOldRecordWhereNoDraftCanBe) {
  auto writer = fresh();
  write_row(writer, 0.0);
  std::filesystem::create_directory(run / "run.json.tmp");
  EXPECT_THROW(writer.write_progress(progress(0.1)), OutputError);
  writer.give_up(progress(0.1), "no space left on device");
  EXPECT_EQ(record()["exit"]["state"], "failed");
  EXPECT_EQ(record()["exit"]["reason"], "no space left on device");
}

// The room that is left ends within the record: half of the new one would be no record at all.
TEST_F(RunDirectory, NoRoomForTheRecordLeavesTheOldOne) {
  auto writer = fresh();
  write_row(writer, 0.0);
  writer.write_progress(progress(0.0));
  const auto before = read_file(run / "run.json");
  const FullDisk full(before.size() + 100);
  writer.give_up(progress(0.1), std::string(1000, 'x'));
  EXPECT_EQ(read_file(run / "run.json"), before);
}

// Who moves a run while it goes on may put another in its place: nothing of that is written over.
TEST_F(RunDirectory, LeavesWhatHasTakenItsPlace) {
  auto writer = fresh();
  write_row(writer, 0.0);
  writer.write_checkpoint(state(0.0), progress(0.0));
  std::filesystem::rename(run, run.string() + ".moved");
  std::filesystem::create_directories(run / "fields");
  std::ofstream(run / "run.json") << "theirs";
  const auto refused = [&](const std::function<void()>& write) {
    const auto text = message_of<OutputError>(write);
    EXPECT_NE(text.find("replaced while the run went on"), std::string::npos) << text;
  };
  refused([&] { write_row(writer, 0.1); });
  refused([&] { writer.write_fields(numbered_fields(scene, 0.1)); });
  refused([&] { writer.write_checkpoint(state(0.1), progress(0.1)); });
  refused([&] { writer.write_progress(progress(0.1)); });
  writer.give_up(progress(0.1), "it was replaced");
  writer.note_end_of_copy("it was replaced");
  EXPECT_EQ(read_file(run / "run.json"), "theirs");
  EXPECT_EQ(std::distance(std::filesystem::recursive_directory_iterator(run), {}), 2);
}

// It may be put there at any moment: what is written goes to what was locked, and errors keep the name given.
TEST_F(RunDirectory, WritesByWhatItHasLocked) {
  auto writer = fresh();
  write_row(writer, 0.0);
  writer.open_beside([&](const std::filesystem::path& locked) {
    std::filesystem::rename(run, run.string() + ".moved");
    std::filesystem::create_directories(run);
    std::ofstream(locked / "run.log") << "ours";
  });
  EXPECT_TRUE(std::filesystem::is_empty(run));
  EXPECT_EQ(read_file(run.string() + ".moved/run.log"), "ours");
  const auto text = message_of<OutputError>([&] {
    writer.open_beside([](const std::filesystem::path& locked) {
      throw OutputError("write", locked / "run.log", (locked / "run.log").string() + " is full");
    });
  });
  EXPECT_EQ(text,
            "cannot write " + (run / "run.log").string() + ": " + (run / "run.log").string() + " is full");
}

TEST_F(RunDirectory, NamesNoCheckpointThatHasGone) {
  auto writer = fresh();
  write_row(writer, 0.0);
  EXPECT_FALSE(writer.checkpoint_time());
  writer.write_checkpoint(state(0.0), progress(0.0));
  EXPECT_EQ(writer.checkpoint_time(), 0.0);
  std::filesystem::remove(run / "checkpoint.h5");
  std::filesystem::create_directory(run / "checkpoint.h5");
  EXPECT_FALSE(writer.checkpoint_time());
}

// Where no draft can be, the record is written over; not what is no record.
TEST_F(RunDirectory, WritesNoEndIntoAPipeOrThroughALink) {
  auto writer = fresh();
  write_row(writer, 0.0);
  std::filesystem::create_directory(run / "run.json.tmp");
  std::filesystem::remove(run / "run.json");
  ASSERT_EQ(::mkfifo((run / "run.json").c_str(), 0600), 0);
  ::alarm(20);  // who opens a pipe waits for its other end
  writer.give_up(progress(0.1), "an end");
  ::alarm(0);
  std::filesystem::remove(run / "run.json");
  std::ofstream(run / "mine.txt") << "mine";
  std::filesystem::create_symlink("mine.txt", run / "run.json");
  writer.give_up(progress(0.1), "an end");
  EXPECT_EQ(read_file(run / "mine.txt"), "mine");
}

TEST_F(RunDirectory, TwoRunsAreEqualToTheByte) {
  write_run(3);
  const auto fields = read_file(run / "fields.h5"), series = read_file(run / "series.csv");
  ::usleep(1100000);  // HDF5 counts whole seconds
  write_run(3);
  EXPECT_EQ(read_file(run / "fields.h5"), fields);
  EXPECT_EQ(read_file(run / "series.csv"), series);
}

TEST(Digest, IsSha256) {
  Digest digest;
  EXPECT_EQ(digest.hex(), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  digest.add("a");
  digest.add("bc");
  EXPECT_EQ(digest.hex(), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(digest.hex(), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

}  // namespace
