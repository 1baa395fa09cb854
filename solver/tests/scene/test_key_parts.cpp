// Keys so deep that a parser that follows them would run out of its stack are refused before it.
#include <string>

#include <gtest/gtest.h>

#include "solver/scene/key_parts.hpp"
#include "solver/tests/scene/case_fixture.hpp"

namespace granvof::test {
namespace {

std::string deep(const std::string& part, std::size_t parts) {
  std::string key = part;
  for (std::size_t i = 1; i < parts; ++i) key += "." + part;
  return key;
}

TEST(KeyParts, AreRefusedByTheCaseThatHasTooMany) {
  const std::string key = deep("a", 100000);
  for (const std::string& text : {"[" + key + "]", key + " = 1", deep("\"a\"", 100000) + " = 1"})
    EXPECT_NE(refusal_of("\n" + text).find("small.toml:2:"), std::string::npos) << text.substr(0, 20);
  EXPECT_NE(refusal_of(small_case, {key + "=1"}), "");
}

TEST(KeyParts, AreCountedInKeysAlone) {
  using case_file::most_key_parts;
  EXPECT_FALSE(case_file::overlong_key(deep("a", most_key_parts)));
  EXPECT_TRUE(case_file::overlong_key(deep("a", most_key_parts + 1)));
  const std::string dots(2 * most_key_parts, '.');
  for (const std::string& text : {"a = \"" + dots + "\"", "a = '''\n" + dots + "'''", "# " + dots})
    EXPECT_FALSE(case_file::overlong_key(text)) << text;
}

}  // namespace
}  // namespace granvof::test
