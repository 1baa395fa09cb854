// How the program ends where something is thrown.
#pragma once

#include <functional>

namespace demvof {

// What `work` returns; where it throws, that is said on stderr, and the code is 2 for bad input (CaseError, a
// directory that cannot be used) and 1 for all else.
int exit_code_of(const std::function<int()>& work);

}  // namespace demvof
