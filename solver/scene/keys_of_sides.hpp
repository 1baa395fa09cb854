// Keys of what bounds the flow: sides and obstacles.
#pragma once

#include <vector>

#include "solver/scene/keys.hpp"

namespace granvof::case_file {

// Of one side, or of side_all; those of the first side stand for all in the documentation.
std::vector<Key> side_keys(int side);
std::vector<Key> obstacle_keys();

}  // namespace granvof::case_file
