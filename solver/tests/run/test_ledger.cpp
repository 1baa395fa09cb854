// The one table of the energy ledger: what is documented, and what a reader of a run finds, is what it says.
#include <filesystem>
#include <regex>
#include <string>

#include <nlohmann/json.hpp>

#include "solver/state/energy_terms.hpp"
#include "solver/tests/cases_directory.hpp"
#include "solver/tests/run/small_runs.hpp"
#include "solver/tests/temporary_directory.hpp"

namespace granvof {
namespace {

const std::filesystem::path root = cases_directory().parent_path();

std::string table() {
  std::string text =
      "| column | kind | sign | what it is | measured in |\n"
      "|---|---|---|---|---|\n";
  for (const EnergyTerm& term : energy_terms) {
    std::string meaning;
    for (const char letter : std::string(term.meaning)) {
      if (letter == '|') meaning += '\\';  // or it would end the cell
      meaning += letter;
    }
    const std::string file = term.measured_in;
    text += fmt::format("| `{}` | {} | {} | {} | [{}](../../{}) |\n", term.name, name_of(term.kind),
                        term.sign > 0 ? "+" : (term.sign < 0 ? "−" : ""), meaning,
                        file.substr(file.rfind('/') + 1), file);
  }
  return text;
}

TEST(Ledger, IsDocumentedTermByTerm) {
  EXPECT_NE(test::text_of(root / "docs/theory/energy.md").find(table()), std::string::npos)
      << "docs/theory/energy.md should hold this table:\n"
      << table();
}

// The member of EnergyTerms that a term of the table is.
std::string member_of(const EnergyTerm& term) {
  const std::string text = test::text_of(root / "solver/state/energy_terms.hpp");
  std::smatch found;
  const std::regex row("\"" + std::string(term.name) + "\", &EnergyTerms::(\\w+)");
  return std::regex_search(text, found, row) ? found[1].str() : "";
}

TEST(Ledger, NamesTheFileThatMeasuresATerm) {
  for (const EnergyTerm& term : energy_terms) {
    const std::string member = member_of(term);
    ASSERT_NE(member, "") << term.name;
    EXPECT_TRUE(std::regex_search(test::text_of(root / term.measured_in), std::regex("\\b" + member + "\\b")))
        << term.measured_in << " is said to measure " << term.name << " and does not speak of " << member;
  }
}

TEST(Ledger, StandsInTheRecordOfARun) {
  const test::TemporaryDirectory directory;
  EXPECT_EQ(test::run_into(directory.path() / "run", test::column_scene({"time.end=0.01"})), 0);
  const auto record = nlohmann::json::parse(test::text_of(directory.path() / "run" / "run.json"));
  ASSERT_EQ(record["ledger"].size(), energy_terms.size());
  for (std::size_t i = 0; i < energy_terms.size(); ++i) {
    const auto& stated = record["ledger"][i];
    EXPECT_EQ(stated["name"], energy_terms[i].name);
    EXPECT_EQ(stated["sign"], energy_terms[i].sign);
    EXPECT_EQ(stated["kind"], name_of(energy_terms[i].kind));
    EXPECT_TRUE(record["monitors"].contains(energy_terms[i].name)) << energy_terms[i].name;
  }
}

// Every part is of a term, and what a term is called stands once.
TEST(Ledger, CountsEachTermOnce) {
  for (const EnergyTerm& term : energy_terms) {
    EXPECT_EQ(term.sign == 0, term.kind == EnergyKind::part) << term.name;
    int same = 0;
    for (const EnergyTerm& other : energy_terms) same += other.value == term.value ? 1 : 0;
    EXPECT_EQ(same, 1) << term.name;
  }
  EnergyTerms before, after;
  after.kinetic = 1.0;
  after.drag = 2.0;
  after.walls = 4.0;
  after.numerical_solid = -8.0;
  after.upwind_momentum = 16.0;
  EXPECT_EQ(after.left_by(before), 1.0 + 2.0 - 4.0 - 8.0);
  EXPECT_EQ(after.created(), 8.0);
  EXPECT_EQ(after.numerical(), -8.0);
  EXPECT_EQ(after.numerical_magnitude(), 8.0);
}

}  // namespace
}  // namespace granvof
