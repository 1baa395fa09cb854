#include "solver/scene/case_text.hpp"

#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "solver/scene/case_error.hpp"
#include "solver/scene/toml_text.hpp"

namespace granvof::case_file {
namespace {

constexpr int deepest_base = 8;

Value value_of(const toml::node& node) {
  if (const auto* b = node.as_boolean()) return b->get();
  if (const auto* i = node.as_integer()) return i->get();
  if (const auto* f = node.as_floating_point()) return f->get();
  if (const auto* s = node.as_string()) return s->get();
  if (const auto* array = node.as_array()) {
    std::vector<double> numbers;
    for (const auto& element : *array) {
      if (!element.is_number()) return std::monostate{};
      numbers.push_back(element.value<double>().value());
    }
    return numbers;
  }
  return std::monostate{};
}

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

// The value for a message: numbers as short as they read back, anything unusual as the library prints it.
std::string shown(const toml::node& node, const Value& value) {
  if (const auto* number = std::get_if<double>(&value)) return toml_text(*number);
  if (const auto* text = std::get_if<std::string>(&value)) return toml_text(*text);
  if (const auto* list = std::get_if<std::vector<double>>(&value)) return toml_text(*list);
  std::ostringstream out;
  node.visit([&](const auto& element) { out << element; });
  return one_line(out.str());
}

// Merges one layer of text over what is there.
class Merge {
 public:
  Merge(CaseText& text, std::string place, bool with_lines, int layer)
      : text_(text), place_(std::move(place)), with_lines_(with_lines), layer_(layer) {}

  void table(const toml::table& table, const std::string& prefix) {
    for (const auto& [key, node] : table) {
      const std::string path =
          prefix.empty() ? std::string(key.str()) : prefix + "." + std::string(key.str());
      if (const auto* inner = node.as_table()) {
        if (prefix.empty()) text_.tables[path] = where(node);
        this->table(*inner, path);
      } else {
        set(path, node);
      }
    }
  }

 private:
  void set(const std::string& path, const toml::node& node) {
    const Value value = value_of(node);
    drop_below(path);
    drop_above(path);
    const bool top_level = path.find('.') == std::string::npos;
    if (top_level && value == Value(false) && text_.tables.contains(path)) {
      text_.tables.erase(path);
      return;
    }
    if (!top_level) text_.tables.try_emplace(path.substr(0, path.find('.')), where(node));
    if (const auto before = text_.entries.find(path); before != text_.entries.end())
      text_.replaced.emplace_back(*before);
    text_.entries[path] = {value, shown(node, value), where(node), layer_};
  }

  void drop_below(const std::string& path) {
    std::erase_if(text_.entries, [&](const auto& item) { return item.first.starts_with(path + "."); });
  }

  void drop_above(std::string path) {
    while (path.find('.') != std::string::npos) {
      path.resize(path.rfind('.'));
      text_.entries.erase(path);
    }
  }

  std::string where(const toml::node& node) const {
    return with_lines_ ? fmt::format("{}:{}", place_, node.source().begin.line) : place_;
  }

  CaseText& text_;
  std::string place_;
  bool with_lines_;
  int layer_;
};

toml::table parse(std::string_view text, const std::string& label) {
  try {
    return toml::parse(text, label);
  } catch (const toml::parse_error& error) {
    throw CaseError(
        fmt::format("{}:{}: not TOML: {}", label, error.source().begin.line, error.description()));
  }
}

std::string read_file(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) {
    throw CaseError(fmt::format("{}: is a directory, allowed: a case file (TOML)", file.string()));
  }
  std::ifstream in(file, std::ios::binary);
  if (!in) throw CaseError(fmt::format("{}: cannot be read, allowed: a case file (TOML)", file.string()));
  std::ostringstream content;
  content << in.rdbuf();
  return content.str();
}

// Merges a file's bases, outermost first, then the file itself; returns the next free layer.
int merge_layers(CaseText& text, toml::table table, const std::string& label,
                 const std::filesystem::path& directory, int depth) {
  int layer = 0;
  if (const toml::node* base = table.get("base")) {
    const std::string place = fmt::format("{}:{}", label, base->source().begin.line);
    if (!base->is_string()) {
      throw CaseError(fmt::format("{}: base: got {}, allowed: a file name in quotes", place,
                                  shown(*base, value_of(*base))));
    }
    if (depth == deepest_base) {
      throw CaseError(fmt::format("{}: base: got {}, allowed: a chain of at most {} cases, without a circle",
                                  place, shown(*base, value_of(*base)), deepest_base));
    }
    const std::filesystem::path file = (directory / *base->value<std::string>()).lexically_normal();
    if (!std::filesystem::is_regular_file(file)) {
      throw CaseError(fmt::format("{}: base: got {}, allowed: a case file; there is no {}", place,
                                  shown(*base, value_of(*base)), file.string()));
    }
    layer = merge_layers(text, parse(read_file(file), file.string()), file.string(), file.parent_path(),
                         depth + 1);
    table.erase("base");
  }
  Merge(text, label, true, layer).table(table, "");
  return layer + 1;
}

bool is_bare_word(std::string_view text) {
  const auto plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_';
  };
  return !text.empty() && std::all_of(text.begin(), text.end(), plain);
}

bool is_path(std::string_view text) {
  return !text.empty() && text.front() != '.' && text.back() != '.' &&
         std::all_of(text.begin(), text.end(),
                     [](char c) { return is_bare_word(std::string_view(&c, 1)) || c == '.'; });
}

std::optional<toml::table> try_parse(const std::string& text) {
  try {
    return toml::parse(text);
  } catch (const toml::parse_error&) {
    return std::nullopt;
  }
}

toml::table parse_override(const std::string& text) {
  const auto equals = text.find('=');
  const std::string path = text.substr(0, equals);
  if (equals == std::string::npos || !is_path(path)) {
    throw CaseError(
        fmt::format("--set: got {}, allowed: table.key=value, such as grid.dx=0.005", one_line(text)));
  }
  const std::string value = text.substr(equals + 1);
  const bool single = value.find('\n') == std::string::npos;
  auto table = single ? try_parse(path + " = " + value) : std::nullopt;
  if (!table && is_bare_word(value)) table = try_parse(path + " = \"" + value + "\"");
  if (!table) {
    throw CaseError(
        fmt::format("--set: {}: got {}, allowed: a TOML value, such as 0.4, true, [1, 2], \"text\" or a "
                    "bare word",
                    path, value.empty() ? "nothing" : one_line(value)));
  }
  return std::move(*table);
}

CaseText read(toml::table table, const std::string& label, const std::filesystem::path& directory,
              std::span<const std::string> overrides) {
  CaseText text;
  text.file = label;
  const int layer = merge_layers(text, std::move(table), label, directory, 0);
  for (const std::string& override_text : overrides) {
    Merge(text, "--set", false, layer).table(parse_override(override_text), "");
  }
  return text;
}

}  // namespace

std::vector<Entry> CaseText::stated(const std::string& path) const {
  std::vector<Entry> all;
  if (const auto last = entries.find(path); last != entries.end()) all.push_back(last->second);
  for (auto before = replaced.rbegin(); before != replaced.rend(); ++before)
    if (before->first == path) all.push_back(before->second);
  return all;
}

CaseText read_case(const std::filesystem::path& file, std::span<const std::string> overrides) {
  return read(parse(read_file(file), file.string()), file.string(), file.parent_path(), overrides);
}

CaseText read_case_text(std::string_view text, const std::string& label,
                        std::span<const std::string> overrides) {
  return read(parse(text, label), label, {}, overrides);
}

}  // namespace granvof::case_file
