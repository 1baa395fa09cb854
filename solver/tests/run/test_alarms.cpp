// Silent wrong answers: each is provoked here, and must be seen by the monitor that is there for it.
#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "solver/output/checkpoint.hpp"
#include "solver/run/alarms.hpp"
#include "solver/run/initial_state.hpp"
#include "solver/scene/scales.hpp"
#include "solver/tests/output/samples.hpp"
#include "solver/tests/run/small_runs.hpp"

namespace granvof {
namespace {

using nlohmann::json;
using test::column_scene;
using test::run_into;

class RunAlarms : public ::testing::Test {
 protected:
  json record_of(const std::vector<std::string>& overrides) {
    const auto run = directory_.path() / ("run" + std::to_string(++runs_));
    EXPECT_EQ(run_into(run, column_scene(overrides)), 0);
    return json::parse(test::text_of(run / "run.json"));
  }
  std::filesystem::path path(const char* name) const { return directory_.path() / name; }
  int runs_ = 0;
  using Change = std::function<void(std::vector<double>&)>;
  // Rows of cells that pass each other at that speed.
  static Change stir(double speed) {
    return [=](std::vector<double>& u) {
      for (std::size_t i = 0; i < u.size(); ++i) u[i] = (i / 20) % 2 == 0 ? speed : -speed;
    };
  }
  static Change scale(double by) {
    return [=](std::vector<double>& values) {
      for (double& value : values) value *= by;
    };
  }
  static Change replace(double was, double now) {
    return [=](std::vector<double>& values) { std::replace(values.begin(), values.end(), was, now); };
  }
  static Change set(double now) {
    return [=](std::vector<double>& values) { std::fill(values.begin(), values.end(), now); };
  }
  // The record of what goes on with a field that was changed half-way.
  json resumed(const char* field, const Change& change) {
    EXPECT_EQ(resume_with(change, field), 0);
    return resumed_;
  }
  // Changes a field half-way through a run; the exit code of what goes on from there, and its record in
  // `resumed_`.
  int resume_with(const Change& change, const char* field) {
    const Scene half = column_scene({"time.end=0.02"}), whole = column_scene({"time.end=0.04"});
    const auto run = directory_.path() / ("resumed" + std::to_string(++runs_));
    EXPECT_EQ(run_into(run, half), 0);
    Checkpoint saved = read_checkpoint(run / "checkpoint.h5", half);
    CheckpointView view{saved.time, {}, saved.scalars, saved.counters, saved.rows, saved.instants_sha256};
    change(saved.arrays.at(field));
    for (const auto& [key, array] : saved.arrays) view.arrays[key] = array;
    write_checkpoint(run / "checkpoint.h5", half, view);
    const int code = run_into(run, whole, true);
    resumed_ = json::parse(test::text_of(run / "run.json"));
    return code;
  }
  json resumed_;
  static bool warned(const json& record, const char* monitor) {
    return std::any_of(record["warnings"].begin(), record["warnings"].end(),
                       [&](const json& w) { return w["monitor"] == monitor && w["value"] > w["limit"]; });
  }

 private:
  test::TemporaryDirectory directory_;
};

TEST_F(RunAlarms, ASoundRunRaisesNone) {
  EXPECT_EQ(record_of({"numerics.solid_flux=limited"})["warnings"], json::array());
}

// A dry bed on a slope it rests on, whose potential energy counts from above it.
TEST_F(RunAlarms, ADryBedInAnInclinedTankIsNoBlowUp) {
  const json record = record_of({"tank.inclination=12", "liquid=false", "gate=false", "bed.length=0.16"});
  EXPECT_EQ(record["exit"]["state"], "finished");
  EXPECT_FALSE(warned(record, "energy residual"));
}

// Without gravity a bed has no energy of its own to take shares of, and where nothing moves none is turned
// over.
TEST_F(RunAlarms, ABedAtRestWithoutGravityRaisesNone) {
  EXPECT_EQ(record_of({"tank.gravity=0", "gate=false"})["warnings"], json::array());
}

// However loose the tolerance, no guess of the pressure passes for a solution: continuity is solved well
// enough for the budget. (That a residual is seen: the table.)
TEST_F(RunAlarms, ALooseToleranceLeavesTheBudgetClosed) {
  EXPECT_FALSE(warned(record_of({"numerics.volume_tolerance=1e-2", "numerics.linear_tolerance=0.5"}),
                      "energy residual"));
}

// Velocities that nothing has given, as after a blow-up that stays finite: the run stops and says why. With a
// hundredth of them it goes on, and warns: see the table.
TEST_F(RunAlarms, EnergyFromNothingStopsTheRun) {
  EXPECT_EQ(resume_with(stir(30.0), "u_c0"), 1);
  EXPECT_TRUE(std::string(resumed_["exit"]["reason"]).starts_with("blow-up")) << resumed_["exit"]["reason"];
}

// Of each alarm a run that raises it, and one beside it that does not.
class EveryAlarm : public RunAlarms {
 protected:
  struct Pair {
    std::function<json()> fires, silent;
    const char* mistaken_for = nullptr;  // another alarm, that the first run does not raise
  };

