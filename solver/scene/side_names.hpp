// The sides of the tank as case files name them, by SideIndex.
#pragma once

#include <array>
#include <string_view>

namespace granvof::case_file {

inline constexpr std::array<std::string_view, 7> side_names{"left",  "right", "bottom", "top",
                                                            "front", "back",  "all"};

}  // namespace granvof::case_file
