// What resuming and writing make of a run directory that was damaged, cut, or is not what it seems.
#include <cmath>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "solver/output/digest.hpp"
#include "solver/output/output_error.hpp"
#include "solver/output/run_writer.hpp"
#include "solver/output/seal.hpp"
#include "solver/tests/output/run_directory.hpp"

using namespace granvof;
using namespace granvof::test;

namespace {

TEST_F(RunDirectory, TheDraftOfARunKilledInItsFirstMomentIsInNobodysWay) {
  std::filesystem::create_directories(run);
  std::ofstream(run / "run.json.tmp") << "{\"format\": \"gran";
  EXPECT_FALSE(RunWriter::resume(run, scene, start, monitors).checkpoint);
  write_run(2);
  EXPECT_EQ(row_times().size(), 2U);
  std::filesystem::remove_all(run);
  {  // ended before its first checkpoint: begins anew
    auto killed = fresh();
    write_row(killed, 0.0);
    write_row(killed, 0.1);
  }
  for (const char* name : {"checkpoint.h5.tmp", "series.csv.tmp", "fields.h5.tmp", "run.json.tmp"})
    std::ofstream(run / name) << "torn";
  {
    auto again = RunWriter::resume(run, scene, start, monitors);
    EXPECT_FALSE(again.checkpoint);
    write_row(again.writer, 0.0);
  }
  EXPECT_EQ(row_times().size(), 1U);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(run))
    EXPECT_NE(entry.path().extension(), ".tmp") << entry.path();
}

// Killed between the checkpoint and run.json, which then knows nothing of the last row.
TEST_F(RunDirectory, ARowThatOnlyTheCheckpointKnowsIsHeldToItToo) {
  {
    auto killed = fresh();
    write_row(killed, 0.0);
    killed.write_checkpoint(state(0.0), progress(0.0));
    const std::string earlier = read_file(run / "run.json");
    write_row(killed, 0.1);
    killed.write_checkpoint(state(0.1), progress(0.1));
    write_file_atomically(run / "run.json", earlier);
  }
  scene.times.field_times.clear();
  EXPECT_NO_THROW(resume());
  std::string series = read_file(run / "series.csv");
  const auto last = series.rfind("0.01,");  // dt of the last row
  series.replace(last, 4, "0.02");
  write_file_atomically(run / "series.csv", series);
  const auto why = message_of<OutputError>([&] { resume(); });
  EXPECT_NE(why.find("it was changed since"), std::string::npos) << why;
}

TEST_F(RunDirectory, OnlyItsEndAndLaterOutputMayChangeOnResume) {
  scene.resolved = "[time]\nend = 1\n\n[numerics]\ncfl = 0.4\n\n[output]\nfield_times = [0, 1]\n";
  write_run(5);
  const Scene as_written = scene;
  scene.resolved = "[time]\nend = 1\n\n[numerics]\ncfl = 0.2\n\n[output]\nfield_times = [0, 1]\n";
  const auto text = message_of<OutputError>([&] { resume(); });
  EXPECT_NE(text.find("numerics.cfl was 0.4, is 0.2; only time.end and output"), std::string::npos) << text;
  scene = as_written;
  scene.resolved = "[time]\nend = 2\n\n[numerics]\ncfl = 0.4\n\n[output]\nfield_times = [0, 2]\n";
  start.threads = 3;
  resume().write_progress(progress(0.2));
  const auto kept = record()["resumptions"].back();
  EXPECT_EQ(kept["threads"], 3);
  ASSERT_EQ(kept["changes"].size(), 2U);
  EXPECT_EQ(kept["changes"][0]["key"], "time.end");
  EXPECT_EQ(kept["changes"][0]["was"], "1");
  EXPECT_EQ(kept["changes"][0]["is"], "2");
  EXPECT_EQ(kept["changes"][1]["key"], "output.field_times");
  resume().write_progress(progress(0.2));  // the history is kept
  EXPECT_EQ(record()["resumptions"][0]["changes"].size(), 2U);
  EXPECT_EQ(record()["resumptions"][1]["changes"].size(), 0U);
  scene.times.end = 0.2;
  EXPECT_NE(message_of<OutputError>([&] { resume(); }).find("the case ends at 0.2 s"), std::string::npos);
}

