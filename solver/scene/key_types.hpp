// How a key of each type is read, checked and printed.
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "solver/scene/keys.hpp"
#include "solver/scene/toml_text.hpp"

namespace granvof::case_file {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

// What is not zero has a size within these in any system of units; beyond them the product of a few
// quantities of a scene would leave the range of doubles.
inline constexpr double smallest_size = 1e-30, largest_size = 1e30;
inline bool of_a_size(double x) {
  return x == 0.0 || (std::fabs(x) >= smallest_size && std::fabs(x) <= largest_size);
}
// Whether a number, or one of a list, is finite but not of such a size.
bool beyond_doubles(const Value& value);

struct Bounds {
  double lower = -infinity, upper = infinity;
  bool lower_open = false, upper_open = false;

  bool holds(double x) const {
    return of_a_size(x) && (lower_open ? x > lower : x >= lower) && (upper_open ? x < upper : x <= upper);
  }
  std::string text() const;  // " >= 0", " in (0, 0.9]", or nothing
};

inline constexpr Bounds any{};
inline constexpr Bounds positive{.lower = 0.0, .lower_open = true};
inline constexpr Bounds not_negative{.lower = 0.0};
inline constexpr Bounds share{.lower = 0.0, .upper = 1.0};
inline constexpr Bounds part{.lower = 0.0, .upper = 1.0, .lower_open = true, .upper_open = true};

template <class Enum>
using Words = std::vector<std::pair<std::string, Enum>>;

// The number a value holds, NaN where it is none.
double as_number(const Value& value);

template <class T>
struct is_optional : std::false_type {};
template <class T>
struct is_optional<std::optional<T>> : std::true_type {};

// `access` maps a Draft to the member that holds the value.
template <class Access>
using member_of = std::remove_cvref_t<decltype(std::declval<Access>()(std::declval<Draft&>()))>;

// The value's text, "" for an unset optional and for an empty list.
template <class T>
std::string text_of(const T& member) {
  if constexpr (is_optional<T>::value) {
    return member ? toml_text(*member) : "";
  } else if constexpr (std::is_same_v<T, std::vector<double>> || std::is_same_v<T, std::vector<int>>) {
    return member.empty() ? "" : toml_text(member);
  } else {
    return toml_text(member);
  }
}

bool read_value(double& to, const Value& from, const Bounds& bounds);
bool read_value(int& to, const Value& from, const Bounds& bounds);
bool read_value(bool& to, const Value& from, const Bounds& bounds);
bool read_value(std::string& to, const Value& from, const Bounds& bounds);
bool read_value(std::vector<double>& to, const Value& from, const Bounds& bounds);
bool read_value(std::vector<int>& to, const Value& from, const Bounds& bounds);
template <class T>
bool read_value(std::optional<T>& to, const Value& from, const Bounds& bounds) {
  T value{};
  if (!read_value(value, from, bounds)) return false;
  to = value;
  return true;
}

template <class T>
std::string type_name() {
  if constexpr (is_optional<T>::value) {
    return type_name<typename T::value_type>();
  } else if constexpr (std::is_same_v<T, bool>) {
    return "true or false";
  } else if constexpr (std::is_same_v<T, int>) {
    return "integer";
  } else if constexpr (std::is_same_v<T, double>) {
    return "number";
  } else if constexpr (std::is_same_v<T, std::string>) {
    return "text";
  } else if constexpr (std::is_same_v<T, std::vector<int>>) {
    return "list of integers";
  } else {
    return "list of numbers";
  }
}

std::string allowed_text(const std::string& type, const Bounds& bounds, const std::string& unit);

// A key whose default is the member's initial value, unless `otherwise` or required(...) says something else.
template <class Access>
Key key(std::string name, std::string unit, const Bounds& bounds, Access access, std::string help) {
  using T = member_of<Access>;
  Key k;
  k.name = std::move(name);
  k.type = type_name<T>();
  k.unit = std::move(unit);
  k.allowed = allowed_text(k.type, bounds, k.unit);
  k.help = std::move(help);
  k.set = [access, bounds](Draft& draft, const Value& value) {
    return read_value(access(draft), value, bounds);
  };
  k.get = [access](const Draft& draft) { return text_of(access(draft)); };
  if constexpr (std::is_same_v<T, bool>) k.words = {toml_text(false), toml_text(true)};
  k.otherwise = k.get(Draft{});
  if (k.otherwise.empty()) k.otherwise = "none";
  return k;
}

// The same of another part than its [table]'s, or of a table whose keys are of many.
template <class Access>
Key key(const Part& owner, std::string name, std::string unit, const Bounds& bounds, Access access,
        std::string help) {
  Key k = key(std::move(name), std::move(unit), bounds, access, std::move(help));
  k.part = &owner;
  return k;
}

inline Key required(Key k) {
  k.otherwise.clear();
  return k;
}
inline Key otherwise(Key k, std::string text) {
  k.otherwise = std::move(text);
  return k;
}
// Out of the hashes at `unhashed`, the default that it came with, see there. A later default is another
// matter.
inline Key came_later(Key k, std::string unhashed) {
  k.unhashed = std::move(unhashed);
  return k;
}
inline Key scoped(Key k, Scope scope) {
  k.scope = scope;
  return k;
}

template <class Enum>
std::string word_list(const Words<Enum>& words) {
  std::string list;
  for (const auto& [word, value] : words) list += (list.empty() ? "\"" : " | \"") + word + '"';
  return list;
}

template <class Enum>
std::string word_of(const Words<Enum>& words, Enum value) {
  for (const auto& [word, meaning] : words) {
    if (meaning == value) return '"' + word + '"';
  }
  return "";
}

template <class Enum>
const Enum* find_word(const Words<Enum>& words, const Value& value) {
  const auto* text = std::get_if<std::string>(&value);
  for (const auto& [word, meaning] : words) {
    if (text && *text == word) return &meaning;
  }
  return nullptr;
}

// A key that takes one of a few words; its member is an Enum or an optional Enum.
template <class Enum, class Access>
Key choice(std::string name, Words<Enum> words, Access access, std::string help) {
  using T = member_of<Access>;
  Key k;
  k.name = std::move(name);
  k.type = "word";
  k.allowed = word_list(words);
  for (const auto& [word, value] : words) k.words.push_back(toml_text(word));
  k.help = std::move(help);
  k.set = [access, words](Draft& draft, const Value& value) {
    const Enum* found = find_word(words, value);
    if (found) access(draft) = *found;
    return found != nullptr;
  };
  k.get = [access, words](const Draft& draft) -> std::string {
    const T& member = access(draft);
    if constexpr (is_optional<T>::value) {
      return member ? word_of(words, *member) : "";
    } else {
      return word_of(words, member);
    }
  };
  k.otherwise = k.get(Draft{});
  if (k.otherwise.empty()) k.otherwise = "none";
  return k;
}

template <class Enum, class Access>
Key choice(const Part& owner, std::string name, Words<Enum> words, Access access, std::string help) {
  Key k = choice(std::move(name), std::move(words), access, std::move(help));
  k.part = &owner;
  return k;
}

// A key that takes a number or one of a few words; its member is a variant of the two.
template <class Enum, class Access>
Key number_or_word(std::string name, std::string unit, const Bounds& bounds, Words<Enum> words, Access access,
                   std::string help) {
  Key k;
  k.name = std::move(name);
  k.type = "number or word";
  k.unit = std::move(unit);
  k.allowed = allowed_text("number", bounds, k.unit) + " | " + word_list(words);
  k.help = std::move(help);
  k.set = [access, words, bounds](Draft& draft, const Value& value) {
    if (const Enum* found = find_word(words, value)) {
      access(draft) = *found;
      return true;
    }
    double number = 0.0;
    if (!read_value(number, value, bounds)) return false;
    access(draft) = number;
    return true;
  };
  k.get = [access, words](const Draft& draft) {
    const auto& member = access(draft);
    const auto* number = std::get_if<double>(&member);
    return number ? toml_text(*number) : word_of(words, std::get<Enum>(member));
  };
  k.otherwise = k.get(Draft{});
  return k;
}

}  // namespace granvof::case_file
