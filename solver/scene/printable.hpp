// Text from outside, made fit for one line of a message.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace granvof::case_file {

// Control characters, those that turn the direction of writing and bytes that are not UTF-8 as \u and \x
// escapes; of a text longer than `longest` bytes (> 0) the beginning, and how long it is.
std::string printable(std::string_view text, std::size_t longest);

}  // namespace granvof::case_file