// Rows and instants up to the checkpoint are there, as the case asks for them, or there is no going on.
TEST_F(RunDirectory, ResumeRefusesAHole) {
  const auto refused = [&](const char* what) {
    EXPECT_NE(message_of<OutputError>([&] { resume().write_progress(progress(0.2)); }).find(what),
              std::string::npos)
        << message_of<OutputError>([&] { resume().write_progress(progress(0.2)); });
  };
  write_run(5);
  const std::string text = read_file(run / "series.csv");
  std::vector<std::size_t> ends;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '\n') ends.push_back(i + 1);
  write_file_atomically(run / "series.csv", text.substr(0, ends[2]));  // older than the checkpoint
  refused("row 3 should be of t = 0.2 s");
  write_file_atomically(run / "series.csv", text.substr(0, ends[1]) + text.substr(ends[2]));  // one taken out
  refused("row 2 should be of t = 0.1 s, the case asks for it before the checkpoint, and is of 0.2 s");
  std::filesystem::remove(run / "series.csv");
  refused("series.csv");
  write_file_atomically(run / "series.csv", text);
  scene.times.field_times.insert(scene.times.field_times.begin() + 1, 0.05);
  refused("instant 2 should be of t = 0.05 s");
  scene.times.field_times = {0.0, 0.2};
  refused("instant 2 should be of t = 0.2 s, the case asks for it before the checkpoint, and is of 0.1 s");
  scene.times.field_times = {0.0, 0.1, 0.2, 0.25};  // later ones may be other ones
  resume().write_progress(progress(0.2));
  EXPECT_EQ(read_field_times(run / "fields.h5").size(), 3U);
  std::filesystem::remove(run / "fields/t0001.h5");
  EXPECT_THROW(resume().write_progress(progress(0.2)), OutputError);
  std::filesystem::remove(run / "checkpoint.h5");
  refused("checkpoint.h5 has gone");
}

TEST_F(RunDirectory, WhatIsTakenAwayWhileItRunsIsNoticed) {
  const auto begun = [&] {
    std::filesystem::remove_all(run);
    auto writer = fresh();
    for (int r = 0; r < 3; ++r) {
      write_row(writer, 0.1 * r);
      writer.write_fields(numbered_fields(scene, 0.1 * r));
    }
    return writer;
  };
  const ExitState finished = ExitState::finished;
  {
    auto writer = begun();
    std::filesystem::remove(run / "series.csv");
    EXPECT_THROW(write_row(writer, 0.3), OutputError);
    EXPECT_THROW(writer.write_checkpoint(state(0.3), progress(0.3)), OutputError);
    EXPECT_THROW(writer.finish(progress(0.3), {finished, ""}), OutputError);
  }
  {
    auto writer = begun();
    std::filesystem::resize_file(run / "series.csv", 100);
    EXPECT_THROW(write_row(writer, 0.3), OutputError);
  }
  {
    auto writer = begun();
    const std::string copy = read_file(run / "series.csv");
    std::filesystem::remove(run / "series.csv");
    std::ofstream(run / "series.csv") << copy;
    EXPECT_THROW(write_row(writer, 0.3), OutputError);
  }
  for (const char* gone : {"fields", "fields/t0002.h5", "fields/t0001.h5"}) {
    auto writer = begun();
    std::filesystem::remove_all(run / gone);
    EXPECT_THROW(writer.finish(progress(0.3), {finished, ""}), OutputError) << gone;
    writer.give_up(progress(0.3), "gone");
    EXPECT_EQ(record()["exit"]["state"], "failed");
    EXPECT_EQ(record()["exit"]["reason"], "gone");
  }
}

