// Sets of overrides of a case, put together to scenes.
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

namespace granvof::test {

using Set = std::vector<std::string>;

inline Set joined(std::initializer_list<Set> parts) {
  Set all;
  for (const Set& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace granvof::test
