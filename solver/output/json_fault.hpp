// What is wrong with a JSON text, for a person.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace granvof {

// What the library says of it, without its own name and number of the fault
// ("[json.exception.type_error.302]").
inline std::string json_fault(const nlohmann::json::exception& error) {
  const std::string said = error.what();
  const auto end = said.starts_with('[') ? said.find("] ") : std::string::npos;
  return end == std::string::npos ? said : said.substr(end + 2);
}

}  // namespace granvof
