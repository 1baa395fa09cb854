// The table of docs/output.md of the columns of series.csv is the one that the code writes.
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "solver/output/extract.hpp"

namespace granvof {
namespace {

TEST(Docs, ListsTheColumnsOfTheSeries) {
  const auto path = std::filesystem::path(GRANVOF_CASES_DIR).parent_path() / "docs/output.md";
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  const std::string table = scalar_table_markdown();
  EXPECT_NE(text.str().find(table), std::string::npos) << "docs/output.md should hold this table:\n" << table;
}

}  // namespace
}  // namespace granvof
