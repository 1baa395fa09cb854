// What run.json states of the files of a run made up from text.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "solver/output/digest.hpp"

namespace granvof::test {

inline std::vector<std::string> split_at(const std::string& text, char separator) {
  std::vector<std::string> parts{""};
  for (const char c : text) c == separator ? parts.emplace_back() : parts.back() += c;
  return parts;
}

inline std::string sha256(const std::string& text) {
  Digest digest;
  digest.add(text);
  return digest.hex();
}

// Of a series.csv of that content, which ends with a newline; there is no fields.h5.
inline nlohmann::json files_stated(const std::string& series) {
  const auto lines = split_at(series, '\n');
  return {{"series.csv",
           {{"rows", lines.size() - 2},
            {"end", std::stod(lines[lines.size() - 2])},
            {"columns", split_at(lines.front(), ',')},
            {"sha256", sha256(series)}}}};
}

}  // namespace granvof::test
