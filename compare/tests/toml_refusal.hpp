// What a reader of TOML says of a text with one line changed.
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "compare/input/table_error.hpp"

namespace granvof::compare::test {

// The message of the TableError that `read` throws; "accepted" where it throws none.
template <typename Read>
std::string refusal(Read&& read) {
  try {
    read();
  } catch (const TableError& error) {
    return error.what();
  }
  return "accepted";
}

// `text` with the first `line` of it replaced; fails the test where there is none.
inline std::string with_line_replaced(std::string text, const std::string& line, const std::string& by) {
  const auto at = text.find(line);
  EXPECT_NE(at, std::string::npos) << line;
  return text.replace(at, line.size(), by);
}

}  // namespace granvof::compare::test
