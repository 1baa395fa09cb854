// Runs and records on disk, and rows of a table that are judged by them.
#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "compare/checks/evaluate.hpp"
#include "compare/checks/table.hpp"
#include "compare/tests/files_stated.hpp"
#include "solver/output/seal.hpp"
#include "solver/scene/load_scene.hpp"
#include "solver/tests/cases_directory.hpp"
#include "solver/tests/temporary_directory.hpp"

namespace granvof::compare {

namespace fs = std::filesystem;

class Evaluate : public testing::Test {
 protected:
  static void write(const fs::path& file, const std::string& text) {
    fs::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }

  // A front that runs from 0.1 m at `speed`, to T = 10 of s1, as often as asked; a last row may be added.
  std::string series(double speed, const std::string& last_row = "") const {
    std::string text = "time [s],front_dense [m],front_dilute [m],solid_volume [m3]\n";
    for (const double t : scene_.times.row_times) {
      const double x = 0.1 + speed * t;
      text += fmt::format("{},{},{},0.002\n", t, x, x);
    }
    return text + last_row;
  }

  void write_run(const std::string& id, const std::string& series_text, const std::string& exit = "finished",
                 const std::string& resolved_tail = "") {
    const nlohmann::json json{
        {"scene", "s1"},
        {"version", "0.1.0"},
        {"case_hash", scene_.hash},
        {"resolved_case", scene_.resolved + resolved_tail},
        {"solid_volume_error", 1e-15},
        {"core_seconds", 2.5},
        {"files", test::files_stated(series_text)},
        {"exit", {{"state", exit}, {"reason", exit == "finished" ? "" : "step collapse"}}}};
    write(paths_.runs / id / "run.json", sealed(json.dump(2)));
    write(paths_.runs / id / "series.csv", series_text);
  }

  void write_record(const std::string& variant, double speed, const std::string& hash) {
    const nlohmann::json json{
        {"scene", "s1"}, {"case_hash", hash}, {"files", test::files_stated(series(speed))}};
    write(paths_.records / "s1" / variant / "record.json", json.dump());
    write(paths_.records / "s1" / variant / "series.csv", series(speed));
  }

  Evaluation evaluate_row(const std::string& row) {
    return evaluate(
        parse_table("[[run]]\nid = \"s1\"\n[[check]]\nrun = \"s1\"\nfrequency = \"verify\"\n" + row, "t"),
        Frequency::verify, paths_);
  }

  double height_of_s1() const { return scene_.bed->box.upper[1] - scene_.bed->box.lower[1]; }
  // The run-out at T = 5 is 5 tau speed / h0.
  double run_out_at_5(double speed) const {
    const double height = height_of_s1();
    return 5.0 * std::sqrt(height / scene_.gravity) * speed / height;
  }

  const std::string volume_row =
      "metric = \"solid_volume_error\"\nreference = { kind = \"theory\", value = 0, source = \"x\" }\n"
      "tolerance = { absolute = 1e-12, unit = \"-\" }\n";
  const std::string record_row =
      "metric = \"run_out\"\nat = 5\nreference = { kind = \"DEM\", record = \"s1\" }\n"
      "tolerance = { absolute = 0.01, unit = \"-\" }\n";
  const std::string curve_row =
      "metric = \"run_out_curve\"\nwindow = [0, 5]\nreference = { kind = \"DEM\", record = \"s1\" }\n"
      "tolerance = { absolute = 0.01, unit = \"-\" }\n";

  test::TemporaryDirectory directory_;
  const fs::path& root_ = directory_.path();
  Paths paths_{root_ / "runs", cases_directory(), root_ / "records"};
  Scene scene_ = load_scene(cases_directory() / "s1.toml");
};

}  // namespace granvof::compare
