// The values of a case as written: the file, the files it is based on and the overrides, merged, each with
// its place.
#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace granvof::case_file {

// monostate: something no key takes, such as a date or a mixed array.
using Value = std::variant<std::monostate, bool, std::int64_t, double, std::string, std::vector<double>>;

// Where something stands: a file and its line and column from 1, 0 where it has none; or "--set".
struct Place {
  std::string file;
  std::int64_t line = 0, column = 0;
  std::string text() const;  // "cases/s1.toml:12:8", fit for a message
  auto operator<=>(const Place&) const = default;
};

struct Entry {
  Value value;
  std::string shown;  // the value as TOML text, fit for a message
  Place where;
  int layer = 0;  // 0: the outermost base; higher layers replace lower ones; the overrides are the last
};

struct CaseText {
  std::string file;                                     // the case file as the caller named it
  std::map<std::string, Entry> entries;                 // by dotted path, such as "liquid.box.origin"
  std::vector<std::pair<std::string, Entry>> replaced;  // entries that others replaced, in that order
  std::map<std::string, Place> tables;                  // top-level tables that stand in the text, and where

  // All that the layers say of one path, the last first.
  std::vector<Entry> stated(const std::string& path) const;
  // Of a table, or the file where it does not stand in the text.
  Place place_of(const std::string& table) const;
};

// `base` names a case that this one takes over, or a list of such, each over those before it; names are
// relative to the file. An optional table that a later layer sets to false ("gate = false") is dropped. A
// later layer replaces a key and what lies below it ("walls.top.fluid" by "walls.top"), not what lies above
// it: "walls.top" stays beside a later "walls.top.fluid". Only regular files are read. Throws CaseError.
CaseText read_case(const std::filesystem::path& file, std::span<const std::string> overrides);
CaseText read_case_text(std::string_view text, const std::string& label,
                        std::span<const std::string> overrides);

}  // namespace granvof::case_file
