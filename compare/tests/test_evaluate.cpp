// Whole rows: run directories and records on disk, to verdicts.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "compare/input/records.hpp"
#include "compare/output/write.hpp"
#include "compare/tests/evaluated_rows.hpp"
#include "solver/output/atomic_file.hpp"
#include "solver/tests/cases_directory.hpp"

namespace granvof::compare {
namespace {

// A toe that is too loose for the dense front from T = 8 on: the run-out goes on by the front it began with.
TEST_F(Evaluate, ARunOutKeepsItsDefinitionToTheEnd) {
  std::string text = "time [s],front_dense [m],front_dilute [m]\n";
  for (const double t : scene_.times.row_times) {
    text += fmt::format("{},{},{}\n", t, 0.1 + 0.1 * std::min(t, 0.4), 0.102 + 0.1 * t);
  }
  write_run("s1", text);
  const auto at = [&](const char* metric, double time) {
    return *evaluate_row(fmt::format("metric = \"{}\"\nat = {}\nreference = {{ kind = \"theory\", value = 0, "
                                     "source = \"x\" }}\ntolerance = {{ absolute = 1, unit = \"-\" }}\n",
                                     metric, time))
                .results[0]
                .value;
  };
  for (const double time : {2.0, 5.0, 7.9, 8.0, 8.1, 10.0}) {
    EXPECT_NEAR(at("run_out", time), run_out_at_5(0.1) * time / 5.0, 1e-4) << time;
    EXPECT_NEAR(at("run_out_dense", time), std::min(run_out_at_5(0.1) * time / 5.0, 0.04 / height_of_s1()),
                1e-4);
  }
}

TEST_F(Evaluate, AUsableRunIsJudged) {
  write_run("s1", series(0.1));
  const Evaluation evaluation = evaluate_row(volume_row);
  ASSERT_EQ(evaluation.results.size(), 1u);
  EXPECT_EQ(evaluation.results[0].judgement.verdict, Verdict::agrees);
  EXPECT_DOUBLE_EQ(*evaluation.results[0].value, 1e-15);
  EXPECT_EQ(evaluation.unexpected(), 0);
}

TEST_F(Evaluate, AMissingRunIsNotRunAndRed) {
  const Evaluation evaluation = evaluate_row(volume_row);
  EXPECT_EQ(evaluation.results[0].judgement.verdict, Verdict::not_run);
  EXPECT_EQ(evaluation.unexpected(), 1);
}

TEST_F(Evaluate, AFailedRunIsNotRunWithItsReason) {
  write_run("s1", series(0.1), "failed");
  const Evaluation evaluation = evaluate_row(volume_row);
  EXPECT_EQ(evaluation.results[0].judgement.verdict, Verdict::not_run);
  EXPECT_EQ(evaluation.unexpected(), 1);
  EXPECT_NE(evaluation.runs[0].reason.find("step collapse"), std::string::npos);
}

TEST_F(Evaluate, ARunOfAnotherStateOfItsCaseIsStale) {
  write_run("s1", series(0.1), "finished", "\n[other]\nchanged = 1\n");
  const Evaluation evaluation = evaluate_row(volume_row);
  EXPECT_EQ(evaluation.results[0].judgement.verdict, Verdict::stale);
  EXPECT_EQ(evaluation.unexpected(), 1);
  EXPECT_NE(evaluation.runs[0].reason.find("'[other]'"), std::string::npos) << evaluation.runs[0].reason;
  EXPECT_NE(terminal_table(evaluation).find("'[other]'"), std::string::npos);
}

TEST_F(Evaluate, TheReferencesSettingsAreNoneOfOurRuns) {
  const std::string resolved = scene_.resolved;
  ASSERT_NE(resolved.find("[reference]"), std::string::npos);
  write_run("s1", series(0.1), "finished", "\n[reference]\nfluid_dt = 123\n");
  EXPECT_EQ(evaluate_row(volume_row).results[0].judgement.verdict, Verdict::agrees);
}

TEST_F(Evaluate, ANaNAnywhereRefusesTheRun) {
  for (const char* bad : {"nan", "inf", "-nan"}) {
    // In a column that the row does not even read.
    write_run("s1", series(0.1, std::string("0.8,") + bad + ",0.2,0.002\n"));
    const Evaluation evaluation = evaluate_row(volume_row);
    EXPECT_EQ(evaluation.results[0].judgement.verdict, Verdict::error) << bad;
    EXPECT_EQ(evaluation.unexpected(), 1) << bad;
    EXPECT_NE(evaluation.runs[0].reason.find("refused"), std::string::npos);
  }
}

TEST_F(Evaluate, AnUndefinedMetricDiffers) {
  write_run("s1", series(0.1));
  const Evaluation evaluation = evaluate_row(
      "metric = \"immersed_share\"\nwindow = [3, 6]\nreference = { kind = \"theory\", formula = "
      "\"density_ratio\" }\n"
      "tolerance = { absolute = 0.01, unit = \"-\" }\n");
  EXPECT_EQ(evaluation.results[0].judgement.verdict, Verdict::differs);
  EXPECT_FALSE(evaluation.results[0].value);
  EXPECT_EQ(evaluation.unexpected(), 1);
}

TEST_F(Evaluate, WithoutARecordTheRowIsNotRunAndRed) {
  write_run("s1", series(0.1));
  const Evaluation evaluation = evaluate_row(record_row);
  EXPECT_EQ(evaluation.results[0].judgement.verdict, Verdict::not_run);
  EXPECT_NEAR(*evaluation.results[0].value, run_out_at_5(0.1), 1e-4);
  EXPECT_EQ(evaluation.unexpected(), 1);
}

// Two fronts at constant speeds: the distance grows linearly, its rms over [0, T] is the last over sqrt(3).
TEST_F(Evaluate, ACurveIsJudgedByItsDistanceFromTheMeanOfTheRecords) {
  write_run("s1", series(0.12));
  write_record("seed1", 0.10, scene_.reference_hash);
  write_record("seed2", 0.11, scene_.reference_hash);
  const Result result = evaluate_row(curve_row).results[0];
  EXPECT_NEAR(*result.value, run_out_at_5(0.12 - 0.105) / std::sqrt(3.0), 1e-4);
  EXPECT_EQ(*result.reference, 0.0);
  EXPECT_NEAR(result.band, 0.5 * run_out_at_5(0.01) / std::sqrt(3.0), 1e-4);
  EXPECT_EQ(result.judgement.verdict, Verdict::differs);
  write_run("s1", series(0.105));
  EXPECT_EQ(evaluate_row(curve_row).results[0].judgement.verdict, Verdict::agrees);
}

TEST_F(Evaluate, ACurveWithoutItsRecordIsNotRunAndRed) {
  write_run("s1", series(0.1));
  const Evaluation none = evaluate_row(curve_row);
  EXPECT_EQ(none.results[0].judgement.verdict, Verdict::not_run);
  EXPECT_EQ(none.unexpected(), 1);
  write_record("seed1", 0.10, "another hash");
  EXPECT_EQ(evaluate_row(curve_row).results[0].judgement.verdict, Verdict::stale);
}

TEST_F(Evaluate, ACurveHasNoOtherReference) {
  EXPECT_THROW(
      evaluate_row("metric = \"run_out_curve\"\nwindow = [0, 5]\nreference = { kind = \"theory\", value = 0, "
                   "source = \"x\" }\ntolerance = { absolute = 0.01, unit = \"-\" }\n"),
      TableError);
}

TEST_F(Evaluate, TheSpreadOfTheRecordsIsTheBand) {
  write_run("s1", series(0.102));
  write_record("seed1", 0.10, scene_.reference_hash);
  write_record("seed2", 0.11, scene_.reference_hash);
  const Evaluation evaluation = evaluate_row(record_row);
  const Result& result = evaluation.results[0];
  EXPECT_NEAR(*result.reference, run_out_at_5(0.105), 1e-4);
  EXPECT_NEAR(result.band, run_out_at_5(0.005), 1e-4);
  EXPECT_EQ(result.judgement.verdict, Verdict::within_band);
}

TEST_F(Evaluate, OneRecordHasNoBand) {
  write_run("s1", series(0.102));
  write_record("seed1", 0.11, scene_.reference_hash);
  const Evaluation evaluation = evaluate_row(record_row);
  EXPECT_DOUBLE_EQ(evaluation.results[0].band, 0.0);
  EXPECT_EQ(evaluation.results[0].judgement.verdict, Verdict::differs);
  EXPECT_EQ(evaluation.unexpected(), 1);
}

TEST_F(Evaluate, OneRecordIsAsUncertainAsTheCanary) {
  write_run("s1", series(0.1));
  write_record("seed1", 0.09, scene_.reference_hash);
  write(paths_.records / "bands.json",
        R"([{"scene": "canary", "against": "seed2", "column": "front_dense [m]", "rms": 0.0049}])");
  const Evaluation evaluation = evaluate_row(record_row);
  EXPECT_NEAR(evaluation.results[0].band, 0.1, 1e-9);  // over h0
  EXPECT_EQ(evaluation.results[0].judgement.verdict, Verdict::within_band);
}

TEST_F(Evaluate, AStaleRecordIsNeverCompared) {
  write_run("s1", series(0.1));
  write_record("seed1", 0.1, "another");
  const Evaluation evaluation = evaluate_row(record_row);
  EXPECT_EQ(evaluation.results[0].judgement.verdict, Verdict::stale);
  EXPECT_FALSE(evaluation.results[0].reference);
  EXPECT_EQ(evaluation.unexpected(), 1);
}

// Whichever run is compared with it: here one of another packing, and no row of the case as it was recorded.
TEST_F(Evaluate, ARecordIsHeldAgainstItsOwnCase) {
  const std::string recorded = scene_.reference_hash;
  const std::vector<std::string> denser{"bed.solid_fraction=0.591"};
  scene_ = load_scene(cases_directory() / "s1.toml", denser);
  ASSERT_NE(scene_.reference_hash, recorded);
  write_run("denser", series(0.1));
  write_record("seed1", 0.1, recorded);
  const Evaluation evaluation =
      evaluate(parse_table("[[run]]\nid = \"denser\"\ncase = \"s1\"\nset = [\"bed.solid_fraction=0.591\"]\n"
                           "[[check]]\nrun = \"denser\"\nfrequency = \"verify\"\n" +
                               record_row,
                           "t"),
               Frequency::verify, paths_);
  EXPECT_EQ(evaluation.results[0].judgement.verdict, Verdict::agrees);
  const auto json =
      nlohmann::json::parse(results_json(evaluation, Frequency::verify, "2026-01-01T00:00:00Z"));
  EXPECT_EQ(json.at("runs").at(0).at("record"), "s1");
}

TEST_F(Evaluate, ResultFilesHoldTheRow) {
  std::string text = series(0.1);
  write_run("s1", text.replace(text.find("front_dense"), 11, "front_quantile"));
  const Evaluation evaluation = evaluate_row(volume_row);
  EXPECT_EQ(results_csv(evaluation),
            "scene,metric,value,unit,reference,reference_kind,reference_source,tolerance,verdict\n"
            "s1,solid_volume_error,1e-15,-,0,theory,x,1e-12 [-],agrees\n");
  const auto json =
      nlohmann::json::parse(results_json(evaluation, Frequency::verify, "2026-01-01T00:00:00Z"));
  EXPECT_EQ(json.at("results").at(0).at("verdict"), "agrees");
  EXPECT_EQ(json.at("runs").at(0).at("numbers").at("core_seconds"), 2.5);
  EXPECT_EQ(json.at("unexpected"), 0);
  const auto curves = nlohmann::json::parse(curves_json(evaluation));
  for (const char* front : {"run_out", "run_out_quantile"})
    EXPECT_EQ(curves.at("runs").at("s1").at("curves").at(front).at("x").size(), 201u) << front;
}

TEST_F(Evaluate, JUnitCountsFailuresAndEscapes) {
  const Evaluation evaluation = evaluate_row(
      "metric = \"solid_volume_error\"\nreference = { kind = \"theory\", value = 0, source = \"a < b & "
      "\\\"c\\\"\" }\n"
      "tolerance = { absolute = 1e-12, unit = \"-\" }\n");
  const std::string xml = junit_xml(evaluation);
  EXPECT_NE(xml.find("tests=\"1\" failures=\"1\" skipped=\"0\""), std::string::npos) << xml;
  EXPECT_NE(xml.find("a &lt; b &amp; &quot;c&quot;"), std::string::npos) << xml;
}

// XML knows no control characters.
TEST_F(Evaluate, JUnitHoldsNoControlCharacter) {
  write_run("s1", series(0.1));
  const Evaluation evaluation = evaluate_row(
      "metric = \"solid_volume_error\"\nreference = { kind = \"theory\", value = 0, source = "
      "\"a\\u0007b\\u001b\" }\n"
      "tolerance = { absolute = 1e-12, unit = \"-\" }\n");
  const std::string xml = junit_xml(evaluation);
  EXPECT_NE(xml.find("a\\x07b\\x1b"), std::string::npos) << xml;
  EXPECT_TRUE(std::none_of(xml.begin(), xml.end(), [](char c) { return c >= 0 && c < 0x20 && c != '\n'; }));
}

// A further curve, under the program's name; left out once its case has changed.
TEST_F(Evaluate, TheRunOfAStockProgramIsAFurtherCurve) {
  write_run("s1", series(0.1));
  const auto peers_with = [&](const std::string& hash) {
    const nlohmann::json json{{"program", "MPPICInterFoam"},
                              {"scene", "s1"},
                              {"case_hash", hash},
                              {"files", test::files_stated(series(0.2))}};
    write(paths_.records / "peers" / "MPPICInterFoam" / "s1" / "record.json", json.dump());
    write(paths_.records / "peers" / "MPPICInterFoam" / "s1" / "series.csv", series(0.2));
    return nlohmann::json::parse(curves_json(evaluate_row(volume_row))).at("peers");
  };
  const auto peers = peers_with(scene_.reference_hash);
  EXPECT_EQ(peers.at("s1").at("MPPICInterFoam").at("curves").at("run_out").at("x").size(), 201u);
  EXPECT_TRUE(peers_with("another").empty());
}

TEST_F(Evaluate, ARecordIsScaledByTheHeightItReallyHad) {
  write_run("s1", series(0.1));
  write_record("seed1", 0.1, scene_.reference_hash);
  const double height = scene_.bed->box.upper[1] - scene_.bed->box.lower[1];
  const nlohmann::json json{{"case_hash", scene_.reference_hash},
                            {"monitors", {{"released_height_m", 0.9 * height}}},
                            {"files", test::files_stated(series(0.1))}};
  write(paths_.records / "s1" / "seed1" / "record.json", json.dump());
  write_record("seed2.part", 5.0, scene_.reference_hash);  // being written: no record yet
  // x / h at T: 5 sqrt(h / g) speed / h scales with 1 / sqrt(h).
  EXPECT_NEAR(*evaluate_row(record_row).results[0].reference, run_out_at_5(0.1) / std::sqrt(0.9), 1e-4);
}

TEST_F(Evaluate, TheCanaryIsRedUnlessItAgreesOrIsLeftOut) {
  EXPECT_TRUE(canary_result({Verdict::differs, "front"}, {}).judgement.unexpected);
  EXPECT_TRUE(canary_result({Verdict::not_run, "demvof is not built"}, {}).judgement.unexpected);
  EXPECT_FALSE(canary_result({Verdict::agrees, "within"}, {}).judgement.unexpected);
  LeftOut left_out;
  left_out.canary = true;
  EXPECT_FALSE(canary_result({Verdict::not_run, ""}, left_out).judgement.unexpected);
}

TEST_F(Evaluate, WhatIsLeftOutByNameIsNamedAndNotRed) {
  write_run("s1", series(0.1));
  const Table table = parse_table(
      "[[run]]\nid = \"s1\"\n[[check]]\nrun = \"s1\"\nfrequency = \"verify\"\n" + record_row, "t");
  LeftOut left_out;
  left_out.records = true;
  const Evaluation evaluation = evaluate(table, Frequency::verify, paths_, left_out);
  EXPECT_EQ(evaluation.results[0].judgement.verdict, Verdict::not_run);
  EXPECT_EQ(evaluation.unexpected(), 0);
  EXPECT_NE(terminal_table(evaluation).find("left out by name: s1.run_out@5.DEM"), std::string::npos);
}

TEST_F(Evaluate, NothingDueIsNoSuccess) {
  const Table weekly = parse_table(
      "[[run]]\nid = \"s1\"\n[[check]]\nrun = \"s1\"\nfrequency = \"weekly\"\n" + volume_row, "t");
  EXPECT_THROW(evaluate(weekly, Frequency::verify, paths_), TableError);
}

// A front 0.01 m ahead of the published one everywhere is 0.01 m away; outside its times there is nothing to
// compare.
TEST_F(Evaluate, AFrontAgainstAPublishedSeries) {
  fs::create_directories(root_ / "cases");
  fs::copy(cases_directory() / "s1.toml", root_ / "cases" / "s1.toml");
  paths_.cases = root_ / "cases";
  write(root_ / "cases" / "published" / "front.tsv", "t [s]\tfront [m]\n0.1\t0.10\n0.5\t0.14\n");
  write_run("s1", series(0.1));
  const auto row = [](const std::string& window) {
    return "metric = \"grain_front_distance\"\npublished = \"front.tsv\"\ncolumn = \"front\"\nwindow = " +
           window +
           "\nreference = { kind = \"published\", value = 0, source = \"x\" }\n"
           "tolerance = { absolute = 0.02, unit = \"m\" }\n";
  };
  const Evaluation inside = evaluate_row(row("[0.1, 0.5]"));
  EXPECT_NEAR(*inside.results[0].value, 0.01, 1e-6);  // the series has six digits
  EXPECT_EQ(inside.results[0].judgement.verdict, Verdict::agrees);
  EXPECT_FALSE(evaluate_row(row("[0.1, 0.6]")).results[0].value);
}

TEST_F(Evaluate, AFrontAtATimeIsHeldAgainstItsRecord) {
  write_run("s1", series(0.1));
  write_record("seed1", 0.2, scene_.reference_hash);
  const auto row = [](const std::string& at) {
    return "metric = \"grain_front\"\nat = " + at +
           "\nreference = { kind = \"DEM\", record = \"s1\" }\n"
           "tolerance = { absolute = 0.01, unit = \"m\" }\n";
  };
  const Evaluation inside = evaluate_row(row("0.35"));
  EXPECT_NEAR(*inside.results[0].value, 0.135, 1e-6);
  EXPECT_NEAR(*inside.results[0].reference, 0.170, 1e-6);
  EXPECT_EQ(inside.results[0].judgement.verdict, Verdict::differs);
  EXPECT_FALSE(evaluate_row(row("0.8")).results[0].value);  // after the end of the run
}

// From the same place at 0.01 m/s less than the beads: rms 0.01 m/s 0.6 s / sqrt(3), held to what moves
// records.
TEST_F(Evaluate, AGrainFrontAsACurveIsHeldToTheBand) {
  write_run("s1", series(0.19));
  write_record("seed1", 0.2, scene_.reference_hash);
  const std::string row =
      "metric = \"grain_front_curve\"\nwindow = [0, 0.6]\n"
      "reference = { kind = \"DEM\", record = \"s1\" }\ntolerance = { absolute = 0, unit = \"m\" }\n";
  const Evaluation alone = evaluate_row(row);
  EXPECT_NEAR(*alone.results[0].value, 0.006 / std::sqrt(3.0), 1e-5);
  EXPECT_EQ(alone.results[0].judgement.verdict, Verdict::differs);
  write(paths_.records / "bands.json",
        R"([{"scene": "canary", "against": "cell-2mm", "column": "front_dense [m]", "rms": 0.004}])");
  const Evaluation banded = evaluate_row(row);
  EXPECT_NEAR(banded.results[0].band, 0.004, 1e-9);  // in m: not over h0
  EXPECT_EQ(banded.results[0].judgement.verdict, Verdict::within_band);
}

// A front of finite numbers whose squares are none.
TEST_F(Evaluate, WhatIsNotFiniteIsRefused) {
  write_run("s1", series(1e200));
  write_record("seed1", 0.1, scene_.reference_hash);
  const Evaluation evaluation = evaluate_row(curve_row);
  EXPECT_EQ(evaluation.results[0].judgement.verdict, Verdict::not_run);
  EXPECT_EQ(evaluation.results[0].note, "refused: the metric is not finite");
  EXPECT_EQ(evaluation.unexpected(), 1);
}

// Who reads the rows is told which two runs one is made of.
TEST_F(Evaluate, ARowOfTwoRunsNamesBoth) {
  write_run("s1", series(0.1));
  write_run("other", series(0.1));
  const auto table = parse_table(
      "[[run]]\nid = \"s1\"\n[[run]]\nid = \"other\"\ncase = \"s1\"\n[[check]]\nrun = \"s1\"\n"
      "metric = \"run_out_distance\"\nagainst = \"other\"\nwindow = [0, 5]\nfrequency = \"verify\"\n"
      "reference = { kind = \"theory\", value = 0, source = \"x\" }\n"
      "tolerance = { absolute = 0, unit = \"-\" }\n",
      "t");
  const auto json = nlohmann::json::parse(
      results_json(evaluate(table, Frequency::verify, paths_), Frequency::verify, "2026-01-01T00:00:00Z"));
  EXPECT_EQ(json.at("results").at(0).at("scene"), "s1");
  EXPECT_EQ(json.at("results").at(0).at("against"), "other");
}

TEST_F(Evaluate, ABadCaseIsAnError) {
  paths_.cases = root_ / "nowhere";
  EXPECT_THROW(evaluate_row(volume_row), CaseError);
}

}  // namespace
}  // namespace granvof::compare
