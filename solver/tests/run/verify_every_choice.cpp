// Every choice of the model and of the numerics, one at a time: it runs, keeps the volumes, and does
// something.
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "solver/scene/case_error.hpp"
#include "solver/tests/run/key_changes.hpp"
#include "solver/tests/run/small_runs.hpp"
#include "solver/tests/temporary_directory.hpp"

namespace granvof::test {
namespace {

// The series of a scene and its fields (colour is in no column), once its record has been looked at.
std::string outcome(const std::filesystem::path& run, const Scene& scene) {
  EXPECT_EQ(run_into(run, scene), 0) << run;
  const auto record = nlohmann::json::parse(text_of(run / "run.json"));
  for (const char* error : {"solid_volume_error", "liquid_volume_error"})
    EXPECT_LT(record[error].get<double>(), 1e-12) << error << " of " << run;
  return text_of(run / "series.csv") + text_of(run / "fields.h5");
}

TEST(EveryChoice, RunsKeepsVolumesAndDoesSomething) {
  const TemporaryDirectory directory;
  const std::vector<std::string> until{fmt::format("time.end={}", until_all_work), "output.field_times=[0]",
                                       fmt::format("output.series_interval={}", 0.5 * until_all_work)};
  const auto scene_with = [&](const std::string& set) {
    std::vector<std::string> sets = until;
    if (!set.empty()) sets.push_back(set);
    return scene_at_work(sets);
  };
  const Scene base = scene_with("");
  const std::string usual = outcome(directory.path() / "usual", base);
  int tried = 0, idle = 0;
  for (const Change& change : changes_at_work()) {
    std::optional<Scene> scene;
    try {
      scene = scene_with(change.set);
    } catch (const CaseError&) {
      continue;  // it does not go with the others
    }
    ++tried;
    const std::string changed = outcome(directory.path() / std::to_string(tried), *scene);
    if (said_of(change.key, {&base, &*scene}).starts_with("it has no effect")) {
      ++idle;
      EXPECT_TRUE(changed == usual) << change.set;
    } else {
      EXPECT_TRUE(changed != usual) << change.set << " changes nothing, and nothing says so";
    }
  }
  EXPECT_GT(tried, 40);
  EXPECT_LT(idle, 5);
}

}  // namespace
}  // namespace granvof::test
