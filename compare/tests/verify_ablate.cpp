// Ablation of a tiny collapse with the real program: a table comes out, and a second time nothing is run.
#include <filesystem>
#include <fstream>
#include <optional>

#include <gtest/gtest.h>

#include "compare/checks/table.hpp"
#include "compare/study/ablate.hpp"
#include "compare/study/runner.hpp"
#include "compare/study/study_file.hpp"
#include "solver/tests/cases_directory.hpp"
#include "solver/tests/temporary_directory.hpp"

namespace granvof::compare {
namespace {

namespace fs = std::filesystem;

constexpr const char* checks = R"toml(
[[run]]
id = "canary"
[[check]]
run = "canary"
metric = "run_out"
at = 2
reference = { kind = "DEM", record = "canary" }
tolerance = { absolute = 0.05, unit = "-" }
frequency = "verify"
[[check]]
run = "canary"
metric = "solid_volume_error"
reference = { kind = "theory", value = 0, source = "eq (1)" }
tolerance = { absolute = 1e-12, unit = "-" }
frequency = "verify"
)toml";

constexpr const char* study = R"toml(
[[method]]
name = "plain"
[[part]]
name = "no friction"
set = ["model.contact_friction=false"]
[[part]]
name = "no colour"
set = ["model.colour=false"]
[[part]]
name = "rigid lid"
form = "rigid lid"
[[part]]
name = "nonsense"
set = ["model.colour=7"]
)toml";

TEST(Ablate, TellsPartsThatMatterFromPartsThatDoNot) {
  const test::TemporaryDirectory root;
  const fs::path file = cases_directory() / "canary.toml";
  const fs::path records = cases_directory() / "../reference/results";
  const std::vector<std::string> set{"grid.dx=0.005", "time.end=2", "output.field_times=[0]"};
  RunnerOptions options{GRANVOF_PROGRAM, root.path()};
  options.progress = false;
  options.timings = 1;
  std::optional<CachedRunner> first(std::in_place, options);
  CachedRunner& runner = *first;
  const auto metrics = metrics_of_scene(parse_table(checks, "checks"), "canary");
  ASSERT_EQ(metrics.size(), 2u);
  const auto parts = parse_study(study, "study").parts;
  const AblateReport report = ablate(file, set, parts, metrics, records, runner);
  ASSERT_EQ(report.rows.size(), 5u);

  EXPECT_NEAR(report.metrics[0].reference.value_or(0.0), 0.2, 0.15);  // mean of the recorded seeds
  EXPECT_EQ(report.metrics[1].reference, 0.0);

  const Ablation& friction = report.rows[1];
  ASSERT_TRUE(friction.failure.empty()) << friction.failure;
  EXPECT_GT(*friction.effects[0].change, 0.1);  // without friction it runs further
  EXPECT_TRUE(friction.effects[0].beyond);
  EXPECT_FALSE(friction.dispensable());
  EXPECT_FALSE(friction.effects[1].beyond);

  const Ablation& colour = report.rows[2];
  EXPECT_EQ(*colour.effects[0].change, 0.0);
  EXPECT_TRUE(colour.dispensable());
  EXPECT_GT(colour.cost, 0.0);
  EXPECT_GT(colour.work, 0.0);

  // A gate that stands for a while shuts its side of the tank under a lid: that is another release.
  EXPECT_FALSE(report.rows[3].applies);
  EXPECT_NE(report.rows[3].failure.find("gate"), std::string::npos) << report.rows[3].failure;
  EXPECT_FALSE(report.rows[4].applies);
  EXPECT_NE(report.rows[4].failure.find("model.colour"), std::string::npos) << report.rows[4].failure;

  std::vector<std::string> fast = set;
  fast.emplace_back("gate.speed=20");
  const AblateReport lid = ablate(file, fast, {parts[2]}, metrics, records, runner);
  EXPECT_TRUE(lid.rows[1].applies) << lid.rows[1].failure;
  EXPECT_TRUE(lid.rows[1].failure.empty()) << lid.rows[1].failure;

  const std::string text = ablate_text(report);
  for (const char* word : {"run_out@2", "no friction", "changes run_out@2", "no metric beyond its tolerance"})
    EXPECT_NE(text.find(word), std::string::npos) << word << "\n" << text;

  // Any metric or curve of any scene, without a row of its own.
  const Quantity curve = parse_quantity("run_out", std::nullopt);
  const Quantity at = parse_quantity("deposit_height@2", std::nullopt);
  const AblateReport asked =
      ablate(file, set, {parts[0], parts[1]}, {check_of(at, 0.05, {})}, records, runner, {curve}, 0.05);
  ASSERT_EQ(asked.metrics.size(), 2u);
  EXPECT_DOUBLE_EQ(asked.rows[1].effects[0].tolerance, 0.05 * *asked.metrics[0].full);
  EXPECT_GT(*asked.rows[1].effects[1].change, 0.05);
  EXPECT_TRUE(asked.rows[1].effects[1].beyond);
  EXPECT_EQ(*asked.rows[2].effects[1].change, 0.0);
  EXPECT_FALSE(asked.rows[2].effects[1].beyond);
  EXPECT_NE(ablate_text(asked).find("run_out (curve)"), std::string::npos);
  EXPECT_THROW(ablate(file, set, parts, {}, records, runner), std::runtime_error);

  first.reset();  // one study at a time has the cache
  CachedRunner again(options);
  EXPECT_TRUE(again.run({file, set}).kept);
}

}  // namespace
}  // namespace granvof::compare
