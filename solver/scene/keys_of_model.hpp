// Keys of [contact] and [model].
#pragma once

#include <vector>

#include "solver/scene/keys.hpp"

namespace granvof::case_file {

std::vector<Key> contact_keys();
std::vector<Key> model_keys();

}  // namespace granvof::case_file
