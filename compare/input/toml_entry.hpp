// Tables of a TOML file together with where they stand, so that every complaint names its place.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include "compare/input/table_error.hpp"
#include "compare/metrics/curve.hpp"

namespace granvof::compare {

// The root table; `name` stands for the file in messages. Throws TableError where it is no TOML.
toml::table parse_toml(std::string_view text, std::string_view name);
// The same from a file; TableError also where it cannot be read.
toml::table parse_toml_file(const std::filesystem::path& file);

// Every function that takes a key throws TableError where the key is missing or its value is not of the kind.
class TomlEntry {
 public:
  // `table` must outlive the entry; `path` says where it stands, `file` is shown in messages.
  TomlEntry(const toml::table& table, std::string path, std::string_view file)
      : table_(table), path_(std::move(path)), file_(file) {}

  [[noreturn]] void fail(std::string_view key, std::string_view what) const;

  void allow_only(const std::vector<std::string_view>& keys) const;

  bool has(std::string_view key) const { return table_.contains(key); }
  int line() const { return static_cast<int>(table_.source().begin.line); }

  std::string text(std::string_view key) const;
  double number(std::string_view key) const;
  double non_negative(std::string_view key) const;
  double positive(std::string_view key) const;
  bool truth(std::string_view key) const;
  // One text or a list of them, not empty.
  std::vector<std::string> texts(std::string_view key) const;
  // One number or a list of them, not empty.
  std::vector<double> numbers(std::string_view key) const;
  // The same, each 0 or more.
  std::vector<double> non_negatives(std::string_view key) const;
  // A list of numbers > 0, not empty.
  std::vector<double> positives(std::string_view key) const;
  Window window(std::string_view key) const;
  // Overrides "key=value".
  std::vector<std::string> assignments(std::string_view key) const;
  TomlEntry entry(std::string_view key) const;
  // One table or a list of them, not empty.
  std::vector<TomlEntry> entry_or_entries(std::string_view key) const;
  // The [[key]] entries; none where there is no such key.
  std::vector<TomlEntry> entries(std::string_view key) const;

  // The member of `all` whose name_of() is given under `key`.
  template <typename Enum>
  Enum one_of(std::string_view key, std::initializer_list<Enum> all) const {
    const std::string given = text(key);
    std::vector<std::string_view> names;
    for (const Enum member : all) {
      if (name_of(member) == given) return member;
      names.push_back(name_of(member));
    }
    fail(key, fmt::format("'{}' given; allowed: {}", given, fmt::join(names, ", ")));
  }

 private:
  const toml::node& require(std::string_view key) const;
  double require_non_negative(double value, std::string_view key) const;
  double number_of(const toml::node& node, std::string_view key) const;

  const toml::table& table_;
  std::string path_;
  std::string_view file_;
};

}  // namespace granvof::compare
