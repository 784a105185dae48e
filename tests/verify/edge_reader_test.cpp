// What the verifier reads of a file of edges, and what it refuses.
#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/holds.h"
#include "verify/edges.h"

namespace foretouch::test {
namespace {

/// A sphere, one more below it that has no LSS, and a sphere below that; four triangles.
std::string whyNotEdges(const std::string& text, const std::string& rotation = "[1,0,0,0]",
                        verify::EdgeStatement* const statement = nullptr) {
  const std::string sphere = R"("lss":[{"a":[0,0,0],"b":[0,0,0],"radius":0.1}])";
  const std::string rest = R"("offset":[0,0,0],"rotation":)" + rotation + "}";
  std::vector<verify::Link> links;
  EXPECT_EQ(
      verify::readAvatar(R"({"format":"foretouch-avatar","links":[{"name":"a","parent":null,)" +
                             sphere + "," + rest + R"(,{"name":"b","parent":"a","lss":[],)" + rest +
                             R"(,{"name":"c","parent":"b",)" + sphere + "," + rest + "]}",
                         links)
          .what,
      "");
  verify::EdgeStatement read;
  const std::string what = verify::readEdges(text, links, 4, read).what;
  if (statement != nullptr) *statement = read;
  return what;
}

TEST(VerifyEdges, RefusesWhatIsNotTheFormat) {
  const std::string good =
      "foretouch-edges 1\nclearance 0.01\ncoordinates 2\nturn 0 0 0 1 0 1 0\n"
      "shift 2 1 0 0 1 1 0\nignore 1\nignore 0 1 3\npair 0 2\nedge 5\n0 0\n1 1\nend\n";
  ASSERT_EQ(whyNotEdges(good), "");
  const std::string shift = "shift 2 1 0 0 1 1 0\n";
  const std::vector<std::array<std::string, 2>> changes = {
      {"edges 1", "edges 2"},
      {"clearance 0.01", "clearance -0.01"},
      {"clearance 0.01\n", ""},
      {"coordinates 2", "coordinates 0"},
      {"coordinates 2", "coordinates 2 2"},
      {"turn 0", "turn 3"},
      {"turn 0 0 0 1 0", "turn 0 0 0 0 0"},
      {"turn 0 0 0 1 0", "turn 0 0 0 1 2"},
      {"turn 0 0 0 1 0 1 0", "turn 0 0 0 1 0 1"},
      {"turn 0 0 0 1 0 1 0", "turn 0 0 0 1 0 1 0 0"},
      {"shift 2 1 0 0 1", "turn 0 1 0 0 1"},
      {shift, shift + shift + shift + shift},
      {"ignore 1", "ignore 3"},
      {"ignore 0 1 3", "ignore 0 1"},
      {"ignore 0 1 3", "ignore 0 1 0"},
      {"ignore 0 1 3", "ignore 0 1 4"},
      {"ignore 0 1 3", "ignore 0 4 1"},
      {"pair 0 2", "pair 0 1"},
      {"pair 0 2", "pair 1 2"},
      {"pair 0 2", "pair 0 0"},
      {"pair 0 2", "pair 2 0"},
      {"pair 0 2", "pair 0 3"},
      {"pair 0 2", "pair 0 2\npair 0 2"},
      {"edge 5", "edge -1"},
      {"edge 5\n0 0\n1 1", "edge 5\n0 0\n1 1\nedge 5\n0 0\n1 1"},
      {"0 0\n1 1", "0 0\n1"},
      {"0 0\n1 1", "0 0\n1 1 1"},
      {"0 0\n1 1", "0 0\n1 1e10"},
      {"1 1\nend", "1 1\nignore 1\nend"},
      {"end\n", ""},
      {"end\n", "end\nend\n"},
  };
  for (const auto& [old, other] : changes) {
    std::string bad = good;
    ASSERT_TRUE(holds(good, old)) << old;
    EXPECT_NE(whyNotEdges(bad.replace(bad.find(old), old.size(), other)), "") << other;
  }
  EXPECT_EQ(whyNotEdges(good, "[0.60054,0,-0.80072,0]"), "");
  EXPECT_TRUE(holds(whyNotEdges(good, "[0.60066,0,-0.80088,0]"), "unit rotation"));
}

TEST(VerifyEdges, AreToldFromStepsByTheirFirstWord) {
  EXPECT_TRUE(verify::isOfEdges("\nforetouch-edges 7\n"));
  EXPECT_FALSE(verify::isOfEdges("foretouch-steps 1\nforetouch-edges 1\n"));
  EXPECT_FALSE(verify::isOfEdges("\n\n"));
}

TEST(VerifyEdges, TrianglesThatMayBeTouchedAreThoseNamed) {
  constexpr std::size_t kAll = 4;
  for (std::size_t lists = 0; lists < 1000; ++lists) {
    // Three ranges, each of one of the ten that four triangles have.
    std::array<bool, kAll> isNamed{};
    std::string lines;
    for (std::size_t k = 0, left = lists; k < 3; ++k, left /= 10) {
      std::size_t first = 0, range = left % 10;
      for (; range >= kAll - first; ++first) range -= kAll - first;
      lines += "ignore 0 " + std::to_string(first) + " " + std::to_string(range + 1) + "\n";
      for (std::size_t i = first; i <= first + range; ++i) isNamed.at(i) = true;
    }
    verify::EdgeStatement read;
    const std::string head = "foretouch-edges 1\nclearance 0\ncoordinates 1\n";
    ASSERT_EQ(whyNotEdges(head + lines + "ignore 2\nend\n", "[1,0,0,0]", &read), "");
    for (std::size_t i = 0; i < kAll; ++i) {
      ASSERT_EQ(verify::isIgnored(read.ignored[0], i), isNamed.at(i)) << lines << i;
      ASSERT_FALSE(verify::isIgnored(read.ignored[1], i));
      ASSERT_TRUE(verify::isIgnored(read.ignored[2], i));
    }
  }
}

}  // namespace
}  // namespace foretouch::test