  std::map<std::string, Pair> table() {
    using Overrides = std::vector<std::string>;
    const auto run = [this](const Overrides& overrides) {
      return [=, this] { return record_of(overrides); };
    };
    const auto change = [this](const char* field, const Change& done) {
      return [=, this] { return resumed(field, done); };
    };
    const Overrides soft{"contact.solid_fraction_max=0.575", "contact.dense_solid_fraction=0.575"},
        dense{"bed.solid_fraction=0.61", "time.end=0.02"},
        ring{"gate=false",    "walls.left=periodic", "walls.right=periodic", "bed.solid_fraction=0.59",
             "time.end=0.02", "grid.dx=0.02",        "solid.friction=1e3"};
    const auto with = [](Overrides list, const char* more) {
      list.emplace_back(more);
      return list;
    };
    return {
        // Grains and liquid that appear or are lost between two steps, and less than nothing in empty cells.
        {"solid volume",
         {change("f_s", scale(1.0 + 1e-8)), change("f_s", scale(1.0 + 1e-10)), "negative fraction"}},
        {"liquid volume",
         {change("alpha", scale(1.0 - 1e-8)), change("alpha", scale(1.0 - 1e-10)), "solid volume"}},
        {"negative fraction", {change("f_s", replace(0.0, -1e-7)), change("f_s", replace(0.0, -1e-11))}},
        // Contacts that are too soft for the load: the bed is pressed beyond its largest packing.
        {"solid fraction",
         {run(with(soft, "contact.stiffness=10")), run(with(soft, "contact.stiffness=1e7"))}},
        // Velocities that no term of the budget gave.
        {"energy residual", {change("u_c0", stir(0.3)), change("u_c0", scale(1.0))}},
        // Fluxes of first order on four cells across a column lift as much as physics dissipates; limited
        // ones
        // do not.
        {"energy created", {run({}), run({"numerics.solid_flux=limited"})}},
        // At 0.61 the contacts of this bed hold several times its own potential energy; where the packing is
        // the
        // bed's own, nothing.
        {"elastic start",
         {run(with(dense, "model.packing=uniform")), run(with(dense, "model.packing=carried"))}},
        // A cloud that falls freely loses to upwind momentum, implicit steps and contacts; a collapse less.
        {"energy destroyed", {[this] { return falling_cloud(); }, run({})}},
        // A dry column beside an outlet leans on it; what falls through one does not, dense as it is.
        {"outlet load",
         {[this] {
            return beside_outlet("right", {"bed.solid_fraction=0.575", "bed.length=0.09"});
          },
          [this] {
            return beside_outlet(
                "bottom", {"bed.solid_fraction=0.57", "bed.length=0.1", "bed.y=0.02", "model.preset=paper"});
          },
          "energy residual"}},
        // Fluctuation that nothing has given is cut down to what a fall could give.
        {"granular bounds", {change("theta", set(2.0)), change("theta", set(1e-9))}},
        // Cells eighty times as wide as high, between periodic sides, where nothing is factorised: conjugate
        // gradients end at their limit in every other step.
        {"friction solves", {run(with(ring, "grid.dy=0.00025")), run(with(ring, "grid.dy=0.0025"))}},
        // Fewer Newton iterations than a case may have.
        {"refused steps", {[this] { return with_newton_max(2); }, [this] { return with_newton_max(30); }}},
    };
  }