TEST_F(RunDirectory, RowsThatWereChangedAreNotGoneOnWith) {
  write_run(3);
  std::string text = read_file(run / "series.csv");
  const auto digit = text.find("0.01", text.find('\n'));
  text[digit + 3] = '2';
  std::ofstream(run / "series.csv") << text;
  EXPECT_THROW(resume(), OutputError);
  text[digit + 3] = '1';
  std::ofstream(run / "series.csv") << text << "0.3,0.01";  // a row that a kill has torn
  EXPECT_NO_THROW(resume());
}

// Opening a pipe waits for its other end, and a signal does not end that.
TEST_F(RunDirectory, APipeInThePlaceOfAFileIsRefused) {
  write_run(3);
  std::filesystem::remove(run / "series.csv");
  ASSERT_EQ(::mkfifo((run / "series.csv").c_str(), 0600), 0);
  EXPECT_NE(message_of<OutputError>([&] { resume(); }).find("it is a device or a pipe"), std::string::npos);
  EXPECT_THROW(digest_of_file(run / "series.csv"), OutputError);
  EXPECT_THROW(read_series(run / "series.csv"), OutputError);
  EXPECT_THROW(read_file("/dev/zero"), OutputError);
  write_run(2);  // a run anew takes it away
  EXPECT_EQ(row_times().size(), 2U);
}

// Drafts are written beside what they replace: never into what somebody has put there.
TEST_F(RunDirectory, ALinkInThePlaceOfADraftIsNotFollowed) {
  write_run(3);
  const auto mine = directory.path() / "mine.txt";
  std::ofstream(mine) << "mine";
  for (const char* name : {"run.json.tmp", "series.csv.tmp", "fields.h5.tmp", "checkpoint.h5.tmp"})
    std::filesystem::create_symlink(mine, run / name);
  write_run(3);
  EXPECT_EQ(read_file(mine), "mine");
  EXPECT_EQ(row_times().size(), 3U);
}

TEST_F(RunDirectory, AnotherVersionDoesNotGoOnWithIt) {
  write_run(3);
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(read_file(run / "run.json"));
  json.erase("sha256");
  json["version"] = "0.0.1";
  write_file_atomically(run / "run.json", sealed(json.dump(2)));
  EXPECT_NE(message_of<OutputError>([&] { resume(); }).find("begun by version 0.0.1"), std::string::npos);
  EXPECT_NO_THROW(fresh());
}

TEST_F(RunDirectory, ARecordInWhichADigitWasChangedIsRefused) {
  write_run(3);
  std::string text = read_file(run / "run.json");
  text.replace(text.find("\"steps\": 50"), 11, "\"steps\": 51");
  write_file_atomically(run / "run.json", text);
  EXPECT_NE(message_of<OutputError>([&] { resume(); }).find("run.json: it is not what was written"),
            std::string::npos);
  EXPECT_THROW(fresh(), OutputError);
}

TEST_F(RunDirectory, AWarningOfWhatIsNoNumberIsOfARunToo) {
  auto writer = fresh();
  RunProgress broken = progress(1.0);
  broken.warnings = {{"energy residual", 0.5, std::nan(""), 0.01, "not a number"}};
  writer.finish(broken, {ExitState::failed, "not finite", ExitKind::not_finite});
  const auto existing = read_existing_run(run / "run.json");
  ASSERT_TRUE(existing);
  EXPECT_TRUE(std::isnan(existing->warnings.at(0).value));
}

// A copy of the process that wrote on, and crashed.
TEST_F(RunDirectory, TheEndOfACopyIsNotedUnlessItHasSaidItsOwn) {
  auto writer = fresh();
  writer.write_progress(progress(0.0));
  writer.note_end_of_copy("it crashed");
  EXPECT_EQ(record()["exit"]["state"], "failed");
  EXPECT_EQ(record()["exit"]["reason"], "it crashed");
  EXPECT_EQ(record()["steps"], 50);
  EXPECT_TRUE(read_existing_run(run / "run.json"));  // the seal is whole
  writer.finish(progress(1.0), {ExitState::finished, ""});
  writer.note_end_of_copy("too late");
  EXPECT_EQ(record()["exit"]["state"], "finished");
}

}  // namespace
