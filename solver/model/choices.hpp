// One list of the closures that may stand for each other: whoever asks which there are, what they are called
// in a case file or where they come from, asks it. A closure of such a list states
//   static constexpr ClosureFacts facts{word, source, keys that it alone reads};
// and a new one is its own header and one entry of the list.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>

namespace granvof::closures {

struct ClosureFacts {
  std::string_view word;                    // value of its key in a case file
  std::string_view source;                  // who gave it
  std::array<std::string_view, 2> reads{};  // keys of parameters that are read for no other part of the model

  constexpr bool reads_key(std::string_view key) const { return reads[0] == key || reads[1] == key; }
};

template <typename... Closures>
struct Choices {
  static constexpr std::array<ClosureFacts, sizeof...(Closures)> facts{Closures::facts...};

  // Place of a closure in the list; does not compile for one that is not in it.
  template <typename Closure>
  static constexpr std::size_t place() {
    constexpr std::array same{std::is_same_v<Closure, Closures>...};
    std::size_t at = 0;
    while (!same.at(at)) ++at;
    return at;
  }

  // body(closure) with the one at `place` < facts.size(); what it returns is of one type for all of them.
  template <typename Body>
  static decltype(auto) with(std::size_t place, Body&& body) {
    return first_or_rest<Body, Closures...>(place, body);
  }

 private:
  template <typename Body, typename First, typename... Rest>
  static decltype(auto) first_or_rest(std::size_t place, Body& body) {
    if constexpr (sizeof...(Rest) > 0) {
      if (place > 0) return first_or_rest<Body, Rest...>(place - 1, body);
    }
    return body(First{});
  }
};

// The words of those that read a parameter, in quotes, with "or" between them.
template <typename List>
std::string words_that_read(std::string_view key) {
  std::string words;
  for (const ClosureFacts& closure : List::facts)
    if (closure.reads_key(key))
      words.append(words.empty() ? "\"" : " or \"").append(closure.word).append("\"");
  return words;
}

// One of a list; the first unless it is said.
template <typename List>
class Chosen {
 public:
  constexpr Chosen() = default;
  explicit constexpr Chosen(std::size_t place) : place_(place) {}
  template <typename Closure>
  static constexpr Chosen of() {
    return Chosen(List::template place<Closure>());
  }
  constexpr std::size_t place() const { return place_; }
  constexpr const ClosureFacts& facts() const { return List::facts[place_]; }
  // body(closure), as Choices::with().
  template <typename Body>
  decltype(auto) with(Body&& body) const {
    return List::with(place_, body);
  }
  constexpr bool operator==(const Chosen&) const = default;

 private:
  std::size_t place_ = 0;
};

}  // namespace granvof::closures
