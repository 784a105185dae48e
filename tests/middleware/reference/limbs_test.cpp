// How links are grouped: chains between branchings, trees, bare links, and skeletons that are all
// one chain.
#include "tests/reference/limbs.h"

#include <string>

#include <gtest/gtest.h>

namespace foretouch::internal {
namespace {

using Links = std::vector<LinkId>;

/// Parents, and which links have LSS ('x') and which have none ('.').
Avatar avatarOf(const std::vector<JointId>& parents, const std::string& lss) {
  RawSkeleton raw;
  std::vector<std::vector<Lss>> perLink(parents.size());
  for (std::size_t i = 0; i < parents.size(); ++i) {
    raw.joints.push_back({"joint" + std::to_string(i), parents[i], Eigen::Vector3d(0, 0.1, 0),
                          Quaternion::Identity()});
    if (lss[i] == 'x') perLink[i].push_back({{0, 0, 0}, {0, 0.1, 0}, 0.05});
  }
  return Avatar::build(Skeleton::build(raw).value(), perLink).value();
}

TEST(LimbsOfAnAvatar, AreChainsBetweenBranchings) {
  // A trunk 0-1-2, two arms from 2: 3-4 and 5-6; the second ends in fingers 7-8 and 9.
  const Limbs limbs(avatarOf({-1, 0, 1, 2, 3, 2, 5, 6, 7, 6}, "xxxxxxxxxx"));
  ASSERT_EQ(limbs.limbs().size(), 5U);
  EXPECT_EQ(limbs.limbs()[0].links, (Links{0, 1, 2}));
  EXPECT_EQ(limbs.limbs()[1].links, (Links{3, 4}));
  EXPECT_EQ(limbs.limbs()[2].links, (Links{5, 6}));
  EXPECT_EQ(limbs.limbs()[3].links, (Links{7, 8}));
  EXPECT_EQ(limbs.limbs()[4].links, (Links{9}));
  EXPECT_EQ(limbs.limbs()[2].carrier, 5);
  ASSERT_EQ(limbs.trees().size(), 1U);
  EXPECT_EQ(limbs.trees()[0].limbs.size(), 5U);
  EXPECT_EQ(limbs.trees()[0].links.size(), 10U);
}

TEST(LimbsOfAnAvatar, DoNotBranchWhereOnlyBareLinksDo) {
  // 3 and 4 are end sites.
  const Limbs limbs(avatarOf({-1, 0, 1, 1, 2}, "xxx.."));
  ASSERT_EQ(limbs.limbs().size(), 1U);
  EXPECT_EQ(limbs.limbs()[0].links, (Links{0, 1, 2}));
}

TEST(LimbsOfAnAvatar, AreCarriedByTheirFirstLinkEvenWhereItIsBare) {
  // A bare root with two legs, the second of which begins bare.
  const Limbs limbs(avatarOf({-1, 0, 0, 2}, ".x.x"));
  ASSERT_EQ(limbs.limbs().size(), 3U);
  EXPECT_TRUE(limbs.limbs()[0].links.empty());
  EXPECT_EQ(limbs.limbs()[2].carrier, 2);
  EXPECT_EQ(limbs.limbs()[2].links, (Links{3}));
  EXPECT_EQ(limbs.trees()[0].limbs, (std::vector<std::int32_t>{1, 2}));
}

TEST(LimbsOfAnAvatar, HaveATreeForEveryRootThatCounts) {
  const Limbs limbs(avatarOf({-1, 0, -1, -1, 3}, "xx..x"));
  ASSERT_EQ(limbs.trees().size(), 2U);
  EXPECT_EQ(limbs.trees()[0].root, 0);
  EXPECT_EQ(limbs.trees()[1].root, 3);
  EXPECT_EQ(limbs.trees()[1].links, (Links{4}));
}

TEST(LimbsOfAnAvatar, OfOneChainOrOneLinkAreOne) {
  std::vector<JointId> parents;
  for (JointId j = 0; j < 128; ++j) parents.push_back(j - 1);
  const Limbs chain(avatarOf(parents, std::string(128, 'x')));
  ASSERT_EQ(chain.limbs().size(), 1U);
  EXPECT_EQ(chain.limbs()[0].links.size(), 128U);
  EXPECT_EQ(Limbs(avatarOf({-1}, "x")).limbs().size(), 1U);
}

}  // namespace
}  // namespace foretouch::internal
