// Whatever comes, in whatever order.
#include <cstdint>
#include <set>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "network/stream/avatar_stream.h"
#include "tests/network/small_stream.h"
#include "tests/network/stream_fixture.h"
#include "tests/support/random_geometry.h"

namespace foretouch {
namespace {

using test::kLeast;
using test::kMost;
using test::kStepUs;
using test::poseMessage;
using test::Random;
using test::skeletonMessage;
using test::smallAvatar;
using test::smallSkeleton;

PoseMessage randomPose(Random& random, const RawSkeleton& skeleton, std::int64_t clock) {
  const auto near = [&](std::int64_t middle, int spread) {
    return middle + random.below(2 * spread + 1) - spread;
  };
  const auto extreme = [&] { return random.chance(0.5) ? kLeast : kMost; };
  PoseMessage message = poseMessage(skeleton, near(clock, 3), near(clock, 2) * kStepUs,
                                    random.chance(0.95) ? clock / 50 : near(clock / 50, 1));
  if (random.chance(0.02)) message.sequence = extreme();
  if (random.chance(0.02)) message.utimeUs = extreme();
  if (random.chance(0.005)) message.session = extreme();
  if (random.chance(0.05)) message.skeletonHash ^= 1;
  if (random.chance(0.05)) message.joints[0].joint = random.below(8) - 2;
  if (random.chance(0.05)) message.joints[1].rotation.w() = random.uniform(-3.0, 3.0);
  if (random.chance(0.2)) message.joints.pop_back();
  return message;
}

void expectFollows(const StreamStep& last, const StreamStep& step) {
  if (step.kind == StepKind::First) {
    EXPECT_EQ(step.from, step.to);
    return;
  }
  EXPECT_EQ(step.session, last.session);
  EXPECT_EQ(step.skeletonHash, last.skeletonHash);
  EXPECT_EQ(step.sequenceFrom, last.sequenceTo);
  EXPECT_EQ(step.utimeFromUs, last.utimeToUs);
  EXPECT_GT(step.sequenceTo, step.sequenceFrom);
  EXPECT_GT(step.utimeToUs, step.utimeFromUs);
  if (step.kind == StepKind::Consecutive) {
    EXPECT_EQ(step.sequenceTo - 1, step.sequenceFrom);
  }
}

TEST(StreamProperty, EveryPoseIsAnsweredOnceInOrderOrRefusedForAReason) {
  std::uint64_t accepted = 0, taken = 0;
  RejectCounts seen{};
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    AvatarStream stream = AvatarStream::make(smallAvatar(), {}).value();
    const RawSkeleton skeletons[] = {smallSkeleton(), [] {
                                       RawSkeleton longer = smallSkeleton();
                                       longer.joints[1].offset.y() *= 2.0;
                                       return longer;
                                     }()};
    std::set<std::tuple<std::int64_t, std::int64_t, std::int64_t>> answered;
    std::uint64_t refusedSkeletons = 0;
    StreamStep step, last;
    for (std::int64_t clock = 0; clock < 200; ++clock) {
      if (random.chance(0.1)) {
        const Reject reject =
            stream.take(skeletonMessage(skeletons[random.below(2)], clock / 50, random.below(4)));
        if (reject != Reject::None) ++refusedSkeletons;
      }
      const PoseMessage message = randomPose(random, skeletons[random.below(2)], clock);
      const Reject reject = stream.take(message, step);
      if (reject != Reject::None) continue;
      EXPECT_TRUE(answered.emplace(message.session, message.sequence, message.utimeUs).second);
      EXPECT_EQ(step.sequenceTo, message.sequence);
      expectFollows(last, step);
      last = step;
    }
    const StreamCounts& counts = stream.counts();
    std::uint64_t rejects = 0;
    for (const std::uint64_t count : counts.rejects) rejects += count;
    EXPECT_EQ(counts.poses, 200U);
    EXPECT_EQ(counts.poses, counts.accepted + rejects - refusedSkeletons);
    EXPECT_EQ(counts.accepted, answered.size());
    accepted += counts.accepted;
    taken += counts.poses;
    for (std::size_t i = 0; i < kNumRejects; ++i) seen[i] += counts.rejects[i];
  }
  EXPECT_GT(accepted, taken / 20);
  EXPECT_LT(accepted, taken / 2);
  for (const Reject reject :
       {Reject::BadIndex, Reject::NonUnit, Reject::OldGeneration, Reject::UnknownSkeleton,
        Reject::SkeletonMismatch, Reject::Duplicate, Reject::OutOfOrder, Reject::StaleStamp,
        Reject::FutureStamp, Reject::OldSession}) {
    EXPECT_GT(seen[static_cast<std::size_t>(reject)], 0U) << toString(reject);
  }
}

}  // namespace
}  // namespace foretouch
