// Brackets allocate nothing once a thread's memory has grown. Of a program that counts the calls of
// malloc.
#include <vector>

#include <gtest/gtest.h>

#include "middleware/bracket/bracket.h"
#include "tests/middleware/random_scene.h"
#include "tests/support/allocation_count.h"

namespace foretouch {
namespace {

TEST(BracketAllocations, StopOnceTheMemoryHasGrown) {
  if (!test::countsAllocations()) GTEST_SKIP() << "this build has an allocator of its own";
  constexpr std::size_t kPoses = 30;
  test::Random random(7);
  const Scene scene = Scene::build(test::clutter(random, 500, 3, Eigen::Vector3d::Zero())).value();
  const test::RandomBody body = test::bodyInClutter(random, 8, Eigen::Vector3d::Zero());
  std::vector<Pose> poses{body.from};
  while (poses.size() < kPoses) {
    poses.push_back(poses.back());
    for (Quaternion& rotation : poses.back().rotations) {
      rotation = (rotation * random.turn(0.3)).normalized();
    }
  }
  BracketOptions options;
  options.self = PairRules::derive(body.avatar).value();
  const BracketQuery query = BracketQuery::build(body.avatar, scene, options).value();
  LinkBound bound;
  bound.acceleration = bound.speed = bound.aheadAcceleration = 2.0;
  bound.followFloor = 1e-4;
  bound.followShare = 1.0;
  const std::vector<LinkBound> bounds(8, bound);
  Scratch scratch;
  StepBrackets brackets;
  std::uint64_t before = 0;
  int certain = 0, excluded = 0;
  for (int round = 0; round < 3; ++round) {
    before = test::numAllocations();
    for (std::size_t i = 1; i + 2 < kPoses; ++i) {
      const PosedStep step{&poses[i - 1], &poses[i], &poses[i + 1], &poses[i + 2], 0.1, 0.1, 0.1};
      bool isAnswered = query.answer(step, MotionModel::CubicLate, bounds, scratch, brackets).ok();
      for (const LinkBracket& bracket : brackets.links) {
        certain += bracket.verdict == BracketVerdict::Certain ? 1 : 0;
        excluded += bracket.verdict == BracketVerdict::Excluded ? 1 : 0;
      }
      isAnswered = isAnswered && query.answerGap(step, bounds, scratch, brackets).ok();
      isAnswered = isAnswered && query.lookAhead(step, 0.2, bounds, scratch, brackets).ok();
      ASSERT_TRUE(isAnswered);
    }
  }
  EXPECT_EQ(test::numAllocations() - before, 0U);
  EXPECT_GT(certain, 10);
  EXPECT_GT(excluded, 10);
}

}  // namespace
}  // namespace foretouch
