#include "bench/solid/finger_trials.h"

#include <gtest/gtest.h>

#include "articulated/skeleton.h"

namespace foretouch::tools {
namespace {

TEST(FingerTrials, HandsAreThoseOfOpenXr) {
  const Avatar pair = handPair();
  EXPECT_EQ(pair.numLinks(), 2 * 26);
  // As in a mirror, and wrists apart.
  const LinkId half = pair.numLinks() / 2;
  for (LinkId link = 0; link < half; ++link) {
    const Eigen::Vector3d right = pair.skeleton().restOffset(link),
                          left = pair.skeleton().restOffset(link + half);
    EXPECT_EQ(right.x(), -left.x()) << link;
    EXPECT_EQ(right.tail(2), left.tail(2)) << link;
  }
}

TEST(FingerTrials, NothingIsPassedAndWhatIsFreeIsShown) {
  const auto tallies = tryFingers({});
  ASSERT_TRUE(tallies.ok());
  EXPECT_EQ(tallies.value().size(), 5U);
  for (const FingerTally& tally : tallies.value()) {
    EXPECT_EQ(tally.way.violations(), 0U) << tally.task;
    EXPECT_EQ(tally.way.uncertified, 0U) << tally.task;
    EXPECT_EQ(tally.way.appeared, 1U) << tally.task;
    // They come from where nothing is, and end in something.
    EXPECT_GT(tally.equal, 20U) << tally.task;
    EXPECT_GT(tally.contactUs.size(), tally.ticks / 5) << tally.task;
    EXPECT_GT(tally.way.instants, 50 * tally.way.moved) << tally.task;
  }
}

}  // namespace
}  // namespace foretouch::tools
