// Output watches a run and does not steer it: rows and fields are there at the times asked for, between the
// states of the flow's own steps, and whatever else is asked for leaves them as they are, bit for bit.
#include <map>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "solver/output/extract.hpp"
#include "solver/output/fields_file.hpp"
#include "solver/output/series_file.hpp"
#include "solver/run/snapshot.hpp"
#include "solver/state/energy_terms.hpp"
#include "solver/tests/output/samples.hpp"
#include "solver/tests/run/small_runs.hpp"

namespace granvof {
namespace {

using nlohmann::json;
using test::column_scene;
using test::run_into;
using test::text_of;

class OutputTimes : public ::testing::Test {
 protected:
  std::filesystem::path run(const std::string& name, const Scene& scene, bool resume = false) const {
    const auto path = directory_.path() / name;
    EXPECT_EQ(run_into(path, scene, resume), 0) << name;
    return path;
  }

 private:
  test::TemporaryDirectory directory_;
};

// The text of each row by that of its time.
std::map<std::string, std::string> rows_of(const std::filesystem::path& run) {
  std::map<std::string, std::string> rows;
  std::istringstream lines(text_of(run / "series.csv"));
  for (std::string line; std::getline(lines, line);) rows[line.substr(0, line.find(','))] = line;
  return rows;
}

int steps_of(const std::filesystem::path& run) {
  return json::parse(text_of(run / "run.json"))["steps"];
}

// Every row and instant that `few` has, `many` has too, and the same in every digit.
void expect_part_of(const std::filesystem::path& few, const std::filesystem::path& many) {
  const auto ours = rows_of(few), theirs = rows_of(many);
  for (const auto& [time, row] : ours) {
    ASSERT_TRUE(theirs.contains(time)) << time;
    EXPECT_EQ(row, theirs.at(time));
  }
  const auto times = read_field_times(few / "fields.h5"), all = read_field_times(many / "fields.h5");
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto found = std::find(all.begin(), all.end(), times[i]);
    ASSERT_NE(found, all.end()) << times[i];
    const CellFields a = read_fields(few / "fields.h5", i),
                     b = read_fields(many / "fields.h5", static_cast<std::size_t>(found - all.begin()));
    EXPECT_EQ(a.f_s, b.f_s) << times[i];
    EXPECT_EQ(a.p_c, b.p_c) << times[i];
    EXPECT_EQ(a.u_s, b.u_s) << times[i];
  }
}

// Rows far closer than the steps (about 2 ms), fields at times of their own.
const std::vector<std::string> much{"output.series_interval=0.0005", "output.field_interval=0.0007"};

std::vector<std::string> with(std::vector<std::string> overrides, const std::vector<std::string>& more) {
  overrides.insert(overrides.end(), more.begin(), more.end());
  return overrides;
}

TEST_F(OutputTimes, MoreOutputLeavesTheRunAsItIs) {
  for (const std::vector<std::string>& choice : {std::vector<std::string>{},
                                                 {"time.hold=0.01"},
                                                 {"gate.speed=0.1", "output.field_times=[0, 0.0333]"}}) {
    const std::string name = choice.empty() ? "" : choice.front();
    const auto few = run("few" + name, column_scene(choice));
    const auto many = run("many" + name, column_scene(with(choice, {"output.series_interval=0.0005"})));
    EXPECT_EQ(steps_of(few), steps_of(many));
    EXPECT_EQ(rows_of(few).size(), 12U);  // with the header
    EXPECT_EQ(rows_of(many).size(), 202U);
    expect_part_of(few, many);
  }
  const auto few = run("few-fields", column_scene());
  const auto many = run("many-fields", column_scene({"output.field_interval=0.0005"}));
  EXPECT_EQ(steps_of(few), steps_of(many));
  EXPECT_EQ(text_of(few / "series.csv"), text_of(many / "series.csv"));
  expect_part_of(few, many);
}

TEST_F(OutputTimes, TheEndIsNoEventOfTheFlow) {
  const auto half = run("half", column_scene({"time.end=0.05"})), whole = run("whole", column_scene());
  expect_part_of(half, whole);
  // and an end between two rows adds a row of its own, nothing else
  const auto odd = rows_of(run("odd", column_scene({"time.end=0.0437"})));
  const auto all = rows_of(whole);
  EXPECT_EQ(odd.size(), 7U);
  EXPECT_EQ(odd.count("0.0437"), 1U);
  for (const auto& [time, row] : odd)
    if (time != "0.0437") {
      EXPECT_EQ(row, all.at(time));
    }
}

TEST_F(OutputTimes, EveryRowAndFieldAtItsTimeToTheLastDigit) {
  const auto path = run("run", column_scene(with({"time.end=0.02"}, much)));
  const auto times = read_series(path / "series.csv").column("time");
  ASSERT_EQ(times.size(), 41U);
  for (std::size_t k = 0; k < times.size(); ++k)
    EXPECT_EQ(*times[k], std::stod(fmt::format("{}e-4", 5 * k))) << k;  // as a person writes it
  const auto fields = read_field_times(path / "fields.h5");
  ASSERT_EQ(fields.size(), 30U);
  for (std::size_t k = 0; k + 1 < fields.size(); ++k)
    EXPECT_EQ(fields[k], std::stod(fmt::format("{}e-4", 7 * k))) << k;
  EXPECT_EQ(fields.back(), 0.02);
}

// Fields hold single precision; a row at the same time is of the same state.
TEST_F(OutputTimes, RowsAndFieldsOfOneTimeAreOfOneState) {
  const Scene scene = column_scene({"output.field_interval=0.01"});
  const auto path = run("run", scene);
  const Series series = read_series(path / "series.csv");
  ASSERT_EQ(read_field_times(path / "fields.h5").size(), series.rows.size());
  for (std::size_t i = 0; i < series.rows.size(); ++i) {
    const CellFields fields = read_fields(path / "fields.h5", i);
    const std::set<std::string_view> names{"front_dilute", "y_solid_mean", "u_s_max", "p_base",
                                           "liquid_volume"};
    std::size_t compared = 0;
    for (const ScalarEntry& entry : scalar_table()) {
      if (!names.contains(entry.name)) continue;
      const double row = *series.column(entry.name)[i];
      EXPECT_NEAR(*entry.function(fields, scene), row, 1e-5 * std::fabs(row) + 1e-9) << entry.name << i;
      ++compared;
    }
    EXPECT_EQ(compared, names.size());
  }
}

// The ledger's columns are those of the accepted states, interpolated: the budget closes on every row.
TEST_F(OutputTimes, VolumesAndEnergyCloseOnEveryRow) {
  const auto path = run("run", column_scene(with({"numerics.volume_tolerance=1e-9"}, much)));
  const Series series = read_series(path / "series.csv");
  const auto value = [&](std::size_t row, const char* name) { return *series.column(name)[row]; };
  const double moved = value(0, "energy_potential") - value(series.rows.size() - 1, "energy_potential");
  ASSERT_GT(moved, 0.0);
  const double stored = value(0, "energy_kinetic") + value(0, "energy_potential") +
                        value(0, "energy_granular") + value(0, "energy_elastic");
  for (std::size_t i = 0; i < series.rows.size(); ++i) {
    double open = -stored;
    for (const EnergyTerm& term : energy_terms) {
      open += term.sign * value(i, term.name);
    }
    EXPECT_NEAR(open, 0.0, 1e-9 * moved) << i;
    EXPECT_NEAR(value(i, "liquid_volume"), value(0, "liquid_volume"), 1e-9 * value(0, "liquid_volume")) << i;
  }
}

TEST_F(OutputTimes, ResumedBetweenTwoRowsOfOneStepIsTheSameRun) {
  const Scene whole = column_scene(much);
  const auto a = run("whole", whole);
  const Scene half = column_scene(with({"time.end=0.0511"}, much));  // no row and no field of the whole
  const auto b = run("parts", half);
  run("parts", whole, true);
  EXPECT_EQ(text_of(a / "series.csv"), text_of(b / "series.csv"));
  EXPECT_EQ(read_field_times(a / "fields.h5"), read_field_times(b / "fields.h5"));
  expect_part_of(a, b);
  EXPECT_EQ(steps_of(a), steps_of(b));
}

TEST(Interpolation, IsAMeanOfTwoStatesThatKeepsTheirVolumes) {
  test::Simulation run(column_scene());
  State earlier = run.now, later = run.now;
  earlier.time = 1.0;
  later.time = 3.0;
  double number = 0.0;
  for (State* state : {&earlier, &later})
    for (Field* field : {&state->f_s, &state->alpha, &state->theta, &state->phi, &state->p_c, &state->u_s[0]})
      for (double& value : field->span()) value = 0.3 * (1.0 + std::sin(number += 1.0));
  for (double& value : earlier.alpha.span()) value = 1.0;
  earlier.energy.drag = 4.0;
  later.energy.drag = 8.0;
  const CellFields a = cell_fields(run.grid, earlier), b = cell_fields(run.grid, later);
  const CellFields at = cell_fields(run.grid, earlier, later, 1.5);  // a quarter of the way
  EXPECT_EQ(at.time, 1.5);
  for (std::size_t c = 0; c < at.f_s.size(); ++c) {
    EXPECT_NEAR(at.f_s[c], 0.75 * a.f_s[c] + 0.25 * b.f_s[c], 1e-15);
    EXPECT_NEAR(at.p_c[c], 0.75 * a.p_c[c] + 0.25 * b.p_c[c], 1e-15);
    EXPECT_NEAR(at.u_s[0][c], 0.75 * a.u_s[0][c] + 0.25 * b.u_s[0][c], 1e-15);
    const auto liquid = [&](const CellFields& f) { return f.alpha[c] * (1.0 - f.f_s[c]); };
    EXPECT_NEAR(liquid(at), 0.75 * liquid(a) + 0.25 * liquid(b), 1e-15);
    EXPECT_NEAR(at.theta[c] * at.f_s[c], 0.75 * a.theta[c] * a.f_s[c] + 0.25 * b.theta[c] * b.f_s[c], 1e-15);
    EXPECT_LE(at.alpha[c], 1.0);
    EXPECT_GE(at.alpha[c], std::min(a.alpha[c], b.alpha[c]));
  }
  EXPECT_EQ(cell_fields(run.grid, earlier, later, 3.0).f_s, b.f_s);
  EXPECT_EQ(cell_fields(run.grid, earlier, later, 3.0).alpha, b.alpha);
  EXPECT_EQ(energy_terms_at(earlier, later, 1.5).drag, 5.0);
}

}  // namespace
}  // namespace granvof
