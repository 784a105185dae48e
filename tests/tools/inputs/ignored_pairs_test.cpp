#include "tools/inputs/ignored_pairs.h"

#include <gtest/gtest.h>

#include "assets/near_names.h"

namespace foretouch::tools {
namespace {

Skeleton skeletonOf(const std::vector<std::string>& names) {
  RawSkeleton raw;
  for (const std::string& name : names) {
    RawJoint joint;
    joint.name = name;
    raw.joints.push_back(joint);
  }
  return Skeleton::build(raw).value();
}

const std::vector<std::string> kObjects{"floor", "table", "chair_1", "chair_2", "floor"};

/// "link:object" by number, in order; an object of -1 is every one.
std::string pairsOf(const std::vector<std::string>& texts,
                    const std::vector<std::string>& links = {"Hips", "LeftFoot", "LeftHand"}) {
  const auto parsed = parseIgnoredPairs(texts, skeletonOf(links), kObjects);
  if (!parsed.ok()) return parsed.error().message;
  std::string text;
  for (const IgnoredPair& pair : parsed.value()) {
    text += std::to_string(pair.link) + ":" + std::to_string(pair.object) + " ";
  }
  return text;
}

TEST(ParseIgnoredPairs, ReadsLinksAndLinksWithObjects) {
  EXPECT_EQ(pairsOf({}), "");
  EXPECT_EQ(pairsOf({"LeftFoot"}), "1:-1 ");
  EXPECT_EQ(pairsOf({"LeftFoot:table"}), "1:1 ");
  EXPECT_EQ(pairsOf({"LeftHand:table,Hips"}), "0:-1 2:1 ");
  EXPECT_EQ(pairsOf({"LeftHand:table", "Hips"}), "0:-1 2:1 ");
}

TEST(ParseIgnoredPairs, TakesEveryObjectOfARepeatedName) {
  EXPECT_EQ(pairsOf({"Hips:floor"}), "0:0 0:4 ");
}

TEST(ParseIgnoredPairs, ExpandsTrailingStars) {
  EXPECT_EQ(pairsOf({"Left*"}), "1:-1 2:-1 ");
  EXPECT_EQ(pairsOf({"*"}), "0:-1 1:-1 2:-1 ");
  EXPECT_EQ(pairsOf({"Hips:chair_*"}), "0:2 0:3 ");
  EXPECT_EQ(pairsOf({"*:table"}), "0:1 1:1 2:1 ");
  EXPECT_EQ(pairsOf({"Hips:*"}), "0:-1 ");
}

TEST(ParseIgnoredPairs, SortsAndDropsRepetitions) {
  EXPECT_EQ(pairsOf({"LeftHand,Hips", "Left*,LeftHand"}), "0:-1 1:-1 2:-1 ");
}

TEST(ParseIgnoredPairs, ReadsNamesThatContainColons) {
  const std::vector<std::string> links{"rig:Hips", "rig:Hand", "rig"};
  EXPECT_EQ(pairsOf({"rig:Hips"}, links), "0:-1 ");
  EXPECT_EQ(pairsOf({"rig:Hips:table"}, links), "0:1 ");
  EXPECT_EQ(pairsOf({"rig:H*"}, links), "0:-1 1:-1 ");
  EXPECT_EQ(pairsOf({"rig:table"}, links), "2:1 ");
}

TEST(ParseIgnoredPairs, RefusesTwoReadings) {
  const std::string message = pairsOf({"rig:table"}, {"rig", "rig:table"});
  EXPECT_NE(message.find("more than one way"), std::string::npos) << message;
}

TEST(ParseIgnoredPairs, RefusesUnknownNamesAndListsNearOnes) {
  EXPECT_EQ(pairsOf({"LeftHnd"}), "'LeftHnd' is no link of the avatar; did you mean 'LeftHand'?");
  EXPECT_EQ(pairsOf({"Hips:tabel"}),
            "'tabel' of 'Hips:tabel' is no object of the scene; did you mean 'table'?");
  EXPECT_EQ(pairsOf({"Hips,,LeftFoot"}), "'' is no link of the avatar");
  EXPECT_EQ(pairsOf({"Zebra*"}), "'Zebra*' is no link of the avatar");
  EXPECT_EQ(pairsOf({"lefthand:table"}),
            "'lefthand' is no link of the avatar; did you mean 'LeftHand'?");
}

TEST(ParseIgnoredPairs, RefusesListsTooLongForAQuery) {
  std::vector<std::string> links, objects;
  for (int i = 0; i < 400; ++i) links.push_back("link" + std::to_string(i));
  for (int i = 0; i < 400; ++i) objects.push_back("object" + std::to_string(i));
  const Skeleton skeleton = skeletonOf(links);
  EXPECT_EQ(parseIgnoredPairs({"*:object1*"}, skeleton, objects).value().size(), 400u * 111u);
  const auto tooMany = parseIgnoredPairs({"*:object*"}, skeleton, objects);
  ASSERT_FALSE(tooMany.ok());
  EXPECT_EQ(tooMany.error().code, ErrorCode::LimitExceeded);
  EXPECT_EQ(parseIgnoredPairs({"*:*"}, skeleton, objects).value().size(), 400u);
}

TEST(DidYouMean, OffersTheNearestThreeOnce) {
  EXPECT_EQ(didYouMean("chair", {"chairs", "char", "chair_1", "table", "char", "choir"}),
            "; did you mean 'chairs', 'char', 'choir'?");
  EXPECT_EQ(didYouMean("x", {"zebra"}), "");
}

TEST(DidYouMean, PassesOverVeryLongNames) {
  const std::string longName(100'000, 'a');
  EXPECT_EQ(didYouMean(longName, {longName}), "");
  EXPECT_EQ(didYouMean("aaa", {longName}), "");
}

}  // namespace
}  // namespace foretouch::tools
