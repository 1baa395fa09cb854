#include "compare/input/toml_entry.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "solver/output/atomic_file.hpp"
#include "solver/output/output_error.hpp"
#include "solver/scene/key_parts.hpp"

namespace granvof::compare {
namespace {

template <typename Parse>
toml::table parsed(Parse parse, std::string_view name) {
  try {
    return parse();
  } catch (const toml::parse_error& error) {
    const auto& at = error.source().begin;
    throw TableError(fmt::format("{}:{}:{}: {}", name, at.line, at.column, error.description()));
  }
}

}  // namespace

toml::table parse_toml(std::string_view text, std::string_view name) {
  if (const auto at = case_file::overlong_key(text))
    throw TableError(fmt::format("{}:{}:{}: a key of more than {} parts", name, at->line, at->column,
                                 case_file::most_key_parts));
  return parsed([&] { return toml::parse(text, name); }, name);
}

toml::table parse_toml_file(const std::filesystem::path& file) {
  const std::string name = file.string();
  try {
    return parse_toml(read_file(file), name);
  } catch (const OutputError& error) {
    throw TableError(fmt::format("{}: {}", name, error.cause()));
  }
}

void TomlEntry::fail(std::string_view key, std::string_view what) const {
  const toml::node* node = table_.get(key);
  const auto line = (node ? node->source() : table_.source()).begin.line;
  throw TableError(
      fmt::format("{}:{}: {}{}: {}", file_, line, path_, key.empty() ? "" : fmt::format(".{}", key), what));
}

void TomlEntry::allow_only(const std::vector<std::string_view>& keys) const {
  for (const auto& [key, node] : table_)
    if (std::find(keys.begin(), keys.end(), key.str()) == keys.end())
      fail(key.str(), fmt::format("unknown key; allowed: {}", fmt::join(keys, ", ")));
}

std::string TomlEntry::text(std::string_view key) const {
  const auto value = require(key).value_exact<std::string>();
  if (!value || value->empty()) fail(key, "expected a text that is not empty");
  return *value;
}

double TomlEntry::number(std::string_view key) const {
  return number_of(require(key), key);
}

double TomlEntry::non_negative(std::string_view key) const {
  return require_non_negative(number(key), key);
}

double TomlEntry::positive(std::string_view key) const {
  const double value = number(key);
  if (value <= 0.0) fail(key, fmt::format("{} given; allowed: more than 0", value));
  return value;
}

bool TomlEntry::truth(std::string_view key) const {
  const auto value = require(key).value_exact<bool>();
  if (!value) fail(key, "expected true or false");
  return *value;
}

std::vector<std::string> TomlEntry::texts(std::string_view key) const {
  const toml::array* array = require(key).as_array();
  if (!array) return {text(key)};
  std::vector<std::string> list;
  for (const toml::node& node : *array) {
    const auto value = node.value_exact<std::string>();
    if (!value || value->empty()) fail(key, "expected texts that are not empty");
    list.push_back(*value);
  }
  if (list.empty()) fail(key, "the list is empty");
  return list;
}

std::vector<double> TomlEntry::numbers(std::string_view key) const {
  const toml::array* array = require(key).as_array();
  if (!array) return {number(key)};
  std::vector<double> list;
  for (const toml::node& node : *array) list.push_back(number_of(node, key));
  if (list.empty()) fail(key, "the list is empty");
  return list;
}

std::vector<double> TomlEntry::non_negatives(std::string_view key) const {
  std::vector<double> list = numbers(key);
  for (const double value : list) require_non_negative(value, key);
  return list;
}

std::vector<double> TomlEntry::positives(std::string_view key) const {
  const toml::array* array = require(key).as_array();
  if (!array || array->empty()) fail(key, "expected a list of numbers");
  std::vector<double> list;
  for (const toml::node& node : *array) {
    list.push_back(number_of(node, key));
    if (list.back() <= 0.0) fail(key, fmt::format("{} given; allowed: more than 0", list.back()));
  }
  return list;
}

Window TomlEntry::window(std::string_view key) const {
  const toml::array* array = require(key).as_array();
  if (!array || array->size() != 2) fail(key, "expected two numbers [begin, end]");
  const Window window{number_of(*array->get(0), key), number_of(*array->get(1), key)};
  if (!(window.begin < window.end))
    fail(key, fmt::format("[{}, {}] given; begin must come before end", window.begin, window.end));
  return window;
}

std::vector<std::string> TomlEntry::assignments(std::string_view key) const {
  std::vector<std::string> list = texts(key);
  for (const std::string& assignment : list)
    if (assignment.find('=') == std::string::npos)
      fail(key, fmt::format("'{}' given; expected key=value", assignment));
  return list;
}

TomlEntry TomlEntry::entry(std::string_view key) const {
  const toml::table* inner = require(key).as_table();
  if (!inner) fail(key, "expected a table { ... }");
  return {*inner, fmt::format("{}.{}", path_, key), file_};
}

std::vector<TomlEntry> TomlEntry::entry_or_entries(std::string_view key) const {
  if (!require(key).is_array()) return {entry(key)};
  std::vector<TomlEntry> list = entries(key);
  if (list.empty()) fail(key, "the list is empty");
  return list;
}

std::vector<TomlEntry> TomlEntry::entries(std::string_view key) const {
  std::vector<TomlEntry> list;
  const toml::node* node = table_.get(key);
  if (!node) return list;
  const toml::array* rows = node->as_array();
  if (!rows || !rows->is_array_of_tables())
    throw TableError(
        fmt::format("{}:{}: {}: expected [[{}]] entries", file_, node->source().begin.line, key, key));
  for (std::size_t i = 0; i < rows->size(); ++i)
    list.emplace_back(*rows->get(i)->as_table(), fmt::format("{}[{}]", key, i + 1), file_);
  return list;
}

const toml::node& TomlEntry::require(std::string_view key) const {
  const toml::node* node = table_.get(key);
  if (!node) fail("", fmt::format("the key '{}' is missing", key));
  return *node;
}

double TomlEntry::require_non_negative(double value, std::string_view key) const {
  if (value < 0.0) fail(key, fmt::format("{} given; allowed: 0 or more", value));
  return value;
}

double TomlEntry::number_of(const toml::node& node, std::string_view key) const {
  const auto value = node.is_number() ? node.value<double>() : std::nullopt;
  if (!value || !std::isfinite(*value)) fail(key, "expected a finite number");
  return *value;
}

}  // namespace granvof::compare
