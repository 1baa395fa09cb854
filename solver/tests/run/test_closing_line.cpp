// The line with which a run ends, and the log of its messages.
#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "solver/plausibility/plausibility.hpp"
#include "solver/run/closing_line.hpp"
#include "solver/tests/run/small_runs.hpp"
#include "solver/tests/temporary_directory.hpp"

namespace granvof {
namespace {

using test::column_scene;
using test::run_into;
using test::text_of;

Scalars scalars_of(double front_dense, double liquid_front) {
  Scalars end(scalar_table().size());
  for (std::size_t i = 0; i < end.size(); ++i) {
    if (scalar_table()[i].name == "front_dense") end[i] = front_dense;
    if (scalar_table()[i].name == "liquid_front") end[i] = liquid_front;
  }
  return end;
}

RunProgress some_progress() {
  RunProgress progress;
  progress.simulated_time = 0.70001;
  progress.core_seconds = 3.14159;
  progress.steps = 12;
  progress.cells = 128;
  return progress;
}

TEST(ClosingLine, SaysResultsCostWarningsAndWhatIsNext) {
  RunProgress progress = some_progress();
  EXPECT_EQ(closing_line(column_scene(), progress, scalars_of(0.123456, 0.5), "out/runs/column"),
            "column: finished, t = 0.7 s: front_dense 0.1235 m; 3.14 core-seconds, 12 steps of 128 cells; "
            "no warnings; next: granvof report out/runs/column");
  progress.warnings = {{"energy residual", 0.1, 0.2, 0.01, "so"}, {"friction solves", 0.1, 2, 1, "so"}};
  EXPECT_NE(closing_line(column_scene(), progress, scalars_of(0.1, 0.5), "a")
                .find("2 warnings: energy residual, friction solves; next"),
            std::string::npos);
}

// A run without warnings of a case that has some does not end in "no warnings" alone.
TEST(ClosingLine, CountsWhatIsSaidAboutTheCase) {
  const Scene scene = column_scene({"liquid.viscosity=1e-6"});
  ASSERT_EQ(plausibility(scene).size(), 1u);
  EXPECT_NE(closing_line(scene, some_progress(), scalars_of(0.1, 0.5), "a")
                .find("; no warnings; 1 warning about the case; next"),
            std::string::npos);
}

TEST(ClosingLine, WithoutGrainsSaysTheLiquids) {
  Scene scene = column_scene();
  scene.bed.reset();
  const std::string line = closing_line(scene, some_progress(), scalars_of(0.1, 0.5), "a");
  EXPECT_NE(line.find("s: liquid_front 0.5 m; 3.14"), std::string::npos) << line;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(RunLog, HoldsEveryMessageAndAResumedRunAddsToIt) {
  const test::TemporaryDirectory temporary;
  const auto out = temporary.path() / "run";
  ASSERT_EQ(run_into(out, column_scene({"time.end=0.02", "output.field_times=[]"})), 0);
  const std::string first = text_of(out / "run.log");
  EXPECT_EQ(count(first, "column: finished, t = 0.02 s"), 1U) << first;
  EXPECT_EQ(count(first, "1 thread: test"), 1U) << first;
  EXPECT_TRUE(first.ends_with(out.string() + "\n")) << first;
  ASSERT_EQ(run_into(out, column_scene({"time.end=0.03", "output.field_times=[]"}), true), 0);
  const std::string both = text_of(out / "run.log");
  EXPECT_TRUE(both.starts_with(first));
  EXPECT_EQ(count(both, "finished"), 2U) << both;
  ASSERT_EQ(run_into(out, column_scene({"time.end=0.03", "output.field_times=[]"})), 0);  // anew
  EXPECT_EQ(count(text_of(out / "run.log"), "finished"), 1U);
}

// Opening a pipe would wait for a reader for ever.
TEST(RunLog, IsNoPipe) {
  const test::TemporaryDirectory temporary;
  const auto out = temporary.path() / "run";
  ASSERT_EQ(run_into(out, column_scene({"time.end=0.02", "output.field_times=[]"})), 0);
  std::filesystem::remove(out / "run.log");
  ASSERT_EQ(::mkfifo((out / "run.log").c_str(), 0600), 0);
  EXPECT_EQ(run_into(out, column_scene({"time.end=0.03", "output.field_times=[]"}), true), 1);
  EXPECT_NE(text_of(out / "run.json").find("it is a device or a pipe"), std::string::npos);
}

}  // namespace
}  // namespace granvof
