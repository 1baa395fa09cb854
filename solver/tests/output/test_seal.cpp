#include <gtest/gtest.h>

#include "solver/output/output_error.hpp"
#include "solver/output/seal.hpp"

using namespace granvof;

namespace {

// The digest by sha256sum of the bytes before the comma.
TEST(Seal, IsTheDigestOfAllThatStandsBeforeIt) {
  const std::string text = sealed("{\n  \"a\": 1\n}");
  EXPECT_EQ(text,
            "{\n  \"a\": 1,\n  \"sha256\": "
            "\"d298ee5b852fc7dfacbb4dbf9c73da22d8a55ccb56c156043c930b278c39e889\"\n}\n");
  EXPECT_EQ(seal_of(text), Seal::whole);
  EXPECT_THROW(sealed("[1]"), std::invalid_argument);
}

TEST(Seal, IsBrokenByAnyChange) {
  const std::string text = sealed("{\n  \"a\": {\n    \"sha256\": \"x\"\n  },\n  \"b\": 12\n}");
  EXPECT_EQ(seal_of("{\n  \"a\": {\n    \"sha256\": \"x\"\n  }\n}\n"), Seal::none);
  for (std::size_t byte = 0; byte < text.size(); ++byte) {
    std::string other = text;
    other[byte] = static_cast<char>(other[byte] ^ 1);
    EXPECT_NE(seal_of(other), Seal::whole) << byte;
    EXPECT_NE(seal_of(text.substr(0, byte)), Seal::whole) << byte;
  }
  EXPECT_NE(seal_of(text + "\n"), Seal::whole);
}

TEST(Seal, MayBeMissingWhereNothingSaysThatThereIsOne) {
  EXPECT_NO_THROW(require_seal("{\n  \"a\": 1\n}\n", false, "run.json"));
  EXPECT_THROW(require_seal("{\"a\": 1, \"sha256\": \"0\"}", true, "run.json"), OutputError);
  EXPECT_THROW(require_seal("{\n  \"a\": 1,\n  \"sha256\": \"0\"\n}\n", true, "run.json"), OutputError);
}

}  // namespace
