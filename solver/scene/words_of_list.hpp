// What a key that chooses from a list of closures says of it.
#pragma once

#include <string>

#include "solver/model/choices.hpp"
#include "solver/scene/key_types.hpp"

namespace granvof::case_file {

// Words of a list of closures, as they stand in it.
template <typename List>
Words<closures::Chosen<List>> words_of() {
  Words<closures::Chosen<List>> words;
  for (std::size_t place = 0; place < List::facts.size(); ++place)
    words.emplace_back(List::facts[place].word, closures::Chosen<List>(place));
  return words;
}

// Their sources, with semicolons between them.
template <typename List>
std::string sources_of() {
  std::string text;
  for (const closures::ClosureFacts& facts : List::facts)
    text.append(text.empty() ? "" : "; ").append(facts.source);
  return text;
}

}  // namespace granvof::case_file
