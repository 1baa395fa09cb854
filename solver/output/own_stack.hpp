// The stack that a program was given, which ends it without a word where it is too small.
#pragma once

#include <cstddef>

namespace granvof {

// Least stack [bytes] with which any command of any program here does its work.
constexpr std::size_t least_stack = std::size_t{1} << 20U;

// False, after a line on stderr, where the limit of the stack (ulimit -s) is less: the program then ends with
// the exit code of bad input. Below what the system's loader and main() itself take nothing can be said.
bool has_stack(const char* program);

}  // namespace granvof
