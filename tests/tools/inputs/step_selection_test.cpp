#include "tools/inputs/step_selection.h"

#include <cmath>

#include <gtest/gtest.h>

namespace foretouch::tools {
namespace {

TEST(SelectSteps, UsesEveryFrameWithoutARate) {
  const StepSelection steps = selectSteps(10, 1.0 / 60.0, std::nullopt, kAnyStride).value();
  EXPECT_EQ(steps.stride, 1);
  EXPECT_EQ(steps.count, 9);
}

TEST(SelectSteps, KeepsEveryKthFrame) {
  const StepSelection steps = selectSteps(100, 1.0 / 60.0, 10.0, kAnyStride).value();
  EXPECT_EQ(steps.stride, 6);
  EXPECT_EQ(steps.count, 16);  // frames 0, 6, ..., 96; the last three are no whole step
}

TEST(SelectSteps, TakesFrameTimesThatArePrintedWithFewDigits) {
  EXPECT_EQ(selectSteps(9, 0.0333667, 29.97, kAnyStride).value().stride, 1);
  EXPECT_EQ(selectSteps(9, 0.0333667, 30.0, kAnyStride).value().stride, 1);  // 29.97 is meant
  EXPECT_EQ(selectSteps(9, 0.0083333, 120.0, kAnyStride).value().stride, 1);
  EXPECT_EQ(selectSteps(9, 0.00833299, 120.005, kAnyStride).value().stride, 1);
  EXPECT_EQ(selectSteps(99, 0.0083333, 10.0, kAnyStride).value().stride, 12);
  EXPECT_EQ(selectSteps(99, 0.0333667, 10.0, kAnyStride).value().stride, 3);
}

TEST(SelectSteps, RefusesARateAboveTheClipsOwnAndSaysIt) {
  const auto steps = selectSteps(100, 1.0 / 60.0, 61.0, kAnyStride);
  ASSERT_FALSE(steps.ok());
  EXPECT_NE(steps.error().message.find("60 Hz"), std::string::npos) << steps.error().message;
  EXPECT_TRUE(selectSteps(100, 1.0 / 60.0, 60.5, kAnyStride).ok());
}

TEST(SelectSteps, RefusesClipsWithoutAWholeStep) {
  EXPECT_FALSE(selectSteps(0, 0.1, std::nullopt, kAnyStride).ok());
  EXPECT_FALSE(selectSteps(1, 0.1, std::nullopt, kAnyStride).ok());
  EXPECT_FALSE(selectSteps(6, 0.1, 1.0, kAnyStride).ok());  // a step takes ten frames
  EXPECT_EQ(selectSteps(11, 0.1, 1.0, kAnyStride).value().count, 1);
  EXPECT_FALSE(selectSteps(11, 0.1, 1e-300, kAnyStride).ok());
}

TEST(SelectSteps, TakesNoStepInWhichAJointTurnsTooFarForTheShorterArc) {
  for (const auto& [turn, stride] :
       {std::pair{0.0, 10}, {0.29, 10}, {0.4, 7}, {2.0, 1}, {2.9, 1}}) {
    Clip clip;
    clip.frameTimeS = 0.1;
    clip.frames.resize(101);
    clip.mostTurn = turn;
    const StepSelection steps = selectSteps(clip, 1.0).value();
    EXPECT_EQ(steps.stride, stride) << turn;
    EXPECT_EQ(steps.count, 100 / stride);
    const auto remark = remarkOnRate(steps, clip, 1.0);
    ASSERT_EQ(remark.has_value(), stride != 10);
    if (!remark) continue;
    EXPECT_NE(remark->find("a joint would turn"), std::string::npos) << *remark;
  }
}

TEST(SelectSteps, StaysWithinTheClipForAnyRate) {
  int several = 0;
  for (int i = 1; i <= 2000; ++i) {
    const double rate = 0.06 * i;
    const auto steps = selectSteps(1000, 1.0 / 120.0, rate, kAnyStride);
    if (!steps.ok()) continue;
    const StepSelection& s = steps.value();
    EXPECT_EQ(s.stride, std::max(1L, std::lround(120.0 / rate)));
    EXPECT_LE(s.stride * s.count, 999);
    EXPECT_GT(s.stride * (s.count + 1), 999);
    several += s.stride > 1 ? 1 : 0;
  }
  EXPECT_GT(several, 1000);
}

}  // namespace
}  // namespace foretouch::tools
