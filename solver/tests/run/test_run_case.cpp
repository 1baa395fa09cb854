// Whole runs into a directory: how they end, what they leave, and that a resumed run is the same run.
#include <algorithm>
#include <csignal>
#include <functional>
#include <thread>

#include <nlohmann/json.hpp>

#include "solver/output/checkpoint.hpp"
#include "solver/output/fields_file.hpp"
#include "solver/output/output_error.hpp"
#include "solver/output/series_file.hpp"
#include "solver/tests/output/samples.hpp"
#include "solver/tests/run/small_runs.hpp"

namespace granvof {
namespace {

using nlohmann::json;
using test::column_scene;
using test::run_into;
using test::text_of;

json record_of(const std::filesystem::path& run) {
  return json::parse(text_of(run / "run.json"));
}

class RunCase : public ::testing::Test {
 protected:
  std::filesystem::path path(const char* name) const { return directory_.path() / name; }

 private:
  test::TemporaryDirectory directory_;
};

void expect_same_fields(const std::filesystem::path& a, const std::filesystem::path& b) {
  const auto times = read_field_times(a / "fields.h5");
  ASSERT_EQ(times, read_field_times(b / "fields.h5"));
  for (std::size_t i = 0; i < times.size(); ++i) {
    const CellFields x = read_fields(a / "fields.h5", i), y = read_fields(b / "fields.h5", i);
    EXPECT_EQ(x.f_s, y.f_s) << times[i];
    EXPECT_EQ(x.alpha, y.alpha) << times[i];
    EXPECT_EQ(x.p_c, y.p_c) << times[i];
    EXPECT_EQ(x.p_s, y.p_s) << times[i];
    EXPECT_EQ(x.theta, y.theta) << times[i];
    EXPECT_EQ(x.phi, y.phi) << times[i];
    EXPECT_EQ(x.u_s, y.u_s) << times[i];
    EXPECT_EQ(x.u_c, y.u_c) << times[i];
  }
}

// Fields on disk are single precision: the checkpoints must agree in every bit.
void expect_same_checkpoints(const std::filesystem::path& a, const std::filesystem::path& b,
                             const Scene& scene) {
  const Checkpoint x = read_checkpoint(a / "checkpoint.h5", scene),
                   y = read_checkpoint(b / "checkpoint.h5", scene);
  EXPECT_EQ(x.time, y.time);
  ASSERT_EQ(x.arrays.size(), y.arrays.size());
  for (const auto& [name, values] : x.arrays) EXPECT_EQ(values, y.arrays.at(name)) << name;
  EXPECT_EQ(x.counters, y.counters);
  for (const auto& [name, value] : x.scalars)
    if (name != "wall_seconds" && name != "core_seconds") {
      EXPECT_EQ(value, y.scalars.at(name)) << name;
    }
}

TEST_F(RunCase, FinishesAndKeepsItsVolumes) {
  const Scene scene = column_scene();
  EXPECT_EQ(run_into(path("run"), scene), 0);
  const json record = record_of(path("run"));
  for (const char* key : {"scene", "version", "cells", "steps", "core_seconds", "cell_steps_per_second",
                          "solid_volume_error", "liquid_volume_error", "solid_fraction_max", "exit"})
    EXPECT_TRUE(record.contains(key)) << key;
  EXPECT_EQ(record["scene"], "column");
  EXPECT_EQ(record["cells"], 128);
  EXPECT_EQ(record["exit"]["state"], "finished");
  EXPECT_EQ(record["exit"]["reason"], "");
  EXPECT_EQ(record["exit"]["kind"], "finished");
  EXPECT_NEAR(record["simulated_time"].get<double>(), 0.1, 1e-12);
  EXPECT_GT(record["steps"].get<int>(), 20);
  EXPECT_GT(record["core_seconds"].get<double>(), 0.0);
  EXPECT_LT(record["solid_volume_error"].get<double>(), 1e-12);
  EXPECT_LT(record["liquid_volume_error"].get<double>(), 1e-12);
  EXPECT_GE(record["solid_fraction_max"].get<double>(), 0.57);
  EXPECT_LT(record["solid_fraction_max"].get<double>(), 0.63);
  for (const char* part :
       {"closures", "predictor", "friction", "pressure", "transport", "granular temperature"})
    EXPECT_GT(record["cost"][part].get<double>(), 0.0) << part;

  const Series series = read_series(path("run") / "series.csv");
  const auto times = series.column("time");
  ASSERT_EQ(times.size(), 11U);
  EXPECT_EQ(*times.front(), 0.0);
  EXPECT_NEAR(*times.back(), 0.1, 1e-12);
  const auto solid = series.column("solid_volume");
  for (const auto& v : solid) EXPECT_NEAR(*v, 0.57 * 0.05 * 0.04 * scene.tank[2], 1e-9);
  EXPECT_LT(*series.column("y_solid_mean").back(),
            *series.column("y_solid_mean").front() - 1e-4);  // it slumps
  EXPECT_EQ(read_field_times(path("run") / "fields.h5").size(), 3U);
}

// The fluxes that carry the liquid close continuity to rounding, however well the pressures are solved.
TEST_F(RunCase, LiquidIsConservedWhateverTheTolerance) {
  for (const char* tolerance : {"1e-4", "1e-6"}) {
    ASSERT_EQ(run_into(path(tolerance), column_scene({std::string("numerics.volume_tolerance=") + tolerance,
                                                      "time.end=0.05"})),
              0);
    EXPECT_LT(record_of(path(tolerance))["liquid_volume_error"].get<double>(), 1e-13) << tolerance;
  }
}

TEST_F(RunCase, LimitedFluxesFinishToo) {
  EXPECT_EQ(run_into(path("run"), column_scene({"numerics.solid_flux=limited"})), 0);
  const json record = record_of(path("run"));
  EXPECT_LT(record["solid_volume_error"].get<double>(), 1e-12);
  EXPECT_LT(record["liquid_volume_error"].get<double>(), 1e-12);
}

TEST_F(RunCase, AHeldColumnStartsItsOutputAtItsRelease) {
  EXPECT_EQ(run_into(path("run"), column_scene({"time.hold=0.02", "time.end=0.02"})), 0);
  const auto times = read_series(path("run") / "series.csv").column("time");
  ASSERT_EQ(times.size(), 3U);
  EXPECT_NEAR(*times.front(), 0.0, 1e-12);
  EXPECT_EQ(read_field_times(path("run") / "fields.h5").size(), 2U);
  // behind the closed gate nothing has passed it
  const CellFields start = read_fields(path("run") / "fields.h5", 0);
  for (int j = 0; j < 8; ++j)
    for (int i = 5; i < 16; ++i) EXPECT_EQ(start.f_s[static_cast<std::size_t>(j * 16 + i)], 0.0);
}

// Run to 0.05 s and on from there, against a run to 0.1 s in one go.
TEST_F(RunCase, ResumedRunIsTheSameRun) {
  const std::string dense = "bed.solid_fraction=0.6";
  for (const std::string choice :
       {"numerics.solid_flux=upwind", "numerics.solid_flux=limited", "model.shear_dilatancy=true"}) {
    const Scene whole = column_scene({choice, dense}), half = column_scene({choice, dense, "time.end=0.05"});
    const auto a = path(("whole-" + choice).c_str()), b = path(("parts-" + choice).c_str());
    ASSERT_EQ(run_into(a, whole), 0);
    ASSERT_EQ(run_into(b, half), 0);
    EXPECT_NE(text_of(a / "series.csv"), text_of(b / "series.csv"));
    ASSERT_EQ(run_into(b, whole, true), 0);
    EXPECT_EQ(text_of(a / "series.csv"), text_of(b / "series.csv"));
    expect_same_fields(a, b);
    expect_same_checkpoints(a, b, whole);
    EXPECT_EQ(record_of(a)["steps"], record_of(b)["steps"]);
    EXPECT_EQ(record_of(b)["resumptions"].size(), 1U);
  }
}

// Sends `signal` once the run has its fourth row: after run_case has set its handler, in the middle of the
// run.
int stopped_by(int signal, const std::filesystem::path& run, const Scene& scene) {
  std::thread killer([&] {
    const auto rows = [](const std::string& text) { return std::count(text.begin(), text.end(), '\n'); };
    while (rows(text_of(run / "series.csv")) < 4) std::this_thread::sleep_for(std::chrono::microseconds(200));
    std::raise(signal);
  });
  const int code = run_into(run, scene);
  killer.join();
  return code;
}

TEST_F(RunCase, StoppedBySignalAndResumed) {
  const Scene scene = column_scene({"time.end=0.3"});
  ASSERT_EQ(run_into(path("whole"), scene), 0);
  EXPECT_EQ(stopped_by(SIGTERM, path("parts"), scene), 1);
  const json record = record_of(path("parts"));
  EXPECT_EQ(record["exit"]["state"], "stopped");
  EXPECT_EQ(record["exit"]["reason"], "stopped by a signal (SIGTERM)");
  EXPECT_EQ(record["exit"]["resume_from"], record["simulated_time"]);
  EXPECT_LT(record["simulated_time"].get<double>(), 0.3);
  EXPECT_GT(record["simulated_time"].get<double>(), 0.01);
  ASSERT_EQ(run_into(path("parts"), scene, true), 0);
  EXPECT_EQ(text_of(path("whole") / "series.csv"), text_of(path("parts") / "series.csv"));
  EXPECT_EQ(text_of(path("whole") / "fields.h5"), text_of(path("parts") / "fields.h5"));
  expect_same_fields(path("whole"), path("parts"));
  expect_same_checkpoints(path("whole"), path("parts"), scene);
}

TEST_F(RunCase, EverySignalOfASchedulerOrAShellStopsItWithACheckpoint) {
  const std::vector<std::pair<int, std::string>> signals{
      {SIGINT, "SIGINT"},       {SIGHUP, "SIGHUP"},   {SIGQUIT, "SIGQUIT"}, {SIGUSR1, "SIGUSR1"},
      {SIGUSR2, "SIGUSR2"},     {SIGXCPU, "SIGXCPU"}, {SIGPIPE, "SIGPIPE"}, {SIGALRM, "SIGALRM"},
      {SIGVTALRM, "SIGVTALRM"}, {SIGPROF, "SIGPROF"}, {SIGPOLL, "SIGPOLL"}, {SIGPWR, "SIGPWR"},
      {SIGSTKFLT, "SIGSTKFLT"}};
  const Scene scene = column_scene({"time.end=2"});
  for (const auto& [signal, name] : signals) {
    EXPECT_EQ(stopped_by(signal, path(name.c_str()), scene), 1) << name;
    const json exit = record_of(path(name.c_str()))["exit"];
    EXPECT_EQ(exit["state"], "stopped");
    EXPECT_EQ(exit["reason"], "stopped by a signal (" + name + ")");
    EXPECT_EQ(exit["kind"], signal == SIGXCPU ? "CPU limit" : "signal");
    EXPECT_EQ(exit["resume_from"], read_checkpoint(path(name.c_str()) / "checkpoint.h5", scene).time);
  }
}

// A limit that is up after the first step stops each part after one step.
TEST_F(RunCase, StoppedAtItsWallClockLimitAndResumedItIsTheSameRun) {
  const Scene scene = column_scene();
  ASSERT_EQ(run_into(path("whole"), scene), 0);
  RunOptions options;
  options.out = path("parts");
  options.command = "test";
  options.progress = false;
  options.stop_after = 1e-9;
  for (int part = 1; part <= 3; ++part) {
    EXPECT_EQ(run_case(scene, options), exit_code_at_wall_clock_limit);
    options.resume = true;
    const json record = record_of(path("parts"));
    EXPECT_EQ(record["steps"], part);
    EXPECT_EQ(record["exit"]["state"], "stopped");
    EXPECT_EQ(record["exit"]["kind"], "wall-clock limit");
    EXPECT_EQ(record["exit"]["resume_from"], read_checkpoint(path("parts") / "checkpoint.h5", scene).time);
  }
  options.stop_after = 3600.0;
  ASSERT_EQ(run_case(scene, options), 0);
  EXPECT_EQ(record_of(path("parts"))["resumptions"].size(), 3U);
  EXPECT_EQ(text_of(path("whole") / "series.csv"), text_of(path("parts") / "series.csv"));
  EXPECT_EQ(text_of(path("whole") / "fields.h5"), text_of(path("parts") / "fields.h5"));
  expect_same_checkpoints(path("whole"), path("parts"), scene);
}

TEST_F(RunCase, AnEndThatItSurvivesIsInTheRecord) {
  // its series taken away while it runs
  std::thread thief([&] {
    while (text_of(path("robbed") / "series.csv").size() < 3000)
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    std::filesystem::remove(path("robbed") / "series.csv");
  });
  EXPECT_EQ(run_into(path("robbed"), column_scene({"time.end=2"})), 1);
  thief.join();
  json exit = record_of(path("robbed"))["exit"];
  EXPECT_EQ(exit["state"], "failed");
  EXPECT_NE(exit["reason"].get<std::string>().find("removed or replaced"), std::string::npos)
      << exit["reason"];
  EXPECT_EQ(exit["kind"], "output");
  EXPECT_TRUE(exit["resume_from"].is_null());
  // a value that no formula was made for
  for (const char* unusual : {"solid.friction=1e30", "contact.stiffness=1e30", "liquid.viscosity=1e30"}) {
    const int code = run_into(path(unusual), column_scene({unusual, "time.end=0.02"}));
    exit = record_of(path(unusual))["exit"];
    EXPECT_EQ(exit["state"], code == 0 ? "finished" : "failed") << unusual;
    EXPECT_EQ(exit["reason"].get<std::string>().empty(), code == 0) << unusual;
  }
}

// Enough cells for threads to share. Sums are in the order of the cells, whoever adds them up.
TEST_F(RunCase, ThreadsChangeNothing) {
  const std::vector<std::string> changes{"grid.dx=0.00125", "time.end=0.01", "output.field_times=[0]"};
  for (const int threads : {1, 2, 3, 3}) {
    const auto out = path(std::to_string(threads).c_str());
    ASSERT_EQ(run_into(out, column_scene(changes), false, threads), 0);
    EXPECT_EQ(text_of(out / "series.csv"), text_of(path("1") / "series.csv")) << threads;
    EXPECT_EQ(text_of(out / "fields.h5"), text_of(path("1") / "fields.h5")) << threads;
  }
}

TEST_F(RunCase, ResumingWithoutACheckpointIsRefused) {
  EXPECT_THROW(run_into(path("none"), column_scene(), true), OutputError);
  ASSERT_EQ(run_into(path("run"), column_scene({"time.end=0.01"})), 0);
  EXPECT_THROW(run_into(path("run"), column_scene({"solid.density=2400"}), true),
               OutputError);                                                               // another case
  EXPECT_THROW(run_into(path("run"), column_scene({"grid.dx=0.02"}), true), OutputError);  // another grid
  EXPECT_THROW(run_into(path("run"), column_scene({"numerics.cfl=0.2"}), true), OutputError);
  EXPECT_THROW(run_into(path("run"), column_scene({"grid.dx=0.02"})), OutputError);  // nor is it replaced
}

TEST_F(RunCase, StepCollapseLeavesTheLastGoodStateAndTheReason) {
  // a dense start that one Newton iteration cannot solve, and no shorter step allowed
  Scene scene = column_scene({"bed.solid_fraction=0.61", "numerics.dt_max=1e-3", "numerics.dt_min=1e-4"});
  scene.numerics.newton_max = 1;  // fewer than a case may have
  EXPECT_EQ(run_into(path("run"), scene), 1);
  const json record = record_of(path("run"));
  EXPECT_EQ(record["exit"]["state"], "failed");
  EXPECT_EQ(record["exit"]["kind"], "step collapse");
  const std::string reason = record["exit"]["reason"];
  EXPECT_NE(reason.find("step collapse at t = 0"), std::string::npos) << reason;
  EXPECT_NE(reason.find("did not converge in 1 iterations"), std::string::npos) << reason;
  EXPECT_GT(record["refused_steps"].get<int>(), 0);
  EXPECT_EQ(read_checkpoint(path("run") / "checkpoint.h5", scene).time, record["exit"]["time"].get<double>());
  EXPECT_EQ(read_series(path("run") / "series.csv").rows.size(), 1U);  // what was good is on disk
  // With other numerics it would be another run.
  EXPECT_THROW(run_into(path("run"), column_scene({"bed.solid_fraction=0.61", "time.end=0.01"}), true),
               OutputError);
}

TEST_F(RunCase, ANanEndsTheRunWithAReason) {
  const Scene half = column_scene({"time.end=0.02"}), whole = column_scene({"time.end=0.04"});
  for (const char* name : {"u_s0", "u_c1", "theta", "alpha", "f_s", "p_c"}) {
    ASSERT_EQ(run_into(path(name), half), 0);
    Checkpoint saved = read_checkpoint(path(name) / "checkpoint.h5", half);
    CheckpointView view{saved.time, {}, saved.scalars, saved.counters, saved.rows, saved.instants_sha256};
    std::vector<double>& values = saved.arrays.at(name);
    values[static_cast<std::size_t>(Grid(half).cells.index(1, 2, 0))] = std::nan("");  // inside the bed
    for (const auto& [key, array] : saved.arrays) view.arrays[key] = array;
    write_checkpoint(path(name) / "checkpoint.h5", half, view);
    EXPECT_EQ(run_into(path(name), whole, true), 1) << name;
    const json record = record_of(path(name));
    EXPECT_EQ(record["exit"]["state"], "failed") << name;
    EXPECT_EQ(record["exit"]["kind"], "not finite") << name;
    EXPECT_NE(record["exit"]["reason"].get<std::string>().find("finite"), std::string::npos)
        << name << ": " << record["exit"]["reason"];
    for (const auto& row : read_series(path(name) / "series.csv").rows) EXPECT_LE(*row[0], 0.02 + 1e-12);
  }
}

// A state of a program that has a field more, of the same version and format: it would go on as another.
TEST_F(RunCase, ACheckpointWithWhatIsNotKnownIsRefused) {
  const Scene scene = column_scene({"time.end=0.02"}), longer = column_scene({"time.end=0.04"});
  ASSERT_EQ(run_into(path("run"), scene), 0);
  const auto file = path("run") / "checkpoint.h5";
  const Checkpoint saved = read_checkpoint(file, scene);
  CheckpointView view{saved.time, {}, saved.scalars, saved.counters, saved.rows, saved.instants_sha256};
  for (const auto& [key, array] : saved.arrays) view.arrays[key] = array;
  const std::vector<double> values(8, 1.0);
  for (auto add :
       std::vector<std::function<void(CheckpointView&)>>{[&](CheckpointView& v) { v.arrays["new"] = values; },
                                                         [](CheckpointView& v) { v.scalars["new"] = 1.0; },
                                                         [](CheckpointView& v) { v.counters["new"] = 1; }}) {
    CheckpointView other = view;
    add(other);
    write_checkpoint(file, scene, other);
    EXPECT_THROW(run_into(path("run"), longer, true), OutputError);
  }
  write_checkpoint(file, scene, view);
  EXPECT_EQ(run_into(path("run"), longer, true), 0);
}

TEST_F(RunCase, RefusedStepsAreRetriedShorter) {
  // a heavy bed let fall: the growing speed outruns a Courant number of 0.9 and a huge dt_max
  const Scene scene = column_scene({"bed.y=0.03", "gate=false", "solid.density=20000", "numerics.cfl=0.9",
                                    "numerics.dt_max=1", "numerics.newton_max=4"});
  EXPECT_EQ(run_into(path("run"), scene), 0);
  const json record = record_of(path("run"));
  EXPECT_GT(record["refused_steps"].get<int>(), 0);
  EXPECT_EQ(record["exit"]["state"], "finished");
  EXPECT_LT(record["solid_volume_error"].get<double>(), 1e-12);
  EXPECT_LT(record["liquid_volume_error"].get<double>(), 1e-12);
}

}  // namespace
}  // namespace granvof
