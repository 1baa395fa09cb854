// What the documentation lists is what there is in the code.
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "solver/closures/critical_packing/laws.hpp"
#include "solver/closures/drag/laws.hpp"
#include "solver/closures/friction/laws.hpp"
#include "solver/closures/granular_temperature/laws.hpp"
#include "solver/closures/kinetic_transport/laws.hpp"
#include "solver/closures/packing/laws.hpp"
#include "solver/closures/radial_distribution/laws.hpp"
#include "solver/closures/slope_limiter/laws.hpp"
#include "solver/output/extract.hpp"
#include "solver/scene/keys.hpp"
#include "solver/scene/presets.hpp"
#include "solver/tests/cases_directory.hpp"

namespace granvof {
namespace {

std::string page(const char* name) {
  std::ifstream file(cases_directory().parent_path() / "docs" / name);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(Docs, ListsTheColumnsOfTheSeries) {
  std::string table = "| column | unit | meaning |\n|---|---|---|\n";
  for (const ScalarEntry& entry : scalar_table())
    table += fmt::format("| {} | {} | {} |\n", entry.name, entry.unit, entry.description);
  EXPECT_NE(page("output.md").find(table), std::string::npos) << "docs/output.md should hold this table:\n"
                                                              << table;
}

TEST(Docs, HasARowForEachLawOfDrag) {
  const std::string text = page("theory/drag.md");
  for (const closures::ClosureFacts& law : closures::DragLaws::facts)
    EXPECT_NE(text.find(fmt::format("| [{}](", law.word)), std::string::npos) << law.word;
}

// As the words of a case file: "word"` with or without its key before it.
template <typename List>
void expect_each_word_in(const std::string& text) {
  for (const closures::ClosureFacts& law : List::facts)
    EXPECT_NE(text.find(fmt::format("\"{}\"`", law.word)), std::string::npos) << law.word;
}

TEST(Docs, NamesEachOtherLawOfAList) {
  const std::string text = page("theory/choices.md");
  expect_each_word_in<closures::FrictionLaws>(text);
  expect_each_word_in<closures::RadialDistributions>(text);
  expect_each_word_in<closures::KineticTransports>(text);
  expect_each_word_in<closures::Packings>(text);
  expect_each_word_in<closures::CriticalPackings>(text);
  expect_each_word_in<closures::SlopeLimiters>(text);
  const std::string kinetic_theory = page("theory/kinetic-theory.md");
  for (const closures::ClosureFacts& model : closures::TemperatureModels::facts)
    EXPECT_NE(kinetic_theory.find(fmt::format("`{}`", model.word)), std::string::npos) << model.word;
}

TEST(Docs, ListsEveryChoiceWithItsValues) {
  const std::string text = page("theory/choices.md");
  for (const case_file::Choice& choice : case_file::choices()) {
    std::string values;
    for (const std::string& word : case_file::find_key(choice.key)->words)
      values += fmt::format("{}`{}`", values.empty() ? "" : ", ", word);
    const std::string line = fmt::format("| `{}` | {} | [", choice.key, values);
    EXPECT_NE(text.find(line), std::string::npos) << "docs/theory/choices.md should have a line\n" << line;
  }
}

}  // namespace
}  // namespace granvof
