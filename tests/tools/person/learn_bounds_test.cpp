// Oracle: hips that accelerate evenly along x are a parabola, which strays from its chord by a
// T^2 / 8.
#include "tools/person/learn_bounds.h"

#include <vector>

#include <gtest/gtest.h>

#include "assets/avatar/avatar_file.h"
#include "assets/bvh/bvh_reader.h"
#include "tests/tools/small_world.h"

namespace foretouch::tools {
namespace {

constexpr double kAcceleration = 2.0;

Clip parabola() {
  std::vector<double> places;
  for (int i = 0; i <= 60; ++i) places.push_back(0.5 * kAcceleration * 0.01 * i * i);
  return parseBvh(test::clipAlongX(places), "clip.bvh").value();
}

/// Of all links at 5 poses per second, of a clip with ten.
BoundEntry learned(const Clip& clip) {
  LearnRequest request;
  request.models = {MotionModel::ConstantRate};
  request.ratesHz = {5.0};
  request.quantile = 1.0;
  BoundsLearner learner(request);
  EXPECT_EQ(learner.learn(clip, parseAvatar(test::kManAvatar, "man.json").value()), 1);
  const BoundsFile file = learner.bounds();
  EXPECT_FALSE(file.entries.empty());
  return file.entries.empty() ? BoundEntry{} : file.entries.front();
}

TEST(BoundsLearner, FindsTheAccelerationOfAParabola) {
  EXPECT_NEAR(learned(parabola()).bound.acceleration, kAcceleration, 1e-4);
}

TEST(BoundsLearner, LearnsNothingOfMadeUpPoses) {
  Clip clip = parabola();
  const std::int64_t all = learned(clip).count;
  for (std::size_t frame = 30; frame <= 32; ++frame) {
    clip.frames[frame].translations[0].y() = 7.0;
  }
  EXPECT_GT(learned(clip).bound.acceleration, 100.0);
  clip.gaps = {{30, 32}};
  EXPECT_NEAR(learned(clip).bound.acceleration, kAcceleration, 1e-4);
  EXPECT_LT(learned(clip).count, all);
  EXPECT_GT(learned(clip).count, 0);
}

}  // namespace
}  // namespace foretouch::tools
