// What the fuzzer has kept goes through the same entries, without clang and without chance.
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "compare/tests/fuzz/entries.hpp"

namespace granvof::fuzz {
namespace {

class Corpus : public ::testing::TestWithParam<Entry> {};

TEST_P(Corpus, IsTakenOrRefused) {
  std::size_t inputs = 0;
  for (const auto& file :
       std::filesystem::directory_iterator(std::filesystem::path(GRANVOF_CORPUS) / GetParam().name)) {
    std::ostringstream content;
    content << std::ifstream(file.path(), std::ios::binary).rdbuf();
    EXPECT_NO_THROW(GetParam().take(content.str())) << file.path();
    ++inputs;
  }
  EXPECT_GE(inputs, 10U);
}

INSTANTIATE_TEST_SUITE_P(Every, Corpus, ::testing::ValuesIn(entries().begin(), entries().end()),
                         [](const auto& instance) {
                           std::string name = instance.param.name;
                           std::erase(name, '-');
                           return name;
                         });

TEST(Entries, AreFoundByName) {
  EXPECT_EQ(find_entry("no such entry"), nullptr);
  ASSERT_NE(find_entry("lay"), nullptr);
  EXPECT_STREQ(find_entry("lay")->name, "lay");
}

// A whole checkpoint is taken: what the entry says of a damaged one is said of something that can be read.
TEST(Entries, AWholeCheckpointIsTaken) {
  EXPECT_NO_THROW(find_entry("checkpoint")->take(""));
}

}  // namespace
}  // namespace granvof::fuzz
