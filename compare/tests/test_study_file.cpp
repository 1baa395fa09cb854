#include <string>

#include <gtest/gtest.h>

#include "compare/study/study_file.hpp"
#include "compare/tests/toml_refusal.hpp"
#include "solver/tests/cases_directory.hpp"

namespace granvof::compare {
namespace {

const std::string good = R"toml(
[[method]]
name = "first"
[[method]]
name = "second"
set = ["numerics.solid_flux=limited"]
[[method]]
name = "third"
other_model = true
[[other]]
name = "parcels"
records = "peers/parcels"
set = ["reference.cell=0.002"]
line = "parcels of a kind"
[[part]]
name = "no LES"
set = ["model.les=false"]
[[part]]
name = "lid"
form = "rigid lid"
[[chart]]
case = "s1"
methods = ["third", "second"]
grids = [0.005, 0.0025, 0.00125]
down_to = 0.0025
[[chart.panel]]
quantity = "run_out"
window = [0, 10]
against = "finest"
method = "second"
[[chart.panel]]
quantity = "run_out@5"
against = "DEM"
)toml";

std::string message_of(const std::string& text) {
  return test::refusal([&] { parse_study(text, "study.toml"); });
}

std::string replaced(const std::string& line, const std::string& by) {
  return test::with_line_replaced(good, line, by);
}

TEST(StudyFile, ReadsMethodsPartsAndCharts) {
  const Study study = parse_study(good, "study.toml");
  ASSERT_EQ(study.methods.size(), 3u);
  EXPECT_FALSE(study.methods[1].other_model);
  EXPECT_TRUE(study.methods[2].other_model);
  ASSERT_EQ(study.others.size(), 1u);
  EXPECT_EQ(study.others[0].records, "peers/parcels");
  EXPECT_EQ(study.others[0].line, "parcels of a kind");
  EXPECT_EQ(methods_of(study, nullptr).size(), 3u);
  const auto shown = methods_of(study, &study.charts.at(0));
  ASSERT_EQ(shown.size(), 2u);
  EXPECT_EQ(shown[0].name, "second");  // in the order of the study, the same in all charts
  EXPECT_TRUE(study.methods[0].set.empty());
  EXPECT_EQ(study.methods[1].set, std::vector<std::string>{"numerics.solid_flux=limited"});
  ASSERT_EQ(study.parts.size(), 2u);
  EXPECT_EQ(study.parts[1].form, Form::rigid_lid);
  ASSERT_EQ(study.charts.size(), 1u);
  const Chart& chart = study.charts[0];
  EXPECT_DOUBLE_EQ(chart.down_to, 0.0025);
  ASSERT_EQ(chart.panels.size(), 2u);
  EXPECT_TRUE(chart.panels[0].quantity.is_curve);
  EXPECT_EQ(chart.panels[0].method, "second");
  EXPECT_FALSE(chart.panels[1].quantity.is_curve);
  EXPECT_EQ(chart.panels[1].record, "s1");
  EXPECT_EQ(chart.panels[1].quantity.label(), "run_out@5");
}

TEST(StudyFile, TheShippedFileIsAccepted) {
  const Study study = read_study(cases_directory() / "../compare/study.toml");
  EXPECT_FALSE(study.methods.empty());
  EXPECT_FALSE(study.parts.empty());
}

struct Wrong {
  const char* line;
  const char* by;
  const char* says;
};

class StudyFileRefuses : public testing::TestWithParam<Wrong> {};

TEST_P(StudyFileRefuses, WithPlaceAndCause) {
  const std::string said = message_of(replaced(GetParam().line, GetParam().by));
  EXPECT_EQ(said.rfind("study.toml:", 0), 0u) << said;
  EXPECT_NE(said.find(GetParam().says), std::string::npos) << said;
}

INSTANTIATE_TEST_SUITE_P(
    Cases, StudyFileRefuses,
    testing::Values(
        Wrong{"name = \"second\"", "name = \"first\"", "'first' is given twice"},
        Wrong{"set = [\"model.les=false\"]", "set = [\"model.les\"]", "expected key=value"},
        Wrong{"set = [\"model.les=false\"]", "", "give one of 'set' and 'form'"},
        Wrong{"form = \"rigid lid\"", "form = \"lid\"", "allowed: rigid lid, two dimensions, each choice"},
        Wrong{"grids = [0.005, 0.0025, 0.00125]", "grids = [0.0025, 0.005]", "from large to small"},
        Wrong{"grids = [0.005, 0.0025, 0.00125]", "grids = [0.005, -1]", "allowed: more than 0"},
        Wrong{"against = \"DEM\"", "against = \"dem\"", "allowed: finest, DEM, theory, published"},
        Wrong{"against = \"DEM\"", "against = \"DEM\"\nformula = \"x\"", "only against = \"theory\""},
        Wrong{"against = \"DEM\"", "against = \"theory\"\nformula = \"x\"", "'x' given"},
        Wrong{"method = \"second\"", "method = \"fourth\"", "no [[method]] has the name 'fourth'"},
        Wrong{"name = \"parcels\"", "name = \"third\"", "'third' is given twice"},
        Wrong{"methods = [\"third\", \"second\"]", "methods = [\"zeroth\"]",
              "no [[method]] has the name 'zeroth'"},
        Wrong{"method = \"second\"", "method = \"first\"", "'first' is not among the methods of the chart"},
        Wrong{"quantity = \"run_out@5\"", "quantity = \"run_out@five\"", "expected NAME or NAME@NUMBER"},
        Wrong{"quantity = \"run_out@5\"", "quantity = \"reach\"", "'reach' given; allowed: run_out"},
        Wrong{"set = [\"numerics.solid_flux=limited\"]", "grids = 1.5", "allowed: 1, 2"},
        Wrong{"down_to = 0.0025", "downto = 0.0025", "unknown key"}));

}  // namespace
}  // namespace granvof::compare
