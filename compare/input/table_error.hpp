// Bad input in a table that people write (checks.toml, study.toml).
#pragma once

#include <stdexcept>

namespace granvof::compare {

// what() is one line: "<file>:<line>: <key>: what was given, what is allowed".
class TableError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace granvof::compare
