// What the fuzzer has kept goes through the same entries, without clang and without chance.
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "compare/tests/fuzz/entries.hpp"
#include "solver/scene/load_scene.hpp"

namespace granvof::fuzz {
namespace {

std::string content_of(const std::filesystem::path& file) {
  std::ostringstream content;
  content << std::ifstream(file, std::ios::binary).rdbuf();
  return content.str();
}

class Corpus : public ::testing::TestWithParam<Entry> {};

TEST_P(Corpus, IsTakenOrRefused) {
  std::size_t inputs = 0;
  for (const auto& file :
       std::filesystem::directory_iterator(std::filesystem::path(GRANVOF_CORPUS) / GetParam().name)) {
    EXPECT_NO_THROW(GetParam().take(content_of(file.path()))) << file.path();
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

// What TOML can write in several ways is read, so that it is written out in full and read again.
TEST(Corpus, EveryWayToWriteAValueIsRead) {
  for (const std::string name :
       {"small", "escape-backslash", "escape-literal", "escape-quote", "escape-control", "escape-unicode",
        "escape-key", "text-unicode", "text-lines", "text-literal-lines", "keys-dotted", "keys-inline",
        "array-lines", "array-long", "number-forms", "number-longest", "bom-crlf"})
    EXPECT_NO_THROW(
        (void)parse_scene(content_of(std::filesystem::path(GRANVOF_CORPUS) / "case" / name), "fuzz.toml"))
        << name;
  const Scene scene =
      parse_scene(content_of(std::filesystem::path(GRANVOF_CORPUS) / "case/escape-literal"), "fuzz.toml");
  EXPECT_EQ(scene.title, "C:\\new\\u0041\\table \\");
}

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
