#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "compare/input/evidence.hpp"
#include "compare/tests/files_stated.hpp"
#include "solver/output/digest.hpp"
#include "solver/output/fields_file.hpp"
#include "solver/output/output_error.hpp"
#include "solver/scene/load_scene.hpp"
#include "solver/tests/cases_directory.hpp"
#include "solver/tests/temporary_directory.hpp"

namespace granvof::compare {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> columns{"time [s]", "front_dense [m]", "own_monitor [-]"};

// Rows 0 to 178 at 0.1 s, as lines without their ends.
std::vector<std::string> lines() {
  std::vector<std::string> all{"time [s],front_dense [m],own_monitor [-]"};
  for (int i = 0; i <= 178; ++i) all.push_back(fmt::format("{},{},1", 0.1 * i, 0.01 * i));
  return all;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

class Evidence : public testing::Test {
 protected:
  // The complaint about a series of that text; `rows` and `end` as stated.
  std::string complaint(const std::string& text, std::int64_t rows = 179, double end = 17.8,
                        Asked asked = {0.1, 17.8}) {
    std::ofstream(file_) << text;
    try {
      require_series(read_series(file_), file_, {rows, end, columns, ""}, asked);
    } catch (const OutputError& error) {
      return error.cause();
    }
    return "";
  }

  const test::TemporaryDirectory directory_;
  const fs::path file_ = directory_.path() / "series.csv";
};

TEST_F(Evidence, AWholeSeriesIsSound) {
  EXPECT_EQ(complaint(joined(lines())), "");
  EXPECT_EQ(complaint(joined(lines()), 179, 17.8, {0.0, 17.8}), "");
}

TEST_F(Evidence, ACutAnywhereIsNoticed) {
  const std::string whole = joined(lines());
  std::vector<std::string> sixty = lines();
  sixty.resize(61);
  EXPECT_EQ(complaint(joined(sixty)), "it has 60 whole rows, written were 179");
  for (const std::size_t keep : {whole.size() - 1, whole.size() / 2, std::size_t{60}, std::size_t{41}})
    EXPECT_NE(complaint(whole.substr(0, keep)), "") << keep;
}

// With what is stated made to fit, as whoever tampers would.
TEST_F(Evidence, RowsTakenOutAreAHoleWhateverIsStated) {
  for (const Asked asked : {Asked{0.1, 17.8}, Asked{0.0, 17.8}}) {
    auto holed = lines();
    holed.erase(holed.begin() + 80);
    EXPECT_NE(complaint(joined(holed), 178, 17.8, asked).find("there is nothing between 7.8"),
              std::string::npos);
    auto late = lines();
    late.erase(late.begin() + 1);
    EXPECT_NE(complaint(joined(late), 178, 17.8, asked), "");
    auto early = lines();
    early.resize(early.size() - 2);
    EXPECT_NE(complaint(joined(early), 177, 17.6, asked).find("the case at 17.8 s"), std::string::npos);
  }
}

TEST_F(Evidence, RowsMustBeAsManyAsAskedFor) {
  EXPECT_EQ(complaint(joined(lines()), 179, 17.8, {0.1, 17.8, 179}), "");
  EXPECT_EQ(complaint(joined(lines()), 179, 17.8, {0.1, 17.8, 178}), "it has 179 rows, asked for were 178");
}

TEST_F(Evidence, TimeMustAscend) {
  auto twice = lines();
  twice[50] = twice[49];
  EXPECT_NE(complaint(joined(twice)).find("time does not ascend from row 49 to row 50"), std::string::npos);
  std::swap(twice[60], twice[61]);
  EXPECT_NE(complaint(joined(twice)), "");
}

TEST_F(Evidence, AnotherUnitIsNoticedWhateverIsStated) {
  auto text = joined(lines());
  EXPECT_NE(
      complaint(text.replace(text.find("[m]"), 3, "[mm]")).find("'front_dense' is in 'mm', expected 'm'"),
      std::string::npos);
  text = joined(lines());
  EXPECT_NE(complaint(text.replace(text.find("[-]"), 3, "[%]")).find("column 3 is 'own_monitor [%]'"),
            std::string::npos);
  text = joined(lines());
  EXPECT_NE(complaint(text.replace(text.find("[s]"), 3, "[ms]")), "");
}

TEST_F(Evidence, ColumnsMustBeThoseWritten) {
  std::vector<std::string> fewer;
  for (const std::string& line : lines()) fewer.push_back(line.substr(0, line.rfind(',')));
  EXPECT_EQ(complaint(joined(fewer)), "it has 2 columns, written were 3");
}

TEST_F(Evidence, AChangedDigitIsAnotherFile) {
  std::ofstream(file_) << "abc";
  require_digest(file_, test::sha256("abc"));
  EXPECT_THROW(require_digest(file_, test::sha256("abd")), OutputError);
  EXPECT_THROW(require_digest(directory_.path() / "gone", test::sha256("abc")), OutputError);
  EXPECT_THROW(require_digest(directory_.path(), test::sha256("")), OutputError);  // a directory
}

class EvidenceOfFields : public testing::Test {
 protected:
  EvidenceOfFields() {
    Scene scene = load_scene(cases_directory() / "canary.toml");
    scene.grid.cells = {2, 2, 1};
    auto file = FieldsFile::create(directory_.path(), scene);
    CellFields fields;
    fields.cells = scene.grid.cells;
    fields.spacing = scene.grid.spacing;
    for (auto* values : {&fields.f_s, &fields.alpha, &fields.p_c, &fields.theta, &fields.phi})
      values->assign(4, 0.5);
    for (std::size_t d = 0; d < 2; ++d) {
      fields.u_s[d].assign(4, 0.0);
      fields.u_c[d].assign(4, 0.0);
    }
    for (const double time : {0.0, 0.5, 1.0}) {
      fields.time = time;
      file.append(fields);
    }
    file.join();
    stated_ = StatedFields{3, digest_of_file(file_)};
  }

  const test::TemporaryDirectory directory_;
  const fs::path file_ = directory_.path() / "fields.h5";
  std::optional<StatedFields> stated_;
};

TEST_F(EvidenceOfFields, AreHeldAgainstWhatIsStated) {
  EXPECT_NO_THROW(require_fields(directory_.path(), stated_, 1.0));
  EXPECT_THROW(require_fields(directory_.path(), stated_, 0.9), OutputError);       // later than the run
  EXPECT_THROW(require_fields(directory_.path(), std::nullopt, 1.0), OutputError);  // nobody speaks of it
  EXPECT_THROW(require_fields(directory_.path(), StatedFields{4, stated_->sha256}, 1.0), OutputError);
  fs::resize_file(file_, fs::file_size(file_) - 100);
  EXPECT_THROW(require_fields(directory_.path(), stated_, 1.0), OutputError);
  fs::remove(file_);
  EXPECT_THROW(require_fields(directory_.path(), stated_, 1.0), OutputError);
  EXPECT_NO_THROW(require_fields(directory_.path(), std::nullopt, 1.0));
}

}  // namespace
}  // namespace granvof::compare