  json beside_outlet(const char* side, std::vector<std::string> bed) {
    bed.insert(bed.end(), {"liquid=false", "solid.diameter=1e-3", "time.end=0.3"});
    const Scene scene = test::small_tank(
        side, "size = [0.1, 0.1]", 0.1,
        fmt::format(
            "[walls]\nall = \"no-slip\"\ntop = \"open\"\n{} = {{ outflow_pressure = 0 }}\n[bed]\nlength = "
            "0.1\nheight = 0.05\nsolid_fraction = 0.5\n",
            side),
        bed);
    EXPECT_EQ(run_into(path(side), scene), 0);
    return json::parse(test::text_of(path(side) / "run.json"));
  }
  json falling_cloud() {
    const Scene scene = test::small_tank(
        "cloud", "size = [0.01, 0.5]", 0.1,
        "[walls]\nall = \"slip\"\ntop = \"open\"\n[bed]\ny = 0.4\nlength = 0.01\nheight = 0.05\n"
        "solid_fraction = 0.3\n[model]\npreset = \"paper\"\ndrag = false\ngranular_temperature = "
        "\"off\"\ncontact_friction = false\n",
        {"liquid=false", "time.end=0.2"});
    EXPECT_EQ(run_into(path("cloud"), scene), 0);
    return json::parse(test::text_of(path("cloud") / "run.json"));
  }
  json with_newton_max(int most) {
    Scene scene = column_scene();
    scene.numerics.newton_max = most;
    scene.numerics.volume_tolerance = 1e-9;
    const auto run = path(("newton" + std::to_string(most)).c_str());
    EXPECT_EQ(run_into(run, scene), 0);
    return json::parse(test::text_of(run / "run.json"));
  }
};

TEST_F(EveryAlarm, IsRaisedByOneRunAndNotByTheOneBesideIt) {
  const auto pairs = table();
  for (const Alarm& alarm : Alarms::list()) {
    const auto found = pairs.find(alarm.monitor);
    ASSERT_TRUE(found != pairs.end()) << "no run raises '" << alarm.monitor << "'";
    const json fired = found->second.fires(), beside = found->second.silent();
    EXPECT_TRUE(warned(fired, alarm.monitor)) << alarm.monitor << ": " << fired["warnings"];
    EXPECT_FALSE(warned(beside, alarm.monitor)) << alarm.monitor << ": " << beside["warnings"];
    if (const char* wrong = found->second.mistaken_for) {
      EXPECT_FALSE(warned(fired, wrong)) << alarm.monitor << ": " << fired["warnings"];
    }
  }
  EXPECT_EQ(pairs.size(), Alarms::list().size());
}

// The rules themselves, each limit alone.
class AlarmRules : public ::testing::Test {
 protected:
  AlarmRules() : grid_(scene_), boundary_(grid_), state_(initial_state(grid_, scene_, boundary_)) {
    state_.energy.kinetic = 1.0;  // so that shares of the turnover mean something
  }
  std::vector<Warning> raised(const EnergyTerms& energy, std::int64_t unconverged = 0) {
    Alarms alarms(scene_, start());
    state_.energy = energy;
    stopped_ = alarms.check(state_, Monitors(grid_, scene_, state_), {100, unconverged});
    return alarms.raised();
  }
  // Of a state in which one cell of each kind has changed since the start.
  std::vector<Warning> raised_after(double bed_scaled_by, double empty_cell_set_to) {
    Alarms alarms(scene_, start());
    State changed = state_;
    Monitors monitors(grid_, scene_, changed);
    bool set = false;
    for_each(grid_.cells, [&](std::ptrdiff_t c) {
      double& f_s = changed.f_s.data()[c];
      if (f_s > 0.0) f_s *= bed_scaled_by;
      if (f_s != 0.0 || set) return;
      f_s = empty_cell_set_to;
      set = true;
    });
    EXPECT_TRUE(set);
    changed.energy = moving();
    monitors.update(changed, 0.0, 0.0);
    alarms.check(changed, monitors, {100, 0});
    return alarms.raised();
  }
  const Scene& scene() const { return scene_; }
  const Grid& grid() const { return grid_; }
  const State& at_rest() const { return state_; }
  EnergyTerms start() const {
    EnergyTerms e;
    e.potential = 10.0;
    return e;
  }
  EnergyTerms moving() const {
    EnergyTerms e = start();
    e.kinetic = 1.0;
    return e;
  }
  std::string stopped_;

 private:
  Scene scene_ = column_scene();
  Grid grid_;
  Boundary boundary_;
  State state_;
};

// What runs down an inclined tank stores next to nothing by the corner that its potential counts from.
TEST_F(RunAlarms, WaterThatRunsDownAnInclinedTankIsNoBlowUp) {
  const Scene scene = parse_scene(
      "[scene]\nname = \"tilted\"\n[tank]\nsize = [2.0, 0.2]\ninclination = 20\n[grid]\ndx = 0.05\n"
      "[walls]\nall = \"slip\"\ntop = \"open\"\n[gas]\ndensity = 1\nviscosity = 1e-5\n[liquid]\n"
      "density = 1000\nviscosity = 1e-3\nbox = { origin = [0, 0], size = [0.3, 0.1] }\n[time]\nend = 0.6\n",
      "tilted.toml");
  EXPECT_EQ(run_into(path("tilted"), scene), 0);
}

TEST_F(AlarmRules, EachLimitRaisesItsOwnAlarm) {
  EXPECT_TRUE(raised(moving()).empty());
  EXPECT_EQ(stopped_, "");
  struct Wrong {
    const char* monitor;
    double EnergyTerms::*term;
    double below, above;
  };
  for (const Wrong& wrong : {Wrong{"energy residual", &EnergyTerms::residual, 0.009, 0.011},
                             Wrong{"energy created", &EnergyTerms::dense_excess, 0.44, 0.45},
                             Wrong{"energy destroyed", &EnergyTerms::numerical_time, 0.99, 1.01},
                             Wrong{"granular bounds", &EnergyTerms::theta_bounds, 0.009, 0.011}}) {
    EnergyTerms energy = moving();
    energy.*wrong.term = wrong.below;
    EXPECT_TRUE(raised(energy).empty()) << wrong.monitor;
    energy.*wrong.term = wrong.above;
    const auto found = raised(energy);
    ASSERT_EQ(found.size(), 1U) << wrong.monitor;
    EXPECT_EQ(found[0].monitor, wrong.monitor);
    EXPECT_GT(found[0].value, found[0].limit);
  }
  EXPECT_TRUE(raised(moving(), 1).empty());
  ASSERT_EQ(raised(moving(), 2).size(), 1U);
  EXPECT_EQ(raised(moving(), 2)[0].monitor, "friction solves");
}

// What was created is in motion by then: as a share of that it would stay below a half.
TEST_F(AlarmRules, AFallThatNumericsMakeHalfOfIsSaid) {
  EnergyTerms fall = start();
  fall.potential -= 3.0;
  fall.kinetic = 5.95;
  fall.numerical_momentum = -2.95;
  const auto found = raised(fall);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].monitor, std::string("energy created"));
  EXPECT_NEAR(found[0].value, 2.95 / 3.0, 0.01);
}

