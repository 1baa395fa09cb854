#include "solver/scene/case_text.hpp"

#include <algorithm>
#include <cerrno>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <system_error>

#include <fmt/format.h>
#include <toml++/toml.h>
#include <unistd.h>

#include "solver/scene/case_error.hpp"
#include "solver/scene/key_parts.hpp"
#include "solver/scene/keys.hpp"
#include "solver/scene/printable.hpp"
#include "solver/scene/regular_file.hpp"
#include "solver/scene/toml_text.hpp"

namespace granvof::case_file {
namespace {

constexpr int deepest_base = 8;
constexpr int most_bases = 32;  // of one case, those of its bases included: lists of lists would never end
constexpr std::uintmax_t largest_file = 1 << 20;  // [bytes]; the longest case that is shipped has 5e3
constexpr std::size_t longest_value = 80;         // in a message
constexpr std::size_t longest_description = 200;

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

bool is_bare_word(std::string_view text) {
  const auto plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_';
  };
  return !text.empty() && std::all_of(text.begin(), text.end(), plain);
}

// A part of a path, in quotes where it is no bare word: a quoted "a.b" is one name and no key.
std::string name_text(std::string_view name) {
  return is_bare_word(name) ? std::string(name) : toml_text(std::string(name));
}

// The value for a message: numbers as short as they read back, anything unusual as the library prints it.
std::string shown(const toml::node& node, const Value& value) {
  std::ostringstream out;
  if (const auto* number = std::get_if<double>(&value)) {
    out << toml_text(*number);
  } else if (const auto* text = std::get_if<std::string>(&value)) {
    out << toml_text(*text);
  } else if (const auto* list = std::get_if<std::vector<double>>(&value)) {
    out << toml_text(*list);
  } else {
    node.visit([&](const auto& element) { out << element; });
  }
  return printable(out.str(), longest_value);
}

// Merges one layer of text over what is there.
class Merge {
 public:
  Merge(CaseText& text, std::string place, bool with_lines, int layer)
      : text_(text), place_(std::move(place)), with_lines_(with_lines), layer_(layer) {}

  void table(const toml::table& table, const std::string& prefix) {
    for (const auto& [key, node] : table) {
      const std::string name = name_text(key.str());
      const std::string path = prefix.empty() ? name : prefix + "." + name;
      if (const Table* known = find_table(path); known && known->many && node.is_array_of_tables()) {
        list(*node.as_array(), path);
        continue;
      }
      const auto* inner = node.as_table();
      if (inner && (prefix.empty() || !inner->empty())) {
        if (prefix.empty()) text_.tables[path] = where(node);
        this->table(*inner, path);
      } else {
        set(path, node);
      }
    }
  }

  // [[name]] as often as there are such boxes: each key becomes the list of its numbers, as [name] states it.
  // A key that some have and some do not is one list too short, and refused where lists are compared.
  void list(const toml::array& tables, const std::string& path) {
    text_.tables[path] = where(tables);
    std::map<std::string, std::pair<toml::array, Place>> columns;
    for (const toml::node& node : tables) {
      for (const auto& [key, value] : *node.as_table()) {
        auto& [column, first] = columns[path + "." + name_text(key.str())];
        if (column.empty()) first = where(value);
        column.push_back(value);
      }
    }
    for (const auto& [name, column] : columns) set(name, column.first, column.second);
  }

 private:
  void set(const std::string& path, const toml::node& node) { set(path, node, where(node)); }
  void set(const std::string& path, const toml::node& node, const Place& place) {
    const Value value = value_of(node);
    const std::string top = path.substr(0, path.find('.'));
    if (top == path) {
      const Table* known = find_table(path);
      if (value == Value(false) && known && known->optional && text_.tables.contains(path)) {
        drop_below(path);
        text_.tables.erase(path);
        return;
      }
    } else {
      drop_below(path);
      text_.entries.erase(top);
      text_.tables.try_emplace(top, place);
    }
    if (const auto before = text_.entries.find(path); before != text_.entries.end())
      text_.replaced.emplace_back(*before);
    text_.entries[path] = {value, shown(node, value), place, layer_};
  }

  void drop_below(const std::string& path) {
    const std::string prefix = path + ".";
    const auto first = text_.entries.lower_bound(prefix);
    auto last = first;
    while (last != text_.entries.end() && last->first.starts_with(prefix)) ++last;
    text_.entries.erase(first, last);
  }

  Place where(const toml::node& node) const {
    if (!with_lines_) return {.file = place_};
    const toml::source_position at = node.source().begin;
    return {place_, at.line, at.column};
  }

