// Silent wrong answers: each is provoked here, and must be seen by the monitor that is there for it.
#include <algorithm>
#include <functional>
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
  // Changes a field half-way through a run; the exit code of what goes on from there, and its record in
  // `resumed_`.
  int resume_with(const std::function<void(std::vector<double>&)>& change, const char* field = "f_s") {
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

// A dry column beside an outlet: it holds the grains, and the run says so; what falls through one does not.
TEST_F(RunAlarms, ABedThatLeansOnAnOutletIsNamed) {
  const auto record = [&](const char* outlet, const std::vector<std::string>& overrides) {
    const auto run = path(outlet);
    const Scene scene = test::small_tank(
        outlet, "size = [0.1, 0.1]", 0.1,
        fmt::format(
            "[walls]\nall = \"no-slip\"\ntop = \"open\"\n{} = {{ outflow_pressure = 0 }}\n[bed]\nlength = "
            "0.09\nheight = 0.05\nsolid_fraction = 0.575\n",
            outlet),
        overrides);
    EXPECT_EQ(run_into(run, scene), 0);
    return json::parse(test::text_of(run / "run.json"));
  };
  const std::vector<std::string> dry{"liquid=false", "solid.diameter=1e-3", "time.end=0.3"};
  const json leans = record("right", dry);
  EXPECT_TRUE(warned(leans, "outlet load"));
  EXPECT_FALSE(warned(leans, "energy residual"));
  std::vector<std::string> loose = dry;
  loose.insert(loose.end(), {"bed.length=0.1", "bed.y=0.02", "bed.solid_fraction=0.3"});
  EXPECT_EQ(record("bottom", loose)["warnings"], json::array());
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
// enough for the budget. (That a residual is seen: EnergyFromNothingStopsTheRun.)
TEST_F(RunAlarms, ALooseToleranceLeavesTheBudgetClosed) {
  EXPECT_FALSE(warned(record_of({"numerics.volume_tolerance=1e-2", "numerics.linear_tolerance=0.5"}),
                      "energy residual"));
}

TEST_F(RunAlarms, LiquidThatIsLostIsSeenInTheLiquidVolume) {
  resume_with(
      [](std::vector<double>& alpha) {
        for (double& value : alpha) value *= 1.0 - 1e-8;
      },
      "alpha");
  EXPECT_TRUE(warned(resumed_, "liquid volume")) << resumed_["warnings"];
  EXPECT_FALSE(warned(resumed_, "solid volume")) << resumed_["warnings"];
}

// Contacts that are too soft for the load: the bed is pressed beyond its largest packing.
TEST_F(RunAlarms, SoftContactIsSeenInThePacking) {
  const auto densest = [&](const char* stiffness) {
    return record_of({stiffness, "contact.solid_fraction_max=0.575", "contact.dense_solid_fraction=0.575"});
  };
  EXPECT_TRUE(warned(densest("contact.stiffness=10"), "solid fraction"));
  EXPECT_FALSE(warned(densest("contact.stiffness=1e7"), "solid fraction"));
}

// Grains that appear between two steps: a hundredth of all of them; and less than nothing in the empty cells.
TEST_F(RunAlarms, GrainsFromNothingAreSeenInTheSolidVolume) {
  resume_with([](std::vector<double>& f_s) {
    for (double& value : f_s) value *= 1.01;
  });
  EXPECT_TRUE(warned(resumed_, "solid volume")) << resumed_["warnings"];
  EXPECT_FALSE(warned(resumed_, "negative fraction")) << resumed_["warnings"];
}

TEST_F(RunAlarms, LessThanNothingIsSeen) {
  resume_with([](std::vector<double>& f_s) {
    for (double& value : f_s)
      if (value == 0.0) value = -1e-7;
  });
  EXPECT_TRUE(warned(resumed_, "negative fraction")) << resumed_["warnings"];
}

// At 0.61 the contacts of this bed hold several times its own potential energy; at 0.57, or where the packing
// is the bed's own, nothing.
TEST_F(RunAlarms, ADenseStartIsSeen) {
  EXPECT_TRUE(warned(record_of({"bed.solid_fraction=0.61", "model.packing=uniform", "time.end=0.02"}),
                     "elastic start"));
  EXPECT_FALSE(warned(record_of({"bed.solid_fraction=0.61", "model.packing=carried", "time.end=0.02"}),
                      "elastic start"));
}

// Fluctuation that nothing has given is cut down to what a fall could give, and that is said.
TEST_F(RunAlarms, FluctuationFromNothingIsSeenInTheBounds) {
  EXPECT_EQ(
      resume_with([](std::vector<double>& theta) { std::fill(theta.begin(), theta.end(), 2.0); }, "theta"),
      0);
  EXPECT_TRUE(warned(resumed_, "granular bounds")) << resumed_["warnings"];
  EXPECT_EQ(
      resume_with([](std::vector<double>& theta) { std::fill(theta.begin(), theta.end(), 1e-9); }, "theta"),
      0);
  EXPECT_FALSE(warned(resumed_, "granular bounds")) << resumed_["warnings"];
}

// Velocities that nothing has given, as after a blow-up that stays finite: the run stops and says why. A
// hundredth of them it goes on with, and says that no term of the budget gave them.
TEST_F(RunAlarms, EnergyFromNothingStopsTheRun) {
  const auto stir = [](double speed) {
    return [=](std::vector<double>& u) {
      for (std::size_t i = 0; i < u.size(); ++i) u[i] = (i / 20) % 2 == 0 ? speed : -speed;
    };
  };
  EXPECT_EQ(resume_with(stir(30.0), "u_c0"), 1);
  EXPECT_TRUE(std::string(resumed_["exit"]["reason"]).starts_with("blow-up")) << resumed_["exit"]["reason"];
  EXPECT_EQ(resume_with(stir(0.3), "u_c0"), 0);
  EXPECT_TRUE(warned(resumed_, "energy residual")) << resumed_["warnings"];
  EXPECT_EQ(resume_with([](std::vector<double>&) {}, "u_c0"), 0);
  EXPECT_FALSE(warned(resumed_, "energy residual")) << resumed_["warnings"];
}

// Fluxes of first order on four cells across a column: they lift as much as physics dissipates. On cells half
// as large, or with limited fluxes, they do not.
TEST_F(RunAlarms, EnergyThatFluxesMakeIsSeen) {
  EXPECT_TRUE(warned(record_of({}), "energy created"));
  EXPECT_FALSE(warned(record_of({"numerics.solid_flux=limited"}), "energy created"));
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

TEST_F(AlarmRules, EachLimitRaisesItsOwnAlarm) {
  EXPECT_TRUE(raised(moving()).empty());
  EXPECT_EQ(stopped_, "");
  struct Wrong {
    const char* monitor;
    double EnergyTerms::*term;
    double below, above;
  };
  for (const Wrong& wrong : {Wrong{"energy residual", &EnergyTerms::residual, 0.009, 0.011},
                             Wrong{"energy created", &EnergyTerms::dilatancy, 0.49, 0.51},
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

TEST_F(RunAlarms, StepsTriedInVainAreSeen) {
  const auto record = [&](const char* name, int newton_max) {
    Scene scene = column_scene();
    scene.numerics.newton_max = newton_max;
    scene.numerics.volume_tolerance = 1e-9;
    EXPECT_EQ(run_into(path(name), scene), 0);
    return json::parse(test::text_of(path(name) / "run.json"));
  };
  const json vain = record("vain", 2);  // fewer than a case may have
  EXPECT_TRUE(warned(vain, "refused steps")) << vain["refused_steps"] << " of " << vain["steps"];
  EXPECT_FALSE(warned(record("enough", 30), "refused steps"));
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
