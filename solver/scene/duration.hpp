// Times as people write them: "3h50m", "10min", "45s".
#pragma once

#include <string>
#include <string_view>

namespace granvof {

// Numbers with their units (h, min or m, s), larger before smaller, each once: [s], > 0. Throws
// std::invalid_argument.
double read_duration(std::string_view text);

// "6 s", "12 min", "2.5 h".
std::string duration_text(double seconds);

}  // namespace granvof
