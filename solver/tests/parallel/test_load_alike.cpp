// Several processes that each read a case go on only where all have read the same.
#include <array>
#include <string>

#include <gtest/gtest.h>

#include "solver/parallel/processes.hpp"
#include "solver/scene/case_error.hpp"
#include "solver/scene/fnv1a.hpp"
#include "solver/tests/team.hpp"

namespace granvof {
namespace {

using Texts = std::array<std::string, 2>;

// What each of two processes reads, or why it does not go on. A case without text cannot be read.
Texts read_by_two(const Texts& texts) {
  Texts said;
  test::Team team(2);
  team.run([&](int number, const Communicator& processes) {
    const auto n = static_cast<std::size_t>(number);
    try {
      said[n] = load_alike(processes, [&] {
                  if (texts[n].empty()) throw CaseError("no text");
                  Scene scene;
                  scene.resolved = texts[n];
                  return scene;
                }).resolved;
    } catch (const CaseError& error) {
      said[n] = error.what();
    }
  });
  return said;
}

TEST(LoadAlike, GivesWhatAllRead) {
  EXPECT_EQ(read_by_two({"case 1", "case 1"}), (Texts{"case 1", "case 1"}));
}

TEST(LoadAlike, RefusesCasesThatDifferByEitherHalfOfTheirHash) {
  const Texts lower_alike{"case 324991", "case 552880"}, upper_alike{"case 392291", "case 503040"};
  ASSERT_EQ(fnv1a(lower_alike[0]) & 0xffffffffU, fnv1a(lower_alike[1]) & 0xffffffffU);
  ASSERT_EQ(fnv1a(upper_alike[0]) >> 32, fnv1a(upper_alike[1]) >> 32);
  for (const Texts& texts : {lower_alike, upper_alike})
    for (const std::string& said : read_by_two(texts))
      EXPECT_NE(said.find("read different cases"), std::string::npos) << said;
}

TEST(LoadAlike, EndsWhereAnotherCannotReadIt) {
  for (const std::size_t cannot : {0U, 1U}) {
    Texts texts{"case 1", "case 1"};
    texts[cannot].clear();
    const Texts said = read_by_two(texts);
    EXPECT_EQ(said[cannot], "no text");
    EXPECT_NE(said[1 - cannot].find("another process cannot read"), std::string::npos) << said[1 - cannot];
  }
}

}  // namespace
}  // namespace granvof
