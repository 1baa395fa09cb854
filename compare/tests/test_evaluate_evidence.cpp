// Runs and records that are damaged, cut, or of another time: which row says so, and that the others are
// judged.
#include <algorithm>
#include <string>

#include "compare/input/bands.hpp"
#include "compare/input/records.hpp"
#include "compare/output/write.hpp"
#include "compare/tests/evaluated_rows.hpp"
#include "solver/output/atomic_file.hpp"
#include "solver/output/output_error.hpp"
#include "solver/tests/cases_directory.hpp"

namespace granvof::compare {
namespace {

TEST_F(Evaluate, OneDamagedSeedIsAnErrorOfTheRow) {
  write_run("s1", series(0.1));
  write_record("seed1", 0.1, scene_.reference_hash);
  write_record("seed2", 0.1, scene_.reference_hash);
  const fs::path cut = paths_.records / "s1" / "seed2" / "series.csv";
  fs::resize_file(cut, fs::file_size(cut) / 2);
  const Evaluation evaluation = evaluate_row(record_row);
  EXPECT_EQ(evaluation.results[0].judgement.verdict, Verdict::error);
  EXPECT_NE(evaluation.results[0].note.find("seed2"), std::string::npos) << evaluation.results[0].note;
  ASSERT_EQ(evaluation.results.size(), 2u);
  EXPECT_EQ(evaluation.unexpected(), 2);  // the row, and the record by its name
  EXPECT_EQ(evaluation.results[1].check.id, "evidence." + cut.parent_path().string());
}

// Nor is a seed left out of the mean that has lost its record, or whose record leads nowhere.
TEST_F(Evaluate, ASeedThatHasLostItsRecordIsAnErrorOfTheRow) {
  write_record("seed1", 0.1, scene_.reference_hash);
  write_record("seed2", 0.1, scene_.reference_hash);
  const auto record = paths_.records / "s1/seed2/record.json";
  std::filesystem::remove(record);
  EXPECT_EQ(load_records(paths_.records, "s1", scene_).at(1).state, RunState::refused);
  std::filesystem::create_symlink("nothing", record);
  EXPECT_EQ(load_records(paths_.records, "s1", scene_).at(1).state, RunState::refused);
}

TEST_F(Evaluate, BandsThatLeadNowhereAreAnError) {
  std::filesystem::create_directories(paths_.records);
  EXPECT_TRUE(read_bands(paths_.records).empty());
  std::filesystem::create_symlink("nothing", paths_.records / "bands.json");
  EXPECT_THROW(read_bands(paths_.records), OutputError);
}

// A run of another length is compared over what both cover.
TEST_F(Evaluate, ARecordMayBeLongerOrShorterThanTheRun) {
  write_record("seed1", 0.1, scene_.reference_hash);
  for (const char* end : {"5", "20"}) {
    const std::vector<std::string> set{std::string("time.end=") + end};
    Scene other = load_scene(cases_directory() / "s1.toml", set);
    other.reference_hash = scene_.reference_hash;  // whatever the hash knows of the end
    EXPECT_TRUE(load_records(paths_.records, "s1", other).at(0).run) << end;
  }
}

TEST_F(Evaluate, ARecordThatEndsBeforeItsTimeIsAnError) {
  const std::string text = series(0.1);
  const std::string cut = text.substr(0, text.find("\n", text.size() / 2) + 1);
  const nlohmann::json json{{"scene", "s1"},
                            {"case_hash", scene_.reference_hash},
                            {"simulated_time", scene_.times.end},
                            {"files", test::files_stated(cut)}};
  write(paths_.records / "s1" / "seed1" / "record.json", json.dump());
  write(paths_.records / "s1" / "seed1" / "series.csv", cut);
  const LoadedRun loaded = load_records(paths_.records, "s1", scene_).at(0);
  EXPECT_EQ(loaded.state, RunState::refused);
  EXPECT_NE(loaded.reason.find("it ends at"), std::string::npos) << loaded.reason;
}

TEST_F(Evaluate, ADamagedRunIsAnErrorAndTheOthersAreJudged) {
  write_run("s1", series(0.1));
  write_run("other", series(0.1));
  const fs::path cut = paths_.runs / "other" / "series.csv";
  fs::resize_file(cut, fs::file_size(cut) - 1);  // the last row has no end
  const std::string check = "[[check]]\nrun = [\"s1\", \"other\"]\nfrequency = \"verify\"\n" + volume_row;
  const Evaluation evaluation =
      evaluate(parse_table("[[run]]\nid = \"s1\"\n[[run]]\nid = \"other\"\ncase = \"s1\"\n" + check, "t"),
               Frequency::verify, paths_);
  EXPECT_EQ(evaluation.results[0].judgement.verdict, Verdict::agrees);
  EXPECT_EQ(evaluation.results[1].judgement.verdict, Verdict::error);
  EXPECT_EQ(evaluation.unexpected(), 1);
  EXPECT_NE(evaluation.runs[1].reason.find("it has 200 whole rows, written were 201"), std::string::npos)
      << evaluation.runs[1].reason;
}

// Also where the row is only reported.
TEST_F(Evaluate, ADamagedRunIsRedWhereNothingIsAsserted) {
  write_run("s1", series(0.1));
  write(paths_.runs / "s1" / "series.csv", "");
  EXPECT_EQ(evaluate_row("asserted = false\n" + volume_row).unexpected(), 1);
}

TEST_F(Evaluate, ARunOfAnEarlierVersionIsAnError) {
  write_run("s1", series(0.1));
  auto json = nlohmann::json::parse(read_file(paths_.runs / "s1" / "run.json"));
  json.erase("files");
  write(paths_.runs / "s1" / "run.json", sealed(json.dump(2)));
  const Evaluation evaluation = evaluate_row(volume_row);
  EXPECT_EQ(evaluation.results[0].judgement.verdict, Verdict::error);
  EXPECT_NE(evaluation.runs[0].reason.find("made by an earlier version"), std::string::npos);
}

// What a damaged file holds is quoted, and need not be text: the other verdicts must still be written.
TEST_F(Evaluate, ABrokenByteInAHeaderLeavesAResultThatCanBeWritten) {
  write_run("s1", series(0.1));
  std::string text = series(0.1);
  text[text.find('[')] = '\xae';
  write(paths_.runs / "s1" / "series.csv", text);
  const Evaluation evaluation = evaluate_row(volume_row);
  EXPECT_EQ(evaluation.results[0].judgement.verdict, Verdict::error);
  EXPECT_NO_THROW(results_json(evaluation, Frequency::verify, "2026-01-01T00:00:00Z"));
}

// Any byte of it, the digest too: what it reports is what the verdict rests on.
TEST_F(Evaluate, ARunJsonInWhichADigitWasChangedIsAnError) {
  write_run("s1", series(0.1));
  const std::string file = paths_.runs / "s1" / "run.json", whole = read_file(file);
  EXPECT_EQ(evaluate_row(volume_row).results[0].judgement.verdict, Verdict::agrees);
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = whole;
    text.replace(text.find(from), from.size(), to);
    return text;
  };
  std::string no_seal = nlohmann::json::parse(whole).dump(2);
  for (const std::string& text : {changed("1e-15", "2e-15"), changed("2.5", "2.6"),
                                  changed("\n  \"sha256\": \"", "\n  \"sha256\": \"0"),
                                  changed("\n  \"sha256\"", "\n  \"sha255\""), whole + " ", no_seal}) {
    write(file, text);
    const Evaluation evaluation = evaluate_row(volume_row);
    EXPECT_EQ(evaluation.results[0].judgement.verdict, Verdict::error) << text;
    EXPECT_NE(evaluation.runs[0].reason.find("run.json"), std::string::npos) << evaluation.runs[0].reason;
  }
}

TEST_F(Evaluate, ValuesOfTheWrongKindInRunJsonAreAnError) {
  for (const char* change :
       {R"({"grid": {"cells": 3}})", R"({"files": []})", R"({"files": {"series.csv": {"rows": "x"}}})"}) {
    write_run("s1", series(0.1));
    auto json = nlohmann::json::parse(read_file(paths_.runs / "s1" / "run.json"));
    json.update(nlohmann::json::parse(change));
    write(paths_.runs / "s1" / "run.json", sealed(json.dump(2)));
    EXPECT_EQ(evaluate_row(volume_row).results[0].judgement.verdict, Verdict::error) << change;
  }
}

}  // namespace
}  // namespace granvof::compare
