// A run directory that is written without a solver, for tests of its writer.
#pragma once

#include <filesystem>
#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "solver/output/run_writer.hpp"
#include "solver/tests/output/samples.hpp"

namespace granvof::test {

inline const std::vector<Column> monitors{{"dt", "s", "time step"}};

class RunDirectory : public testing::Test {
 protected:
  RunDirectory() {
    for (int r = 0; r < 10; ++r) scene.times.row_times.push_back(0.1 * r);
    scene.times.field_times = scene.times.row_times;
    scene.times.end = 1.0;
  }
  RunWriter fresh() const { return RunWriter::fresh(run, scene, start, monitors); }
  RunWriter resume() const { return RunWriter::resume(run, scene, start, monitors).writer; }

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
  RunStart start{"granvof", "granvof run sample.toml", 1, 2, {}};
};

}  // namespace granvof::test
