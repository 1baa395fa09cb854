// The stages of a step: what documentation and cost say of them.
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "solver/run/time_loop.hpp"
#include "solver/scene/load_scene.hpp"
#include "solver/tests/cases_directory.hpp"
#include "solver/tests/simulation.hpp"

namespace granvof {
namespace {

TEST(Stages, ArePrintedInTheTheory) {
  std::string table = "| stage | parts of the model | what it does |\n|---|---|---|\n";
  for (const TimeStep::Stage& stage : TimeStep::stages()) {
    std::string served;
    for (const Part* part : stage.parts) {
      if (part == nullptr) continue;
      const std::string equations = text_of_equations(part->equations);
      served +=
          (served.empty() ? "" : "; ") + std::string(part->name) + (equations.empty() ? "" : ' ' + equations);
    }
    table += fmt::format("| {} | {} | {} |\n", stage.cost, served, stage.does);
  }
  std::ifstream file(cases_directory().parent_path() / "docs/theory/numerics.md");
  std::stringstream page;
  page << file.rdbuf();
  EXPECT_NE(page.str().find(table), std::string::npos) << "docs/theory/numerics.md should hold this table:\n"
                                                       << table;
}

// What is not due is neither run nor in the account of the cost; all the rest is.
TEST(Stages, CostIsThatOfThoseThatAreDue) {
  const auto parts = [](const char* choice) {
    const Scene scene =
        load_scene(cases_directory() / "s1.toml", std::vector<std::string>{"grid.dx=0.01", choice});
    TimeLoop run(scene);
    EXPECT_FALSE(run.advance());
    std::set<std::string> named;
    for (const auto& [part, seconds] : run.cost()) named.insert(part);
    return named;
  };
  std::set<std::string> all;
  for (const TimeStep::Stage& stage : TimeStep::stages()) all.insert(stage.cost);
  const std::set<std::string> with = parts("model.shear_dilatancy=true");
  std::set<std::string> without = parts("model.shear_dilatancy=false");
  EXPECT_EQ(with.count("packing"), 1U);
  EXPECT_EQ(without.count("packing"), 0U);
  without.insert({"packing", "fluid viscosity"});  // which water does not need
  EXPECT_EQ(without, all);
}

// Water that sways, with f_s of one cell as stated: 1e-300 is nothing to any other value, but is there.
std::vector<double> swaying(double of_cell, std::set<std::string>* named, std::string_view choice) {
  test::Simulation run(load_scene(cases_directory() / "sloshing.toml",
                                  std::vector<std::string>{"grid.dx=0.005", std::string(choice)}));
  run.now.f_s[run.cell(3, 3)] = of_cell;
  run.fill_ghosts();
  for (int step = 0; step < 20; ++step) run.advance();
  for (const auto& [part, seconds] : run.cost()) named->insert(part);
  const State& s = run.now;
  std::vector<double> values;
  for_each_field(run.grid, s, [&](const FieldOfState& of, const Field& field) {
    if (of.key() != "f_s") values.insert(values.end(), field.span().begin(), field.span().end());
  });
  for (const EnergyTerm& term : energy_terms) values.push_back(s.energy.*term.value);
  return values;
}

// Of a tank without grains their part of the step is left out, and all else is as with it.
TEST(Stages, WithoutGrainsNothingOfTheirsIsDue) {
  for (const char* choice : {"model.preset=paper", "model.preset=advised", "model.preset=sourced"}) {
    std::set<std::string> parts_with, parts_without;
    const std::vector<double> with = swaying(1e-300, &parts_with, choice),
                              without = swaying(0.0, &parts_without, choice);
    ASSERT_EQ(with.size(), without.size());
    for (std::size_t i = 0; i < with.size(); ++i)
      ASSERT_NEAR(with[i], without[i], 1e-12 * std::fabs(with[i]) + 1e-15) << choice << ", value " << i;
    EXPECT_EQ(parts_with.count("granular temperature"), 1U);
    EXPECT_EQ(parts_without.count("granular temperature"), 0U);
  }
}

}  // namespace
}  // namespace granvof
