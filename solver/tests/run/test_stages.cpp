// The stages of a step: what documentation and cost say of them.
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

}  // namespace
}  // namespace granvof
