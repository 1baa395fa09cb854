// The values of a case as written: the file, the files it is based on and the overrides, merged, each with
// its place.
#pragma once

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

struct Entry {
  Value value;
  std::string shown;  // the value as TOML text
  std::string where;  // "cases/s1.toml:12", or "--set"
  int layer = 0;      // 0: the outermost base; higher layers replace lower ones; the overrides are the last
};

struct CaseText {
  std::string file;                                     // the case file as the caller named it
  std::map<std::string, Entry> entries;                 // by dotted path, such as "liquid.box.origin"
  std::vector<std::pair<std::string, Entry>> replaced;  // entries that others replaced, in that order
  std::map<std::string, std::string> tables;            // top-level tables that stand in the text, and where

  // All that the layers say of one path, the last first.
  std::vector<Entry> stated(const std::string& path) const;
};

// A table that a later layer sets to false ("gate = false") is dropped. Throws CaseError.
CaseText read_case(const std::filesystem::path& file, std::span<const std::string> overrides);
CaseText read_case_text(std::string_view text, const std::string& label,
                        std::span<const std::string> overrides);

}  // namespace granvof::case_file
