// How the faults of a case are said: where they stand, all of them, in order, and in bounds.
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "solver/tests/scene/case_fixture.hpp"

namespace granvof::test {
namespace {

// Replaces the first `from` of the small case.
std::string edited(const std::string& from, const std::string& to) {
  std::string text(small_case);
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(CaseErrors, NameTheLineOfAValue) {
  EXPECT_EQ(refusal_of(edited("friction = 0.4", "friction = -0.4")),
            "small.toml:20:12: solid.friction: got -0.4, allowed: a number >= 0");
}

TEST(CaseErrors, NameTheLineOfAnUnknownKeyAndTable) {
  EXPECT_EQ(refusal_of(edited("friction = 0.4", "frction = 0.4")),
            "small.toml:20:11: solid.frction: unknown key (got 0.4), did you mean solid.friction?");
  EXPECT_EQ(refusal_of(edited("[gate]\nspeed = 1.0", "[gait]")).substr(0, 35),
            "small.toml:25:1: gait: unknown key ");
}

TEST(CaseErrors, NameTheTableThatLacksAKey) {
  const std::string message = refusal_of(edited("friction = 0.4\n", ""));
  EXPECT_EQ(message.substr(0, 45), "small.toml:17:1: solid.friction: got nothing,") << message;
}

TEST(CaseErrors, NameTheFileThatLacksATable) {
  const std::string message = refusal_of(edited("[grid]\ndx = 0.01\n", ""));
  EXPECT_EQ(message.substr(0, 32), "small.toml: grid.dx: got nothing") << message;
}

TEST(CaseErrors, NameTheLineOfASyntaxError) {
  EXPECT_EQ(refusal_of(edited("level = 0.07", "level = = 0.07")).substr(0, 26), "small.toml:16:9: not TOML:");
  EXPECT_EQ(refusal_of(edited("level = 0.07", "level = 0.07\nlevel = 0.08")).substr(0, 26),
            "small.toml:17:9: not TOML:");
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(CaseErrors, NameAllFaultsInTheOrderOfTheText) {
  std::string text = edited("dx = 0.01", "dx = 0.03");
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("top = \"open\"", "left = \"open\"");
  replace("level = 0.07", "level = 0.7");
  replace("friction = 0.4", "frction = 0.4");
  replace("solid_fraction = 0.57", "solid_fraction = 0.7");
  replace("end = 10", "end = \"late\"");
  replace("preset = \"paper\"", "preset = \"papers\"");
  const std::vector<std::string> overrides{"numerics.dt_max=0.5", "numerics.dt_min=1"};
  const auto lines = lines_of(refusal_of(text, overrides));
  const std::vector<std::string> expected{
      "--set: numerics.dt_min: got 1,",          "small.toml:7:6: grid.dx: got 0.03",
      "small.toml:9:8: walls.left: got",         "small.toml:16:9: liquid.level: got 0.7",
      "small.toml:20:11: solid.frction:",        "small.toml:24:18: bed.solid_fraction: got 0.7",
      "small.toml:28:7: time.end: got \"late\"", "small.toml:36:10: model.preset: got \"papers\"",
  };
  ASSERT_EQ(lines.size(), expected.size()) << refusal_of(text, overrides);
  for (std::size_t i = 0; i < lines.size(); ++i) EXPECT_TRUE(lines[i].starts_with(expected[i])) << lines[i];
}

TEST(CaseErrors, DoNotFollowFromOneAnother) {
  // Whatever depends on the tank is left unsaid until the tank is known.
  EXPECT_EQ(lines_of(refusal_of(small_case, {"tank.size=[0.4, -1]"})).size(), 1U);
  EXPECT_EQ(lines_of(refusal_of(small_case, {"solid=3"})).size(), 1U);
  EXPECT_EQ(lines_of(refusal_of(small_case, {"gate=3"})).size(), 1U);
  EXPECT_EQ(lines_of(refusal_of(small_case, {"scene.dimensions=7"})).size(), 1U);
  // What a preset decides is not known without it; nor is a longest step without the scene.
  EXPECT_EQ(
      lines_of(refusal_of(small_case, {"model.preset=no", "contact.critical_solid_fraction=0.5"})).size(),
      1U);
  EXPECT_EQ(lines_of(refusal_of(small_case, {"bed.height=-1", "numerics.dt_min=1"})).size(), 1U);
}

TEST(CaseErrors, AllBadOverridesAreNamed) {
  EXPECT_EQ(lines_of(refusal_of(small_case, {"dx", "grid.dx="})).size(), 2U);
}

TEST(CaseErrors, AreOfBoundedLengthAndNumber) {
  std::string many;
  for (int i = 0; i < 1000; ++i) many += "odd_key_number_" + std::to_string(i) + " = 1\n";
  const std::string refusal = refusal_of(std::string(small_case) + many);
  const auto lines = lines_of(refusal);
  EXPECT_LE(refusal.size(), 2000U);
  EXPECT_GT(lines.size(), 2U);
  EXPECT_EQ(lines.back(), "and " + std::to_string(1000 - (lines.size() - 1)) + " more faults");
  const std::string longest(100000, 'x');
  for (const std::string& text :
       {edited("[gate]", "[gate]\n" + longest + " = 1"),
        edited("name = \"small\"", "name = \"" + longest + '"'), edited("[gate]", "[" + longest + "]"),
        edited("level = 0.07", "level = [[" + longest + "]]"),
        edited("end = 10", "end = \"" + longest + '"')}) {
    EXPECT_LT(refusal_of(text).size(), 1000U);
    EXPECT_NE(refusal_of(text), "");
  }
}

TEST(CaseErrors, ShowWhatCannotBePrintedEscaped) {
  const std::string name = edited("friction = 0.4", "friction = 0.4\n\"a\\n\\u001b[2J\\u202e\" = 1");
  const std::string message = refusal_of(name);
  EXPECT_NE(message.find("solid.\"a\\u000A\\u001B[2J\\u202E\": unknown key"), std::string::npos) << message;
  const std::string value = refusal_of(edited("end = 10", "end = \"\\u009b31m\\u2028\""));
  EXPECT_NE(value.find("got \"\\u009B31m\\u2028\""), std::string::npos) << value;
  EXPECT_NE(refusal([] { parse_scene("x", "a\nb.toml"); }).find("a\\u000Ab.toml:1:"), std::string::npos);
  EXPECT_NE(refusal_of(small_case, {"grid.dx=\xff\x1b"}).find("grid.dx: got \\xFF\\u001B"),
            std::string::npos);
}

TEST(CaseErrors, AQuotedPathIsOneNameAndNoKey) {
  EXPECT_NE(refusal_of("\"solid.friction\" = 0.3\n" + std::string(small_case)).find("unknown key"),
            std::string::npos);
}

TEST(CaseErrors, RefuseAnEmptyFile) {
  EXPECT_NE(refusal_of("").find("scene.name: got nothing"), std::string::npos);
}

}  // namespace
}  // namespace granvof::test
