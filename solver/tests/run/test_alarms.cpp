// Silent wrong answers: each is provoked here, and must be seen by the monitor that is there for it.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "solver/output/checkpoint.hpp"
#include "solver/run/alarms.hpp"
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
    EXPECT_EQ(run_into(directory_.path() / "run", column_scene(overrides)), 0);
    return json::parse(test::text_of(directory_.path() / "run" / "run.json"));
  }
  std::filesystem::path path(const char* name) const { return directory_.path() / name; }
  static bool warned(const json& record, const char* monitor) {
    return std::any_of(record["warnings"].begin(), record["warnings"].end(),
                       [&](const json& w) { return w["monitor"] == monitor && w["value"] > w["limit"]; });
  }

 private:
  test::TemporaryDirectory directory_;
};

TEST_F(RunAlarms, ASoundRunRaisesNone) {
  EXPECT_EQ(record_of({})["warnings"], json::array());
  EXPECT_EQ(record_of({"numerics.solid_flux=limited"})["warnings"], json::array());
}

// A loose tolerance: liquid is no longer conserved.
TEST_F(RunAlarms, LooseToleranceIsSeenInTheLiquidVolume) {
  EXPECT_TRUE(warned(record_of({"numerics.volume_tolerance=1e-2", "numerics.linear_tolerance=0.5"}),
                     "liquid volume"));
}

// Contacts that are too soft for the load: the bed is pressed beyond its largest packing.
TEST_F(RunAlarms, SoftContactIsSeenInThePacking) {
  EXPECT_TRUE(warned(record_of({"contact.stiffness=10", "contact.solid_fraction_max=0.575",
                                "contact.dense_solid_fraction=0.575"}),
                     "solid fraction"));
}

// Velocities that nothing has given, as after a blow-up that stays finite: the run stops and says why.
TEST_F(RunAlarms, EnergyFromNothingStopsTheRun) {
  const Scene half = column_scene({"time.end=0.02"}), whole = column_scene({"time.end=0.04"});
  ASSERT_EQ(run_into(path("run"), half), 0);
  Checkpoint saved = read_checkpoint(path("run") / "checkpoint.h5", half);
  CheckpointView view{saved.time, {}, saved.scalars, saved.counters};
  for (double& theta : saved.arrays.at("theta")) theta = 1e6;
  for (const auto& [key, array] : saved.arrays) view.arrays[key] = array;
  write_checkpoint(path("run") / "checkpoint.h5", half, view);
  const int code = run_into(path("run"), whole, true);
  const json record = json::parse(test::text_of(path("run") / "run.json"));
  EXPECT_TRUE(code == 1 || warned(record, "granular bounds")) << record["exit"]["reason"];
}

// The rules themselves, each limit alone.
class AlarmRules : public ::testing::Test {
 protected:
  AlarmRules()
      : grid_(scene_),
        boundary_(grid_, scene_, communicator_),
        state_(initial_state(grid_, scene_, boundary_)) {
    state_.energy.kinetic = 1.0;  // so that shares of the turnover mean something
  }
  std::vector<Warning> raised(const EnergyTerms& energy, std::int64_t unconverged = 0) {
    Alarms alarms(scene_, start());
    state_.energy = energy;
    stopped_ = alarms.check(state_, Monitors(grid_, scene_, state_), {100, unconverged});
    return alarms.raised();
  }
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
  SerialCommunicator communicator_;
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

TEST_F(AlarmRules, MoreEnergyInMotionThanWasEverGivenStops) {
  EnergyTerms energy = moving();
  energy.kinetic = 99.0;
  raised(energy);
  EXPECT_EQ(stopped_, "");
  energy.kinetic = 101.0;
  raised(energy);
  EXPECT_NE(stopped_.find("blow-up"), std::string::npos) << stopped_;
}

}  // namespace
}  // namespace granvof
