// The cases that this build was made with, for tests that run what is shipped.
#pragma once

#include <filesystem>

namespace granvof {

// cases/ of the sources. A function of its own object, not a definition of each test's: an absolute path
// among the compiler's arguments keeps the compiler cache from knowing the test in any other checkout.
std::filesystem::path cases_directory();

}  // namespace granvof
