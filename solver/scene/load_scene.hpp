// From a case file to a checked Scene. The schema is the table in keys.cpp; `granvof keys` prints it.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "solver/scene/case_error.hpp"
#include "solver/scene/scene.hpp"

namespace granvof {

// Reads a case file, the files its `base` names, and overrides "table.key=value" (a TOML value; a bare word
// is taken as a string). Everything is checked before it returns. Throws CaseError.
Scene load_scene(const std::filesystem::path& case_file, std::span<const std::string> overrides = {});

// The same from text, for instance the resolved case that a result carries; `label` stands for the file in
// errors, `base` is relative to the working directory, and scene.name need not equal a file's stem.
Scene parse_scene(std::string_view text, const std::string& label,
                  std::span<const std::string> overrides = {});

// The reference table of all keys, as Markdown.
std::string keys_reference();

}  // namespace granvof