  CaseText& text_;
  std::string place_;
  bool with_lines_;
  int layer_;
};

toml::table parse(std::string_view text, const std::string& label) {
  if (const auto at = overlong_key(text))
    throw CaseError(fmt::format("{}: a key of more than {} parts", Place{label, at->line, at->column}.text(),
                                most_key_parts));
  try {
    return toml::parse(text, label);
  } catch (const toml::parse_error& error) {
    const toml::source_position at = error.source().begin;
    throw CaseError(fmt::format("{}: not TOML: {}", Place{label, at.line, at.column}.text(),
                                printable(error.description(), longest_description)));
  }
}

// A pipe or a device would be waited for, or never end.
std::string read_file(const std::filesystem::path& file) {
  const auto refuse = [&](const std::string& why) {
    throw CaseError(fmt::format("{}: {}, allowed: a case file (TOML)", Place{file.string()}.text(), why));
  };
  const RegularFile opened = open_regular(file);
  if (!opened.fault.empty()) refuse(fmt::format("cannot be read ({})", opened.fault));
  const std::unique_ptr<const int, void (*)(const int*)> closing(&opened.descriptor,
                                                                 [](const int* fd) { ::close(*fd); });
  if (opened.size > largest_file)
    refuse(fmt::format("has {} bytes, more than {}", opened.size, largest_file));
  std::string content(opened.size, '\0');
  std::size_t have = 0;
  while (have < content.size()) {
    const ssize_t got = ::read(opened.descriptor, content.data() + have, content.size() - have);
    if (got == 0) break;
    if (got > 0)
      have += static_cast<std::size_t>(got);
    else if (errno != EINTR)
      refuse(fmt::format("cannot be read ({})", std::generic_category().message(errno)));
  }
  content.resize(have);
  return content;
}

// The names that `base` gives: one text, or a list of texts; nothing for anything else.
std::optional<std::vector<std::string>> names_of(const toml::node& base) {
  if (const auto name = base.value_exact<std::string>()) return std::vector{*name};
  const auto* list = base.as_array();
  if (!list || list->empty() || !list->is_homogeneous(toml::node_type::string)) return std::nullopt;
  std::vector<std::string> names;
  for (const toml::node& name : *list) names.push_back(*name.value<std::string>());
  return names;
}

// A file on top of its bases, and all that they are based on.
class Layers {
 public:
  explicit Layers(CaseText& text) : text_(text) {}

  // Merges a file's bases in their order, each after its own, then the file itself. Returns the next free
  // layer.
  int merge(toml::table table, const std::string& label, const std::filesystem::path& directory,
            int depth = 0) {
    if (const toml::node* base = table.get("base")) {
      bases_of(*base, label, directory, depth);
      table.erase("base");
    }
    Merge(text_, label, true, next_).table(table, "");
    return ++next_;
  }

 private:
  CaseText& text_;
  int next_ = 0, files_ = 0;

  void bases_of(const toml::node& base, const std::string& label, const std::filesystem::path& directory,
                int depth) {
    const auto refuse = [&](const toml::node& at, const std::string& allowed) {
      const toml::source_position begin = at.source().begin;
      throw CaseError(fmt::format("{}: base: got {}, allowed: {}",
                                  Place{label, begin.line, begin.column}.text(), shown(at, value_of(at)),
                                  allowed));
    };
    const auto names = names_of(base);
    if (!names) refuse(base, "a file name in quotes, or a list of such");
    if (depth == deepest_base)
      refuse(base, fmt::format("a chain of at most {} cases, without a circle", deepest_base));
    for (std::size_t n = 0; n < names->size(); ++n) {
      const toml::node& at = base.is_array() ? *base.as_array()->get(n) : base;
      if (++files_ > most_bases) refuse(at, fmt::format("at most {} files in all", most_bases));
      const std::filesystem::path file = (directory / (*names)[n]).lexically_normal();
      std::error_code unknown;
      if (!std::filesystem::is_regular_file(file, unknown))
        refuse(at, fmt::format("a case file; there is no {}", printable(file.string(), longest_description)));
      merge(parse(read_file(file), file.string()), file.string(), file.parent_path(), depth + 1);
    }
  }
};

bool is_path(std::string_view text) {
  return !text.empty() && text.front() != '.' && text.back() != '.' &&
         std::all_of(text.begin(), text.end(),
                     [](char c) { return is_bare_word(std::string_view(&c, 1)) || c == '.'; });
}

std::optional<toml::table> try_parse(const std::string& text) {
  if (overlong_key(text)) return std::nullopt;
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
    throw CaseError(fmt::format("--set: got {}, allowed: table.key=value, such as grid.dx=0.005",
                                text.empty() ? "nothing" : printable(text, longest_value)));
  }
  const std::string value = text.substr(equals + 1);
  const bool single = value.find('\n') == std::string::npos;
  auto table = single ? try_parse(path + " = " + value) : std::nullopt;
  if (!table && is_bare_word(value)) table = try_parse(path + " = \"" + value + "\"");
  if (!table) {
    throw CaseError(fmt::format(
        "--set: {}: got {}, allowed: a TOML value, such as 0.4, true, [1, 2], \"text\" or a "
        "bare word",
        printable(path, longest_value), value.empty() ? "nothing" : printable(value, longest_value)));
  }
  return std::move(*table);
}

CaseText read(toml::table table, const std::string& label, const std::filesystem::path& directory,
              std::span<const std::string> overrides) {
  CaseText text;
  text.file = label;
  const int layer = Layers(text).merge(std::move(table), label, directory);
  std::string faults;  // of all overrides: one error names them
  for (const std::string& override_text : overrides) {
    try {
      Merge(text, "--set", false, layer).table(parse_override(override_text), "");
    } catch (const CaseError& error) {
      if (!faults.empty()) faults += '\n';
      faults += error.what();
    }
  }
  if (!faults.empty()) throw CaseError(faults);
  return text;
}

}  // namespace

std::string Place::text() const {
  const std::string name = printable(file, longest_description);
  return line > 0 ? fmt::format("{}:{}:{}", name, line, column) : name;
}

Place CaseText::place_of(const std::string& table) const {
  const auto found = tables.find(table);
  return found == tables.end() ? Place{.file = file} : found->second;
}

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
