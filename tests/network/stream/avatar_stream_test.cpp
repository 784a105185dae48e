// The rules of docs/streaming.md, "What is accepted", row by row.
#include "network/stream/avatar_stream.h"

#include <cstdint>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "tests/network/small_stream.h"
#include "tests/network/stream_fixture.h"
#include "tests/support/allocation_count.h"

namespace foretouch {
namespace {

using test::kLeast;
using test::kMost;
using test::kStepUs;
using test::nthPose;
using test::poseMessage;
using test::skeletonMessage;
using test::smallAvatar;
using test::smallSkeleton;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

class Stream : public test::StreamFixture {};

// A row each: what may be asked of a stream.

TEST(StreamPolicy, OutOfRangeIsAnErrorThatNamesTheField) {
  const auto fieldOf = [](std::int64_t maxStepUs, int confirmations) {
    StreamPolicy policy;
    policy.maxStepUs = maxStepUs;
    policy.confirmations = confirmations;
    const auto made = AvatarStream::make(smallAvatar(), policy);
    return made.ok() ? std::string() : made.error().file;
  };
  EXPECT_EQ(fieldOf(1, 1), "");
  EXPECT_EQ(fieldOf(86'400'000'000, 1000), "");
  EXPECT_EQ(fieldOf(0, 3), "maxStepUs");
  EXPECT_EQ(fieldOf(-5, 3), "maxStepUs");
  EXPECT_EQ(fieldOf(86'400'000'001, 3), "maxStepUs");
  EXPECT_EQ(fieldOf(1, 0), "confirmations");
  EXPECT_EQ(fieldOf(1, 1001), "confirmations");
}

// Skeletons.

TEST_F(Stream, RefusesASkeletonThatIsNone) {
  const auto refusal = [&](auto change) {
    RawSkeleton changed = smallSkeleton();
    change(changed);
    return say(changed);
  };
  EXPECT_EQ(refusal([](RawSkeleton& s) { s.joints.clear(); }), Reject::Limit);
  EXPECT_EQ(refusal([](RawSkeleton& s) { s.joints[1].name = "Hips"; }), Reject::BadName);
  EXPECT_EQ(refusal([](RawSkeleton& s) { s.joints[1].name.clear(); }), Reject::BadName);
  EXPECT_EQ(refusal([](RawSkeleton& s) { s.joints[1].name = "\x1b[2J"; }), Reject::BadName);
  EXPECT_EQ(refusal([](RawSkeleton& s) { s.joints[1].parent = 2; }), Reject::BadHierarchy);
  EXPECT_EQ(refusal([](RawSkeleton& s) { s.joints[1].parent = -7; }), Reject::BadHierarchy);
  EXPECT_EQ(refusal([](RawSkeleton& s) { s.joints[2].offset.x() = kNaN; }), Reject::NonFinite);
  EXPECT_EQ(refusal([](RawSkeleton& s) { s.joints[2].offset.x() = 2e7; }), Reject::OutOfRange);
  EXPECT_EQ(refusal([](RawSkeleton& s) { s.joints[2].rotation.w() = 2.0; }), Reject::NonUnit);
  EXPECT_EQ(refusal([](RawSkeleton& s) {
              for (RawJoint& joint : s.joints) joint.name += " of another";
            }),
            Reject::NoMatch);
  EXPECT_EQ(take(0, 0), Reject::UnknownSkeleton);  // none of them is in use
}

TEST_F(Stream, RefusesASkeletonWhoseHashIsNotItsOwn) {
  SkeletonMessage message = skeletonMessage(skeleton_);
  ++message.hash;
  EXPECT_EQ(stream_.take(message), Reject::BadHash);
  EXPECT_EQ(counted(Reject::BadHash), 1U);
}

TEST_F(Stream, RefusesPosesBeforeTheirSkeleton) {
  EXPECT_EQ(take(0, 0), Reject::UnknownSkeleton);
  ASSERT_EQ(say(skeleton_), Reject::None);
  EXPECT_EQ(take(0, 0), Reject::None);
  PoseMessage other = nthPose(1);
  ++other.skeletonHash;
  EXPECT_EQ(take(other), Reject::SkeletonMismatch);
}

TEST_F(Stream, GoesOnWhereTheSkeletonIsSaidAgain) {
  follow(0);
  ASSERT_EQ(say(skeleton_), Reject::None);
  ASSERT_EQ(say(skeleton_, 1, 4), Reject::None);  // counted up though nothing changed
  ASSERT_EQ(say(skeleton_, 0, 0), Reject::None);  // of old, but the same
  ASSERT_EQ(take(nthPose(1)), Reject::None);
  EXPECT_EQ(step_.kind, StepKind::Consecutive);
  EXPECT_EQ(stream_.counts().timelines, 1U);
}

TEST_F(Stream, BeginsATimelineWithAnotherSkeleton) {
  follow(0);
  RawSkeleton grown = skeleton_;
  grown.joints[2].offset.y() = 0.5;
  ASSERT_EQ(say(grown, 1, 1), Reject::None);
  ASSERT_EQ(take(nthPose(1)), Reject::None);  // until a pose of the new one comes
  EXPECT_EQ(step_.kind, StepKind::Consecutive);
  skeleton_ = grown;
  ASSERT_EQ(take(2, 2 * kStepUs), Reject::None);
  EXPECT_EQ(step_.kind, StepKind::First);
  EXPECT_EQ(step_.from, step_.to);
  EXPECT_EQ(step_.sequenceFrom, 2);
  EXPECT_EQ(step_.utimeFromUs, 2 * kStepUs);
  EXPECT_EQ(step_.lost, 0);
}

TEST_F(Stream, IsNotStoppedByASkeletonThatNobodyUses) {
  follow(5);
  RawSkeleton spoofed = skeleton_;
  spoofed.joints[2].offset.y() = 0.5;
  ASSERT_EQ(say(spoofed, kMost, 0), Reject::None);
  for (std::int64_t n = 6; n < 20; ++n) {
    ASSERT_EQ(take(nthPose(n)), Reject::None);
    EXPECT_EQ(step_.kind, StepKind::Consecutive);
  }
}

TEST_F(Stream, ReturnsToTheSkeletonWhosePosesGoOn) {
  follow(5);
  RawSkeleton spoofed = skeleton_;
  spoofed.joints[2].offset.y() = 0.5;
  ASSERT_EQ(say(spoofed, 1000, 0), Reject::None);
  ASSERT_EQ(take(poseMessage(spoofed, 0, kStepUs, 1000)), Reject::None);
  EXPECT_EQ(take(nthPose(6)), Reject::SkeletonMismatch);
  EXPECT_EQ(take(nthPose(6)), Reject::SkeletonMismatch);  // copies count once
  EXPECT_EQ(take(nthPose(7)), Reject::SkeletonMismatch);
  ASSERT_EQ(take(nthPose(8)), Reject::None);
  EXPECT_EQ(step_.kind, StepKind::First);
  ASSERT_EQ(take(nthPose(9)), Reject::None);
  EXPECT_EQ(step_.kind, StepKind::Consecutive);
  EXPECT_EQ(take(nthPose(9)), Reject::Duplicate);
}

TEST_F(Stream, FollowsAnotherSpeakerWhateverItsNumbersAre) {
  follow(5);
  stream_.changeSpeaker();
  EXPECT_EQ(take(nthPose(5)), Reject::Duplicate);
  ASSERT_EQ(take(0, -7, -3), Reject::None);  // an older session, an earlier clock
  EXPECT_EQ(step_.kind, StepKind::First);
  EXPECT_EQ(take(0, -8, -4), Reject::OldSession);  // of one speaker, order counts again
  RawSkeleton other = skeleton_;
  other.joints[2].offset.y() = 0.5;
  EXPECT_EQ(say(other, -9), Reject::OldSession);
  stream_.changeSpeaker();
  ASSERT_EQ(say(other, -9), Reject::None);
  ASSERT_EQ(take(poseMessage(other, 0, 0, -9)), Reject::None);
  EXPECT_EQ(step_.kind, StepKind::First);
}

TEST_F(Stream, CountsALeapOfNumbersApart) {
  follow(0);
  ASSERT_EQ(take(1'000'001, kStepUs), Reject::None);
  EXPECT_EQ(stream_.counts().lost, 1'000'000U);
  EXPECT_EQ(stream_.counts().vastGaps, 0U);
  ASSERT_EQ(take(kMost, 2 * kStepUs), Reject::None);
  EXPECT_EQ(step_.kind, StepKind::AcrossGap);
  EXPECT_EQ(stream_.counts().lost, 1'000'000U);
  EXPECT_EQ(stream_.counts().vastGaps, 1U);
  EXPECT_EQ(stream_.counts().gaps, 2U);
}

TEST_F(Stream, RefusesOldSkeletons) {
  ASSERT_EQ(say(skeleton_, 5, 5), Reject::None);
  RawSkeleton other = skeleton_;
  other.joints[2].offset.y() = 0.5;
  EXPECT_EQ(say(other, 4, 9), Reject::OldSession);
  EXPECT_EQ(say(other, 5, 4), Reject::OldGeneration);
  EXPECT_EQ(say(other, 5, 5), Reject::OldGeneration);  // two of one generation: the first stays
  // The same content in a later generation: what is older than that is older than what is in use.
  ASSERT_EQ(say(skeleton_, 5, 8), Reject::None);
  EXPECT_EQ(say(other, 5, 7), Reject::OldGeneration);
  EXPECT_EQ(say(other, 6, 0), Reject::None);
}

TEST_F(Stream, FollowsAnOldSkeletonThatIsSaidAgainAndAgain) {
  ASSERT_EQ(say(skeleton_, 0, 3), Reject::None);
  RawSkeleton other = skeleton_;
  other.joints[2].offset.y() = 0.5;
  SkeletonMessage message = skeletonMessage(other, 0, 0);
  for (int copy = 0; copy < 10; ++copy) {
    EXPECT_EQ(stream_.take(message), Reject::OldGeneration);  // copies count once
  }
  message.sendUtimeUs += 1'000'000;
  EXPECT_EQ(stream_.take(message), Reject::OldGeneration);
  message.sendUtimeUs += 1'000'000;
  EXPECT_EQ(stream_.take(message), Reject::None);
  skeleton_ = other;
  EXPECT_EQ(take(0, 0, 0), Reject::None);
}

TEST_F(Stream, StaysWithASkeletonWhosePosesStillCome) {
  ASSERT_EQ(say(skeleton_, 0, 3), Reject::None);
  RawSkeleton other = skeleton_;
  other.joints[2].offset.y() = 0.5;
  SkeletonMessage message = skeletonMessage(other, 0, 0);
  for (std::int64_t n = 0; n < 10; ++n) {
    message.sendUtimeUs = n;
    EXPECT_EQ(stream_.take(message), Reject::OldGeneration);
    ASSERT_EQ(take(n, n * kStepUs, 0), Reject::None);
  }
}

// What a pose holds.

TEST_F(Stream, RefusesAPoseOfJointsThatAreNotThere) {
  follow(0);
  const auto refusal = [&](auto change) {
    PoseMessage message = nthPose(1);
    change(message);
    return take(message);
  };
  EXPECT_EQ(refusal([](PoseMessage& m) { m.joints[2].joint = 4; }), Reject::BadIndex);
  EXPECT_EQ(refusal([](PoseMessage& m) { m.joints[2].joint = -1; }), Reject::BadIndex);
  EXPECT_EQ(refusal([](PoseMessage& m) { m.joints[2].joint = 1; }), Reject::BadIndex);  // twice
  EXPECT_EQ(refusal([](PoseMessage& m) { m.translations[0].joint = 4; }), Reject::BadIndex);
  EXPECT_EQ(refusal([](PoseMessage& m) { m.translations[0].joint = -1; }), Reject::BadIndex);
  EXPECT_EQ(refusal([](PoseMessage& m) { m.translations.push_back(m.translations[0]); }),
            Reject::BadIndex);
  EXPECT_EQ(refusal([](PoseMessage& m) { m.joints.erase(m.joints.begin()); }), Reject::BadIndex);
  ASSERT_EQ(take(nthPose(1)), Reject::None);
  EXPECT_EQ(step_.kind, StepKind::Consecutive);  // what was refused left no trace
}

TEST_F(Stream, RefusesNumbersThatAreNone) {
  follow(0);
  const auto refusal = [&](auto change) {
    PoseMessage message = nthPose(1);
    change(message);
    return take(message);
  };
  EXPECT_EQ(refusal([](PoseMessage& m) { m.joints[2].rotation.y() = kNaN; }), Reject::NonFinite);
  EXPECT_EQ(refusal([](PoseMessage& m) { m.joints[2].rotation.y() = 1e200; }), Reject::NonUnit);
  EXPECT_EQ(refusal([](PoseMessage& m) { m.joints[2].rotation.w() = 1.01; }), Reject::NonUnit);
  EXPECT_EQ(refusal([](PoseMessage& m) { m.joints[2].rotation.coeffs().setZero(); }),
            Reject::NonUnit);
  EXPECT_EQ(refusal([](PoseMessage& m) { m.joints[2].flags |= 8; }), Reject::OutOfRange);
  EXPECT_EQ(refusal([](PoseMessage& m) { m.translations[0].translation.z() = kInfinity; }),
            Reject::NonFinite);
  EXPECT_EQ(refusal([](PoseMessage& m) { m.translations[0].translation.z() = -1.1e7; }),
            Reject::OutOfRange);
  // Of a joint that is not valid nothing is read.
  EXPECT_EQ(refusal([](PoseMessage& m) {
              m.joints[0].flags = kJointTracked;
              m.joints[0].rotation.coeffs().setConstant(kNaN);
              m.translations[0].translation.setConstant(kNaN);
            }),
            Reject::None);
}

// Where a pose stands.

TEST_F(Stream, AnswersPosesThatFollowOneAnother) {
  follow(0);
  EXPECT_EQ(step_.kind, StepKind::First);
  ASSERT_EQ(take(1, kStepUs), Reject::None);
  EXPECT_EQ(step_.kind, StepKind::Consecutive);
  EXPECT_EQ(std::tie(step_.sequenceFrom, step_.sequenceTo), std::make_tuple(0, 1));
  EXPECT_EQ(std::tie(step_.utimeFromUs, step_.utimeToUs), std::make_tuple(0, kStepUs));
  EXPECT_NE(step_.from, step_.to);
  ASSERT_EQ(take(4, 4 * kStepUs), Reject::None);
  EXPECT_EQ(step_.kind, StepKind::AcrossGap);
  EXPECT_EQ(step_.lost, 2);
  EXPECT_EQ(stream_.counts().gaps, 1U);
  EXPECT_EQ(stream_.counts().lost, 2U);
  EXPECT_EQ(stream_.counts().accepted, 3U);
}

TEST_F(Stream, RefusesWhatHasBeenAnswered) {
  follow(300);
  EXPECT_EQ(take(nthPose(300)), Reject::Duplicate);
  EXPECT_EQ(take(nthPose(300 - 255)), Reject::Duplicate);
  EXPECT_EQ(take(nthPose(300 - 256)), Reject::OutOfOrder);
  for (std::int64_t n = 200; n < 250; ++n) {
    EXPECT_EQ(take(nthPose(n)), Reject::Duplicate);  // in a row: they prove nothing
  }
}

TEST_F(Stream, RefusesWhatIsOlder) {
  follow(0);
  ASSERT_EQ(take(5, 5 * kStepUs), Reject::None);
  EXPECT_EQ(take(3, 3 * kStepUs), Reject::OutOfOrder);
  ASSERT_EQ(take(6, 6 * kStepUs), Reject::None);
  EXPECT_EQ(step_.kind, StepKind::Consecutive);
}

TEST_F(Stream, ClaimsNothingAfterALowerSequenceWithALaterStamp) {
  follow(5);
  EXPECT_EQ(take(1, 7 * kStepUs), Reject::OutOfOrder);  // the number was answered, this pose not
  ASSERT_EQ(take(6, 8 * kStepUs), Reject::None);
  EXPECT_EQ(step_.kind, StepKind::AcrossGap);
  EXPECT_EQ(step_.lost, 0);
  ASSERT_EQ(take(7, 9 * kStepUs), Reject::None);
  EXPECT_EQ(step_.kind, StepKind::Consecutive);
}

TEST_F(Stream, RefusesOddStamps) {
  follow(5);
  EXPECT_EQ(take(6, 5 * kStepUs), Reject::StaleStamp);
  EXPECT_EQ(take(6, 4 * kStepUs), Reject::StaleStamp);
  EXPECT_EQ(take(6, 5 * kStepUs + 10'000'001), Reject::FutureStamp);
  ASSERT_EQ(take(6, 5 * kStepUs + 10'000'000), Reject::None);
  EXPECT_EQ(step_.kind, StepKind::Consecutive);
}

TEST_F(Stream, BeginsATimelineWithALaterSessionAtOnce) {
  follow(5);
  EXPECT_EQ(take(6, 6 * kStepUs, 0), Reject::OldSession);
  ASSERT_EQ(take(2, 3 * kStepUs, 2), Reject::None);
  EXPECT_EQ(step_.kind, StepKind::First);
  EXPECT_EQ(step_.session, 2);
  EXPECT_EQ(stream_.counts().timelines, 2U);
  EXPECT_EQ(take(6, 6 * kStepUs, 1), Reject::OldSession);
}

TEST_F(Stream, FollowsAClockThatWasSet) {
  for (const std::int64_t jump : {-3'600'000'000, 3'600'000'000}) {
    AvatarStream fresh = AvatarStream::make(smallAvatar(), {}).value();
    stream_ = std::move(fresh);
    follow(5);
    const Reject expected = jump < 0 ? Reject::StaleStamp : Reject::FutureStamp;
    EXPECT_EQ(take(6, jump + 6 * kStepUs), expected);
    EXPECT_EQ(take(7, jump + 7 * kStepUs), expected);
    ASSERT_EQ(take(8, jump + 8 * kStepUs), Reject::None);
    EXPECT_EQ(step_.kind, StepKind::First);
    ASSERT_EQ(take(9, jump + 9 * kStepUs), Reject::None);
    EXPECT_EQ(step_.kind, StepKind::Consecutive);
    EXPECT_EQ(step_.sequenceFrom, 8);
  }
}

TEST_F(Stream, FollowsASenderThatWasRestartedWithoutSessions) {
  follow(40);
  const std::int64_t later = 1'000'000;
  EXPECT_EQ(take(0, later), Reject::OutOfOrder);
  EXPECT_EQ(take(1, later + kStepUs), Reject::OutOfOrder);
  ASSERT_EQ(take(2, later + 2 * kStepUs), Reject::None);
  EXPECT_EQ(step_.kind, StepKind::First);
}

TEST_F(Stream, FollowsASessionThatIsOlderButGoesOn) {
  follow(5);
  EXPECT_EQ(take(100, 100, 0), Reject::OldSession);
  EXPECT_EQ(take(102, 200, 0), Reject::OldSession);  // one was lost: it still goes on
  ASSERT_EQ(take(103, 300, 0), Reject::None);
  EXPECT_EQ(step_.session, 0);
}

TEST_F(Stream, IsNotLedAstrayByOddPosesThatDoNotContinueOneAnother) {
  const std::vector<std::vector<std::tuple<std::int64_t, std::int64_t, std::int64_t>>> odd{
      {{6, -100, 1}, {7, -200, 1}, {8, -300, 1}},             // stamps fall
      {{3, -100, 1}, {3, -90, 1}, {3, -80, 1}},               // one number
      {{6, -100, 1}, {7, -90, 0}, {8, -80, 1}, {9, -70, 0}},  // two sessions in turn
      {{6, -20'000'000, 1},
       {7, -19'999'990, 1},
       {8, -9'999'989, 1}},                                    // the third is too late for the run
      {{6, -100, 1}, {7, -90, 1}, {7, -90, 1}, {7, -90, 1}}};  // copies
  for (const auto& poses : odd) {
    stream_ = AvatarStream::make(smallAvatar(), {}).value();
    follow(5);
    for (const auto& [sequence, utimeUs, session] : poses) {
      EXPECT_NE(take(sequence, utimeUs, session), Reject::None);
    }
  }
}

TEST_F(Stream, ForgetsOddPosesOnceTheTimelineGoesOn) {
  follow(5);
  EXPECT_EQ(take(6, -100), Reject::StaleStamp);
  EXPECT_EQ(take(7, -90), Reject::StaleStamp);
  ASSERT_EQ(take(8, 8 * kStepUs), Reject::None);
  EXPECT_EQ(take(9, -80), Reject::StaleStamp);
  EXPECT_EQ(take(10, -70), Reject::StaleStamp);
}

TEST_F(Stream, AnswersNoPoseTwiceWhateverBegins) {
  follow(5);
  ASSERT_EQ(take(0, 0, 2), Reject::None);
  for (std::int64_t n = 0; n <= 5; ++n) EXPECT_EQ(take(nthPose(n)), Reject::Duplicate);
  RawSkeleton other = skeleton_;
  other.joints[2].offset.y() = 0.5;
  ASSERT_EQ(say(other, 3), Reject::None);
  ASSERT_EQ(say(skeleton_, 4), Reject::None);
  for (std::int64_t n = 0; n <= 5; ++n) EXPECT_EQ(take(nthPose(n)), Reject::Duplicate);
  EXPECT_EQ(take(0, 0, 2), Reject::Duplicate);
}

TEST_F(Stream, SurvivesTheEndsOfTheIntegers) {
  ASSERT_EQ(say(skeleton_, kLeast, std::numeric_limits<std::int32_t>::min()), Reject::None);
  ASSERT_EQ(take(kLeast, kLeast, kLeast), Reject::None);
  EXPECT_EQ(take(kMost, kMost, kLeast), Reject::FutureStamp);
  ASSERT_EQ(take(kMost, kLeast + 1, kLeast), Reject::None);
  EXPECT_EQ(step_.kind, StepKind::AcrossGap);
  EXPECT_EQ(step_.lost, kMost);  // there are more
  EXPECT_EQ(take(kMost, kLeast + 2, kLeast), Reject::OutOfOrder);
  ASSERT_EQ(take(kLeast, kMost, kMost), Reject::None);
  EXPECT_EQ(take(kMost, kLeast, kMost), Reject::StaleStamp);
  EXPECT_EQ(take(kLeast, kLeast, kLeast + 1), Reject::OldSession);
}

TEST_F(Stream, AllocatesNothingAPose) {
  if (!test::countsAllocations()) GTEST_SKIP() << "this build has an allocator of its own";
  std::vector<PoseMessage> poses;
  for (std::int64_t n = 0; n < 500; ++n) {
    poses.push_back(nthPose(n % 50 == 49 ? n - 20 : n));  // some are refused
    if (n % 7 == 0) poses.back().joints.pop_back();
  }
  ASSERT_EQ(say(skeleton_), Reject::None);
  ASSERT_EQ(take(poses[0]), Reject::None);
  const std::uint64_t before = test::numAllocations();
  std::uint64_t accepted = 0;
  for (const PoseMessage& pose : poses) {
    if (take(pose) == Reject::None) ++accepted;
  }
  EXPECT_EQ(test::numAllocations(), before);
  EXPECT_GT(accepted, 400U);
}

}  // namespace
}  // namespace foretouch
