#include "solver/tests/cases_directory.hpp"

namespace granvof {

std::filesystem::path cases_directory() {
  return GRANVOF_CASES_DIR;
}

}  // namespace granvof
