// The error that bad input raises.
#pragma once

#include <stdexcept>
#include <string>

namespace granvof {

// what() has one line for each fault, in the order of the file; a line names the place, the key, what was
// given and what is allowed, as in "cases/s1.toml:12:12: solid.friction: got -0.4, allowed: a number >= 0".
class CaseError : public std::runtime_error {
 public:
  explicit CaseError(const std::string& message) : std::runtime_error(message) {}
};

}  // namespace granvof
