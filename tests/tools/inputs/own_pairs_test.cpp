#include "tools/inputs/own_pairs.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "assets/avatar/avatar_file.h"
#include "tests/tools/small_inputs.h"

namespace foretouch::tools {
namespace {

/// Spheres of 0.1 m, a metre apart, all on one root; a name with a colon, one without LSS.
Avatar row() {
  std::string links;
  int place = 0;
  for (const char* name : {"Root", "LeftHand", "LeftThumb", "RightHand", "R:Thumb", "Empty"}) {
    const bool isEmpty = std::string(name) == "Empty";
    links += (place == 0 ? "" : ",") + std::string(R"({"name":")") + name + R"(","parent":)" +
             (place == 0 ? "null" : R"("Root")") + R"(,"offset":[)" + std::to_string(place) +
             R"(,0,0],"lss":[)" + (isEmpty ? "" : R"({"a":[0,0,0],"b":[0,0,0],"radius":0.1})") +
             "]}";
    ++place;
  }
  return parseAvatar(R"({"format":"foretouch-avatar","version":1,"links":[)" + links + "]}", "row")
      .value();
}

std::vector<std::pair<LinkId, LinkId>> leftOutBy(const std::vector<std::string>& texts) {
  const auto read = parseLeftOut("--leave-out", texts, row());
  EXPECT_TRUE(read.ok()) << describe(read.error());
  std::vector<std::pair<LinkId, LinkId>> pairs;
  if (!read.ok()) return pairs;
  for (const LinkPair& pair : read.value()) pairs.emplace_back(pair.a, pair.b);
  return pairs;
}

using LinkPairs = std::vector<std::pair<LinkId, LinkId>>;

TEST(ParseLeftOut, TakesNamesPatternsAndLists) {
  EXPECT_EQ(leftOutBy({"LeftHand:RightHand"}), (LinkPairs{{1, 3}}));
  EXPECT_EQ(leftOutBy({"Left*:RightHand,Root:LeftHand"}), (LinkPairs{{1, 3}, {2, 3}, {0, 1}}));
  EXPECT_EQ(leftOutBy({"Left*:Left*"}), (LinkPairs{{1, 2}, {2, 1}}));
  EXPECT_EQ(leftOutBy({"Root:LeftHand", "R:Thumb:Root"}), (LinkPairs{{0, 1}, {4, 0}}));
  EXPECT_EQ(leftOutBy({"Root:*"}), (LinkPairs{{0, 1}, {0, 2}, {0, 3}, {0, 4}}));
  EXPECT_TRUE(leftOutBy({}).empty());
}

void expectRefusal(const std::string& text, ErrorCode code, const std::string& about) {
  const auto read = parseLeftOut("--leave-out", {text}, row());
  ASSERT_FALSE(read.ok()) << text;
  EXPECT_EQ(read.error().code, code) << describe(read.error());
  EXPECT_EQ(read.error().file, "--leave-out");
  EXPECT_NE(read.error().message.find(about), std::string::npos) << describe(read.error());
}

TEST(ParseLeftOut, RefusesWhatNamesNoPair) {
  expectRefusal("LeftHnd:Root", ErrorCode::UnknownName, "did you mean 'LeftHand'");
  expectRefusal("Root:Empty", ErrorCode::UnknownName, "no link with LSS");
  expectRefusal("LeftHand", ErrorCode::Syntax, "expected two links");
  expectRefusal("", ErrorCode::Syntax, "expected two links");
  expectRefusal("LeftHand:LeftHand", ErrorCode::Mismatch, "two different links");
  expectRefusal("Root:", ErrorCode::UnknownName, "'' of 'Root:'");
}

TEST(AddUsualPoses, SpreadsThemOverALongClip) {
  std::vector<double> places;
  for (int i = 0; i < 5000; ++i) places.push_back(1e-3 * i);
  const ReplayInputs inputs = test::smallInputs(places);
  std::vector<Pose> poses;
  ASSERT_TRUE(addUsualPoses(inputs.avatar, inputs.clip, inputs.match, "clip", poses).ok());
  ASSERT_EQ(poses.size(), kMostUsualPoses);
  EXPECT_NEAR(poses.front().translations[0].x(), 0.0, 1e-9);
  EXPECT_NEAR(poses[1000].translations[0].x(), 2.5, 1e-9);
  EXPECT_NEAR(poses.back().translations[0].x(), 4.997, 1e-9);

  poses.clear();
  const ReplayInputs few = test::smallInputs({0, 1, 2});
  ASSERT_TRUE(addUsualPoses(few.avatar, few.clip, few.match, "clip", poses).ok());
  EXPECT_EQ(poses.size(), 3u);
}

TEST(ReasonsOf, CountsEachReason) {
  const Avatar avatar = row();
  const PairRules rules = PairRules::leavingOut(avatar, {{0, 1, PairReason::Adjacent},
                                                         {0, 2, PairReason::Adjacent},
                                                         {1, 2, PairReason::User}})
                              .value();
  EXPECT_EQ(reasonsOf(rules), "2 adjacent, 1 user");
}

}  // namespace
}  // namespace foretouch::tools
