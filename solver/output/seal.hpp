// The digest that a JSON file carries of itself: its last member is "sha256", of every byte before the comma
// in front of it. A reader so knows a file in which anything was changed since.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace granvof {

// `object`: a JSON object as text, indented by two, that ends in "\n}". With the seal, and a newline behind.
std::string sealed(std::string_view object);

enum class Seal {
  none,    // the text ends in no seal
  broken,  // it is not of this text
  whole
};
Seal seal_of(std::string_view text);

// Throws OutputError naming `file` unless its `text` has a whole seal, or none and no member "sha256" either:
// files of earlier versions and of other programs have none.
void require_seal(std::string_view text, bool has_member, const std::filesystem::path& file);

}  // namespace granvof
