// The parts of the model: nothing is without one, and what documentation and a run say of them is what there
// is.
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "solver/run/alarms.hpp"
#include "solver/run/monitor_table.hpp"
#include "solver/scene/keys.hpp"
#include "solver/tests/cases_directory.hpp"
#include "solver/tests/run/small_runs.hpp"
#include "solver/tests/temporary_directory.hpp"

namespace granvof {
namespace {

using case_file::Key;
using case_file::keys;

const std::filesystem::path root = cases_directory().parent_path();

std::string page_of(const Part& part) {
  return test::text_of(root / part.page);
}
std::string file_of(const std::string& path) {
  return path.substr(path.rfind('/') + 1);
}
// Keys of all sides are one.
std::string name_on_a_page(const Key& key) {
  std::string name = key.name;
  if (key.table() == "walls") name.replace(0, std::string("walls.left").size(), "walls.SIDE");
  return name;
}

struct Owned {
  std::vector<std::string> keys, ledger, monitors, stages;
  bool empty() const { return keys.empty() && ledger.empty() && monitors.empty() && stages.empty(); }
};
Owned owned_by(const Part& part) {
  Owned owned;
  for (const Key& key : keys())
    if (key.part == &part && key.documented) owned.keys.push_back(name_on_a_page(key));
  for (const EnergyTerm& term : energy_terms)
    if (&term.part == &part) owned.ledger.emplace_back(term.name);
  for (const auto& list : {monitors_of_a_step(), monitors_of_a_run()})
    for (const MonitorEntry& monitor : list)
      if (&monitor.part == &part) owned.monitors.emplace_back(monitor.name);
  for (const Alarm& alarm : Alarms::list())
    if (&alarm.part == &part) owned.monitors.emplace_back(alarm.monitor);
  std::set<std::string> stages;
  for (const TimeStep::Stage& stage : TimeStep::stages())
    for (const Part* served : stage.parts)
      if (served == &part && stages.insert(stage.cost).second) owned.stages.emplace_back(stage.cost);
  return owned;
}

std::string cell(const std::vector<std::string>& names, const char* quote) {
  std::string text;
  for (const std::string& name : names)
    text += fmt::format("{}{}{}{}", text.empty() ? "" : ", ", quote, name, quote);
  return text;
}

TEST(Parts, EveryKeyIsOfOne) {
  for (const Key& key : keys()) {
    ASSERT_NE(key.part, nullptr) << key.name;
    EXPECT_EQ(std::ranges::count(all_parts(), key.part), 1) << key.name;
  }
}

TEST(Parts, EachHasSomethingToItsName) {
  std::set<std::string> names;
  for (const Part* part : all_parts()) {
    EXPECT_TRUE(names.insert(part->name).second) << part->name << " is there twice";
    EXPECT_FALSE(owned_by(*part).empty()) << part->name << " owns nothing";
  }
}

TEST(Parts, EachEquationOfTheModelIsOfOne) {
  constexpr int last_of_the_model = 25;  // (26) and (27) are metrics
  std::vector<int> equations;
  for (const Part* part : all_parts())
    for (const int equation : part->equations)
      if (equation != 0) equations.push_back(equation);
  std::ranges::sort(equations);
  ASSERT_EQ(equations.size(), last_of_the_model);
  for (int i = 0; i < last_of_the_model; ++i) EXPECT_EQ(equations[static_cast<std::size_t>(i)], i + 1);
}

TEST(Parts, AnEquationIsOnThePageOfItsPart) {
  for (const Part* part : all_parts()) {
    for (const int equation : part->equations) {
      if (equation == 0) continue;
      EXPECT_NE(page_of(*part).find(fmt::format("\n## ({}) ", equation)), std::string::npos)
          << part->name << ": " << part->page << " has no section of (" << equation << ')';
    }
  }
}

TEST(Parts, PageAndCodeAreThere) {
  for (const Part* part : all_parts())
    for (const char* path : {part->page, part->code})
      EXPECT_TRUE(std::filesystem::exists(root / path)) << part->name << ": " << path;
}

// Of a part of the theory every key is explained where it is, or with the choices beside the paper's model.
TEST(Parts, AKeyIsOnThePageOfItsPart) {
  const std::string choices = page_of(parts::packing);
  for (const Key& key : keys()) {
    if (!key.documented || !std::string(key.part->page).starts_with("docs/theory")) continue;
    const std::string quoted = '`' + name_on_a_page(key);
    EXPECT_TRUE(page_of(*key.part).find(quoted) != std::string::npos ||
                choices.find(quoted) != std::string::npos)
        << key.part->page << " does not name `" << name_on_a_page(key) << '`';
  }
}

TEST(Parts, ArePrintedInTheTheory) {
  std::string table =
      "| part | equations | code | stages of a step | ledger | monitors | keys "
      "|\n|---|---|---|---|---|---|---|\n";
  for (const Part* part : all_parts()) {
    const Owned owned = owned_by(*part);
    table += fmt::format("| [{}](../../{}) | {} | [{}](../../{}) | {} | {} | {} | {} |\n", part->name,
                         part->page, text_of_equations(part->equations), file_of(part->code), part->code,
                         cell(owned.stages, ""), cell(owned.ledger, "`"), cell(owned.monitors, "`"),
                         cell(owned.keys, "`"));
  }
  EXPECT_NE(test::text_of(root / "docs/theory/README.md").find(table), std::string::npos)
      << "docs/theory/README.md should hold this table:\n"
      << table;
}

TEST(Parts, MonitorsArePrintedWithTheOutput) {
  std::string table = "| monitor | where | unit | of | meaning |\n|---|---|---|---|---|\n";
  const auto add = [&](std::span<const MonitorEntry> list, const char* where) {
    for (const MonitorEntry& monitor : list)
      table += fmt::format("| `{}` | {} | {} | {} | {} |\n", monitor.name, where, monitor.unit,
                           monitor.part.name, monitor.meaning);
  };
  add(monitors_of_a_step(), "series.csv");
  add(monitors_of_a_run(), "run.json");
  for (const Alarm& alarm : Alarms::list())
    table +=
        fmt::format("| `{}` | warnings | - | {} | {} |\n", alarm.monitor, alarm.part.name, alarm.meaning);
  EXPECT_NE(test::text_of(root / "docs/output.md").find(table), std::string::npos)
      << "docs/output.md should hold this table:\n"
      << table;
}

TEST(Parts, NamesOfMonitorsAreTakenOnce) {
  for (const auto& list : {monitors_of_a_step(), monitors_of_a_run()}) {
    std::set<std::string> names;
    for (const EnergyTerm& term : energy_terms) names.insert(term.name);
    for (const MonitorEntry& monitor : list) EXPECT_TRUE(names.insert(monitor.name).second) << monitor.name;
  }
}

// Those that a scene does without.
std::set<std::string> without(const std::vector<std::string>& overrides) {
  std::set<std::string> names;
  for (const Part* part : parts_of_model(test::column_scene(overrides)).rest) names.insert(part->name);
  return names;
}

TEST(Parts, ActWhereTheSceneHasThem) {
  const std::set<std::string> usual = without({});
  const auto also_without = [&](const std::vector<std::string>& overrides) {
    std::set<std::string> more = without(overrides);
    for (const std::string& name : usual) EXPECT_EQ(more.erase(name), 1U) << name;
    return more;
  };
  using Names = std::set<std::string>;
  EXPECT_EQ(also_without({"model.drag=false"}), Names{"drag"});
  EXPECT_EQ(also_without({"model.contact_friction=false"}), Names{"friction"});
  EXPECT_EQ(also_without({"model.kinetic_viscosity=false"}),
            (Names{"kinetic stress", "granular temperature"}));
  EXPECT_EQ(also_without({"model.granular_temperature=off"}),
            (Names{"kinetic stress", "granular temperature"}));
  EXPECT_EQ(also_without({"liquid=false"}), Names{"interface"});
  EXPECT_EQ(usual.count("viscous contacts"), 1U);
  EXPECT_EQ(without({"model.suspension_viscosity=true"}).count("viscous contacts"), 0U);
  EXPECT_EQ(without({"model.shear_dilatancy=true"}).count("packing"), 0U);
  EXPECT_EQ(without({"numerics.bed_surface=whole-cells"}).count("bed surface"), 1U);
  EXPECT_EQ(without({"numerics.bed_surface=part-cells"}).count("bed surface"), 0U);
  EXPECT_EQ(usual.count("obstacles") + usual.count("inlets") + usual.count("outlets"), 3U);
}

// A tank that is empty at the start.
TEST(Parts, ActOnWhatComesInToo) {
  Scene scene = test::column_scene();
  scene.bed.reset();
  scene.liquid_boxes.clear();
  EXPECT_FALSE(has_grains(scene) || has_liquid(scene));
  scene.sides[left].kind = SideKind::inlet;
  EXPECT_FALSE(has_grains(scene) || has_liquid(scene));  // of the gas alone
  scene.sides[left].inflow.liquid_share = 1.0;
  EXPECT_TRUE(has_liquid(scene) && !has_grains(scene));
  scene.sides[left].inflow.solid_fraction = 0.1;
  EXPECT_TRUE(has_grains(scene));
  scene.sides[left] = {};
  scene.sides[right].kind = SideKind::outlet;
  EXPECT_FALSE(has_liquid(scene));
  scene.sides[right].outflow.level = 0.01;  // liquid stands beyond it
  EXPECT_TRUE(has_liquid(scene));
}

TEST(Parts, StandInTheRecordOfARun) {
  const test::TemporaryDirectory directory;
  const Scene scene = test::column_scene({"time.end=0.01", "model.drag=false"});
  EXPECT_EQ(test::run_into(directory.path() / "run", scene), 0);
  const auto record = nlohmann::json::parse(test::text_of(directory.path() / "run" / "run.json"));
  std::vector<std::string> stated, expected;
  for (const auto& part : record["parts"]) stated.push_back(part["name"]);
  for (const Part* part : parts_of_model(scene).act) expected.emplace_back(part->name);
  EXPECT_EQ(stated, expected);
  for (std::size_t i = 0; i < energy_terms.size(); ++i)
    EXPECT_EQ(record["ledger"][i]["part"], energy_terms[i].part.name);
}

TEST(Parts, EquationsAreListedInRuns) {
  EXPECT_EQ(text_of_equations(std::array{1, 25, 0}), "(1), (25)");
  EXPECT_EQ(text_of_equations(std::array{8, 9}), "(8), (9)");
  EXPECT_EQ(text_of_equations(std::array{11, 16, 18, 19, 20, 21}), "(11), (16), (18)-(21)");
  EXPECT_EQ(text_of_equations(std::array{0, 0}), "");
}

}  // namespace
}  // namespace granvof
