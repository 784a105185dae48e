#include "bench/solid/touch_trials.h"

#include <gtest/gtest.h>

namespace foretouch::tools {
namespace {

TEST(TouchTrials, AHandThatSlidesIsToldOnWhatAtAnyRate) {
  for (const double rateHz : {90.0, 30.0, 10.0}) {
    const auto tally = trySlide({}, rateHz, 1);
    ASSERT_TRUE(tally.ok());
    EXPECT_GE(10 * tally.value().ratio.size(), 9 * tally.value().shown.size()) << rateHz;
    EXPECT_EQ(tally.value().way.violations(), 0U) << rateHz;
  }
}

}  // namespace
}  // namespace foretouch::tools
