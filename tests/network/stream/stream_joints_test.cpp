// What a stream knows of joints, as docs/streaming.md, "Joints", has it; and that its poses are
// those of a replay.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "articulated/clip.h"
#include "assets/avatar/joint_match.h"
#include "tests/network/small_stream.h"
#include "tests/network/stream_fixture.h"
#include "tests/support/random_geometry.h"

namespace foretouch {
namespace {

using test::kStepUs;
using test::nthPose;
using test::poseMessage;
using test::Random;
using test::smallAvatar;
using test::smallSkeleton;

class StreamJoints : public test::StreamFixture {};

TEST_F(StreamJoints, KnowsALinkWhoseJointsAreAllKnownInBothPoses) {
  follow(1);
  EXPECT_EQ(*step_.unknown, std::vector<UndecidedReason>(4, UndecidedReason::None));
  PoseMessage inferred = nthPose(2);
  for (PoseJoint& joint : inferred.joints) joint.flags = kJointValid | kJointInferred;
  ASSERT_EQ(take(inferred), Reject::None);
  EXPECT_EQ(*step_.unknown, std::vector<UndecidedReason>(4, UndecidedReason::None));
}

TEST_F(StreamJoints, KnowsNothingBelowAJointThatIsNot) {
  struct Case {
    std::uint8_t flags;
    UndecidedReason reason;
  };
  std::int64_t n = 1;
  follow(0);
  for (const Case& c :
       {Case{0, UndecidedReason::InvalidJoint}, Case{kJointTracked, UndecidedReason::InvalidJoint},
        Case{kJointValid, UndecidedReason::StaleJoint}}) {
    PoseMessage message = nthPose(n++);
    message.joints[test::kArm].flags = c.flags;
    ASSERT_EQ(take(message), Reject::None);
    for (int pose = 0; pose < 2; ++pose) {  // it is the later pose's, then the earlier one's
      EXPECT_EQ(unknown(test::kHips), UndecidedReason::None);
      EXPECT_EQ(unknown(test::kArm), c.reason);
      EXPECT_EQ(unknown(test::kHand), c.reason);
      EXPECT_EQ(unknown(test::kLeg), UndecidedReason::None);
      ASSERT_EQ(take(nthPose(n++)), Reject::None);
    }
    EXPECT_EQ(unknown(test::kHand), UndecidedReason::None);
  }
}

TEST_F(StreamJoints, NamesTheReasonNearestToTheLink) {
  follow(0);
  PoseMessage message = nthPose(1);
  message.joints[test::kHips].flags = 0;
  message.joints[test::kArm].flags = kJointValid;
  message.joints.erase(message.joints.begin() + test::kHand);
  ASSERT_EQ(take(message), Reject::None);
  EXPECT_EQ(unknown(test::kHips), UndecidedReason::InvalidJoint);
  EXPECT_EQ(unknown(test::kArm), UndecidedReason::StaleJoint);
  EXPECT_EQ(unknown(test::kHand), UndecidedReason::MissingJoint);
  EXPECT_EQ(unknown(test::kLeg), UndecidedReason::InvalidJoint);
}

TEST_F(StreamJoints, HoldsWhatIsUnknownAtItsLastKnownValue) {
  ASSERT_EQ(say(skeleton_), Reject::None);
  PoseMessage message = nthPose(0);
  message.joints[test::kHand].flags = 0;
  message.joints[test::kHand].rotation = Quaternion(0.0, 1.0, 0.0, 0.0);
  ASSERT_EQ(take(message), Reject::None);
  const auto hand = [&] { return step_.to->rotations[test::kHand].coeffs(); };
  EXPECT_EQ(hand(), skeleton_.joints[test::kHand].rotation.coeffs());  // never known
  message = nthPose(1);
  message.joints[test::kHand].rotation = Quaternion(0.0, 0.0, 1.0, 0.0);
  ASSERT_EQ(take(message), Reject::None);
  for (std::int64_t n = 2; n < 5; ++n) {
    message = nthPose(n);
    message.joints.pop_back();
    message.joints.erase(message.joints.begin() + test::kHand);
    ASSERT_EQ(take(message), Reject::None);
    EXPECT_EQ(hand(), Quaternion(0.0, 0.0, 1.0, 0.0).coeffs());
  }
}

TEST_F(StreamJoints, DoesNotKnowAJointThatTheSenderLacks) {
  RawSkeleton three = skeleton_;
  three.joints.erase(three.joints.begin() + test::kArm);  // Hips, Hand, Leg
  three.joints[1].parent = 0;
  three.joints[2].parent = 0;
  const auto firstOf = [&](bool unmatchedAtRest) {
    StreamPolicy policy;
    policy.unmatchedAtRest = unmatchedAtRest;
    stream_ = AvatarStream::make(smallAvatar(), policy).value();
    EXPECT_EQ(say(three), Reject::None);
    EXPECT_EQ(take(poseMessage(three, 0, 0)), Reject::None);
    return *step_.unknown;
  };
  using R = UndecidedReason;
  EXPECT_EQ(firstOf(false),
            (std::vector<R>{R::None, R::UnmatchedJoint, R::UnmatchedJoint, R::None}));
  EXPECT_EQ(firstOf(true), std::vector<R>(4, R::None));
  EXPECT_EQ(step_.to->translations[test::kArm], skeleton_.joints[test::kArm].offset);
}

TEST_F(StreamJoints, DoesNotTakeTheRestOffsetForATranslationThatWasNotSent) {
  follow(1);
  PoseMessage without = nthPose(2);
  without.translations.clear();
  ASSERT_EQ(take(without), Reject::None);
  EXPECT_EQ(unknown(test::kHips), UndecidedReason::MissingJoint);
  EXPECT_EQ(step_.to->translations[0], nthPose(1).translations[0].translation);
  ASSERT_EQ(take(nthPose(3)), Reject::None);
  EXPECT_EQ(unknown(test::kHips), UndecidedReason::MissingJoint);  // of the earlier pose
  ASSERT_EQ(take(nthPose(4)), Reject::None);
  EXPECT_EQ(unknown(test::kHips), UndecidedReason::None);
  // Another session owes nothing to this one.
  without = nthPose(0, 2);
  without.translations.clear();
  ASSERT_EQ(take(without), Reject::None);
  EXPECT_EQ(unknown(test::kHips), UndecidedReason::None);
  EXPECT_EQ(step_.to->translations[0], skeleton_.joints[0].offset);
  // What came before the first translation was not the rest offset for sure.
  ASSERT_EQ(take(nthPose(1, 2)), Reject::None);
  EXPECT_EQ(unknown(test::kHips), UndecidedReason::MissingJoint);
  ASSERT_EQ(take(nthPose(2, 2)), Reject::None);
  EXPECT_EQ(unknown(test::kHips), UndecidedReason::None);
}

// The same poses as a replay of a clip makes of them, bit for bit.

Clip randomClip(Random& random, int frames) {
  RawSkeleton raw = smallSkeleton();
  std::swap(raw.joints[1], raw.joints[3]);  // another order than the avatar's
  raw.joints[2].parent = 3;
  std::swap(raw.joints[2], raw.joints[3]);
  raw.joints[3].parent = 2;
  raw.joints.push_back({"Tail", 0, {0.0, 0.0, -0.2}, random.rotation()});
  Clip clip{Skeleton::build(raw).value(), 0.01, {}, {}, {}, {}, {}};
  clip.hasRotation.assign(raw.joints.size(), true);
  for (std::size_t j = 0; j < raw.joints.size(); ++j) {
    clip.hasTranslation.push_back(j == 0 || random.chance(0.5));
  }
  for (int f = 0; f < frames; ++f) {
    Pose pose;
    for (std::size_t j = 0; j < raw.joints.size(); ++j) {
      Quaternion q = random.rotation();
      q.coeffs() *= 1.0 + random.uniform(-9e-4, 9e-4);
      pose.rotations.push_back(q);
      pose.translations.push_back(raw.joints[j].offset + random.inBox(0.3));
    }
    clip.frames.push_back(pose);
  }
  return clip;
}

bool areSameBits(const Pose& x, const Pose& y) {
  const auto same = [](const auto& a, const auto& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
  };
  return same(x.rotations, y.rotations) && same(x.translations, y.translations);
}

TEST_F(StreamJoints, MakesOfAClipsFramesWhatAReplayMakesOfThem) {
  Random random(7);
  const Clip clip = randomClip(random, 40);
  const Skeleton avatar = smallAvatar().skeleton();
  const JointMatch match = matchJoints(avatar, clip.skeleton).value();
  RawSkeleton said;
  for (JointId j = 0; j < clip.skeleton.numJoints(); ++j) {
    said.joints.push_back({clip.skeleton.name(j), clip.skeleton.parent(j),
                           clip.skeleton.restOffset(j), clip.skeleton.restRotation(j)});
  }
  ASSERT_EQ(say(said), Reject::None);
  Pose before;
  for (std::size_t f = 0; f < clip.frames.size(); ++f) {
    PoseMessage message =
        poseMessage(said, static_cast<std::int64_t>(f), static_cast<std::int64_t>(f) * kStepUs);
    message.translations.clear();
    for (std::size_t j = 0; j < said.joints.size(); ++j) {
      const auto joint = static_cast<std::int32_t>(j);
      message.joints[j].rotation = clip.frames[f].rotations[j];
      if (clip.hasTranslation[j]) {
        message.translations.push_back({joint, clip.frames[f].translations[j]});
      }
    }
    std::reverse(message.joints.begin(), message.joints.end());
    ASSERT_EQ(take(message), Reject::None);
    const Pose expected = validatedPose(avatar, poseOfAvatar(avatar, clip, match, f)).value();
    EXPECT_TRUE(areSameBits(*step_.to, expected)) << "frame " << f;
    EXPECT_TRUE(areSameBits(*step_.from, f > 0 ? before : expected)) << "frame " << f;
    EXPECT_EQ(*step_.unknown, std::vector<UndecidedReason>(4, UndecidedReason::None));
    before = expected;
  }
}

}  // namespace
}  // namespace foretouch