TEST_F(AlarmRules, WhichSchemeDestroyedMostIsSaid) {
  EnergyTerms fall = moving();
  fall.numerical_time = 1.0;
  fall.numerical_elastic = 2.0;
  const auto found = raised(fall);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].monitor, std::string("energy destroyed"));
  EXPECT_TRUE(found[0].meaning.ends_with(", lost_numerical_elastic most: 0.5")) << found[0].meaning;
}

// A bed that hardly sinks in a deep tank: what the solves leave is a share of what the tank stores.
TEST_F(AlarmRules, AtRestAResidualIsHeldAgainstWhatIsStored) {
  EnergyTerms still = start();
  still.residual = 1e-5 * still.stored();
  EXPECT_TRUE(raised(still).empty());
  still.residual = 2e-5 * still.stored();
  ASSERT_EQ(raised(still).size(), 1U);
  EXPECT_EQ(raised(still)[0].monitor, std::string("energy residual"));
}

TEST_F(AlarmRules, AStartThatSpringsApartIsSaid) {
  for (const double share : {0.99, 1.01}) {
    EnergyTerms tight = start();
    tight.elastic = share * energy_of_bed(scene());
    Alarms alarms(scene(), tight);
    alarms.check(at_rest(), Monitors(grid(), scene(), at_rest()), {1, 0});
    ASSERT_EQ(alarms.raised().size(), share > 1.0 ? 1U : 0U) << share;
    if (share > 1.0) {
      EXPECT_EQ(alarms.raised()[0].monitor, std::string("elastic start"));
    }
  }
}

TEST_F(AlarmRules, VolumesAndFractionsHaveTheirOwnLimits) {
  EXPECT_TRUE(raised_after(1.0 + 0.9e-9, -0.9e-9).empty());
  const auto volume = raised_after(1.0 + 1.1e-9, 0.0);
  ASSERT_EQ(volume.size(), 1U);
  EXPECT_EQ(volume[0].monitor, std::string("solid volume"));
  const auto fraction = raised_after(1.0, -1.1e-9);
  ASSERT_EQ(fraction.size(), 1U);
  EXPECT_EQ(fraction[0].monitor, std::string("negative fraction"));
}

TEST_F(AlarmRules, MoreEnergyInMotionThanWasEverGivenStops) {
  EnergyTerms energy = moving();
  energy.kinetic = 99.0;
  raised(energy);
  EXPECT_EQ(stopped_, "");
  energy.kinetic = 101.0;
  raised(energy);
  EXPECT_NE(stopped_.find("blow-up"), std::string::npos) << stopped_;
}

// What the case says is no monitor of the run: it has a list of its own.
TEST_F(RunAlarms, ImplausibleValuesStandApart) {
  const json record = record_of({"solid.friction=21.8", "time.end=0.005", "output.series_interval=0.005"});
  ASSERT_EQ(record["plausibility"].size(), 1U) << record["plausibility"];
  EXPECT_EQ(record["plausibility"][0]["key"], "solid.friction");
  EXPECT_EQ(record["plausibility"][0]["given"], "21.8");
  EXPECT_EQ(record["plausibility"][0]["usual"], "0.05 to 1.5");
  EXPECT_EQ(record["warnings"], json::array());
  EXPECT_EQ(record_of({"time.end=0.005", "output.series_interval=0.005"})["plausibility"], json::array());
}

}  // namespace
}  // namespace granvof
