// Who is believed: docs/streaming.md, "Who is believed", row by row.
#include "network/stream/bound_stream.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/network/recorded_stream.h"
#include "tests/network/small_stream.h"

namespace foretouch {
namespace {

using test::kStepUs;
using test::RecordedStream;
using test::smallAvatar;
using test::smallSkeleton;

constexpr std::int64_t kNowUs = 1'700'000'000'000'000, kSecondUs = 1'000'000;
constexpr UdpmSender kTrue{0x0100007f, 1000}, kOther{0x0100007f, 2000}, kThird{0x0200000a, 1000};

StreamSolver newSolver() {
  return StreamSolver::make(0, smallAvatar(), test::farWall(), {}, {}).value();
}

/// A stream, what it records, and a time that the test sets.
class BoundStreams : public testing::Test {
 protected:
  Reject say(const UdpmSender& sender, const RawSkeleton& skeleton, std::int64_t session = 1) {
    SkeletonMessage message = test::skeletonMessage(skeleton, session);
    message.sendUtimeUs = nowUs_;
    Bytes payload;
    encode(message, payload);
    return stream_.take({sender, nowUs_, payload}, message, record_);
  }
  Reject take(const UdpmSender& sender, const PoseMessage& message) {
    Bytes payload;
    encode(message, payload);
    const Reject reject = stream_.take({sender, nowUs_, payload}, message, answer_, record_);
    if (reject == Reject::None) verdicts_.push_back(RecordedStream::verdictsOf(answer_));
    return reject;
  }
  /// The true sender's next pose, a step later.
  Reject next() {
    nowUs_ += kStepUs;
    return take(kTrue, test::poseMessage(smallSkeleton(), ++sequence_, nowUs_));
  }
  void follow(int poses) {
    ASSERT_EQ(say(kTrue, smallSkeleton()), Reject::None);
    for (int i = 0; i < poses; ++i) ASSERT_EQ(next(), Reject::None);
  }
  void expectReplays() const { EXPECT_EQ(record_.replayedBy(newSolver()), verdicts_); }

  BoundStream stream_{newSolver(), {}};
  RecordedStream record_;
  ContactsMessage answer_;
  std::vector<Bytes> verdicts_;
  std::int64_t nowUs_ = kNowUs, sequence_ = 0;
};

RawSkeleton changedSkeleton() {
  RawSkeleton changed = smallSkeleton();
  changed.joints[2].offset.y() = 0.5;
  return changed;
}

TEST_F(BoundStreams, HearNobodyElseWhileTheirSpeakerSpeaks) {
  follow(10);
  const std::size_t entries = record_.entries.size();
  for (int i = 0; i < 200; ++i) {
    EXPECT_EQ(say(kOther, changedSkeleton(), kNowUs + 100), Reject::OtherSender);
    for (int k = 0; k < 5; ++k) {
      EXPECT_FALSE(stream_.mayPass(kOther, nowUs_));
      EXPECT_EQ(take(kOther, test::poseMessage(changedSkeleton(), i * 5 + k, nowUs_, kNowUs)),
                Reject::OtherSender);
      EXPECT_EQ(take(kThird, test::poseMessage(smallSkeleton(), i * 5 + k, nowUs_, kNowUs)),
                Reject::OtherSender);
    }
    ASSERT_EQ(next(), Reject::None);
    EXPECT_EQ(answer_.kind, StepKind::Consecutive);
  }
  EXPECT_EQ(record_.entries.size(), entries + 200);  // nothing of theirs
  expectReplays();
}

TEST_F(BoundStreams, FollowAnotherSenderAfterASilence) {
  follow(10);
  ASSERT_EQ(say(kOther, changedSkeleton(), 0), Reject::OtherSender);  // says it once
  nowUs_ += 2 * kSecondUs - 1;
  EXPECT_EQ(take(kOther, test::poseMessage(changedSkeleton(), 7, 70, 0)), Reject::OtherSender);
  nowUs_ += 1;
  EXPECT_TRUE(stream_.mayPass(kOther, nowUs_));
  ASSERT_EQ(take(kOther, test::poseMessage(changedSkeleton(), 8, 80, 0)), Reject::None);
  EXPECT_EQ(answer_.kind, StepKind::First);
  ASSERT_EQ(take(kOther, test::poseMessage(changedSkeleton(), 9, 90, 0)), Reject::None);
  EXPECT_EQ(answer_.kind, StepKind::Consecutive);
  ASSERT_EQ(take(kOther, test::poseMessage(changedSkeleton(), 10, 100, 0)), Reject::None);
  EXPECT_EQ(next(), Reject::OtherSender);
  const auto speakers =
      std::count_if(record_.entries.begin(), record_.entries.end(),
                    [](const auto& entry) { return entry.kind == RecordedStream::Kind::Speaker; });
  EXPECT_EQ(speakers, 1);
  expectReplays();
}

TEST_F(BoundStreams, ReturnToTheirSpeakerAfterAPoseSaidInASilence) {
  follow(10);
  nowUs_ += 3 * kSecondUs;
  ASSERT_EQ(say(kOther, changedSkeleton(), kNowUs + kSecondUs), Reject::OtherSender);
  ASSERT_EQ(take(kOther, test::poseMessage(changedSkeleton(), 1, nowUs_, kNowUs + kSecondUs)),
            Reject::None);
  EXPECT_EQ(next(), Reject::OtherSender);
  EXPECT_EQ(next(), Reject::OtherSender);
  ASSERT_EQ(next(), Reject::None);  // by its own skeleton, which nobody said again
  EXPECT_EQ(answer_.kind, StepKind::First);
  for (int i = 0; i < 10; ++i) ASSERT_EQ(next(), Reject::None);
  EXPECT_EQ(answer_.kind, StepKind::Consecutive);
  expectReplays();
}

TEST_F(BoundStreams, AreNotKeptFromTheirFirstSpeakerByASkeletonSaidBefore) {
  ASSERT_EQ(say(kOther, changedSkeleton(), kNowUs + kSecondUs), Reject::None);
  EXPECT_EQ(say(kTrue, smallSkeleton()), Reject::OldSession);
  for (int i = 0; i < 5; ++i) ASSERT_EQ(next(), Reject::None);
  EXPECT_EQ(take(kOther, test::poseMessage(changedSkeleton(), 1, nowUs_, kNowUs + kSecondUs)),
            Reject::OtherSender);
  expectReplays();
}

TEST_F(BoundStreams, AreNotTakenOverByAPoseThatIsRefused) {
  follow(10);
  nowUs_ += 3 * kSecondUs;
  PoseMessage bad = test::poseMessage(smallSkeleton(), 1, nowUs_, 7);
  bad.joints[2].joint = 9;
  EXPECT_EQ(take(kOther, bad), Reject::BadIndex);
  EXPECT_EQ(take(kOther, test::poseMessage(changedSkeleton(), 1, nowUs_, 7)),
            Reject::SkeletonMismatch);
  for (int i = 0; i < 5; ++i) ASSERT_EQ(next(), Reject::None);
  expectReplays();
}

TEST_F(BoundStreams, SilenceIsNotMadeLongerByAClockThatIsSetBack) {
  follow(10);
  nowUs_ -= 3600 * kSecondUs;
  EXPECT_EQ(take(kOther, test::poseMessage(smallSkeleton(), 1, nowUs_)), Reject::None);
}

TEST_F(BoundStreams, RefuseSessionsThatBeginInTheFuture) {
  EXPECT_EQ(sessionFault(0, 0), Reject::None);
  EXPECT_EQ(sessionFault(-5, -9'000'000'000'000), Reject::None);
  EXPECT_EQ(sessionFault(kNowUs + kMostSessionAheadUs, kNowUs), Reject::None);
  EXPECT_EQ(sessionFault(kNowUs + kMostSessionAheadUs + 1, kNowUs), Reject::FutureSession);
  constexpr std::int64_t kLast = (std::int64_t{1} << 62) - 1;
  EXPECT_EQ(sessionFault(kLast, kNowUs), Reject::FutureSession);
  follow(10);
  EXPECT_EQ(say(kTrue, changedSkeleton(), kLast), Reject::FutureSession);
  EXPECT_EQ(take(kTrue, test::poseMessage(smallSkeleton(), 1, nowUs_, kLast)),
            Reject::FutureSession);
  ASSERT_EQ(next(), Reject::None);
  EXPECT_EQ(answer_.kind, StepKind::Consecutive);
}

TEST_F(BoundStreams, TakeAllMessagesOfSendersThatNobodyKnows) {
  constexpr UdpmSender kUnknown;
  ASSERT_EQ(say(kUnknown, smallSkeleton()), Reject::None);
  for (std::int64_t n = 0; n < 5; ++n) {
    ASSERT_EQ(take(kUnknown, test::poseMessage(smallSkeleton(), n, n * kStepUs)), Reject::None);
  }
  EXPECT_TRUE(stream_.mayPass(kUnknown, nowUs_));
}

TEST_F(BoundStreams, RecordASampleOfWhatStrangersSayInVainInASilence) {
  follow(10);
  const std::size_t entries = record_.entries.size();
  nowUs_ += 3 * kSecondUs;
  for (int i = 0; i < 1000; ++i) {
    PoseMessage bad = test::poseMessage(smallSkeleton(), i, nowUs_, 7);
    bad.joints[2].joint = 9;
    EXPECT_EQ(take(i % 2 == 0 ? kOther : kThird, bad), Reject::BadIndex);
  }
  // At most a change of speaker for each pose.
  EXPECT_LE(record_.entries.size(), entries + 2 * kMostRefusedRecords);
  ASSERT_EQ(next(), Reject::None);
  EXPECT_EQ(answer_.kind, StepKind::First);
  ASSERT_EQ(next(), Reject::None);
  expectReplays();
}

TEST_F(BoundStreams, TryASkeletonThatFitsNoAvatarOnce) {
  RawSkeleton unfit = smallSkeleton();
  for (std::size_t i = 0; i < unfit.joints.size(); ++i) {
    unfit.joints[i].name = "x" + std::to_string(i);
  }
  const auto flood = [&](Reject said, Reject refused) {
    const std::size_t entries = record_.entries.size();
    EXPECT_EQ(say(kOther, unfit), said);
    for (int i = 0; i < 1000; ++i) {
      EXPECT_EQ(take(kOther, test::poseMessage(unfit, i, nowUs_)), refused);
    }
    EXPECT_LE(record_.entries.size(), entries + 2 * kMostRefusedRecords);
  };
  flood(Reject::NoMatch, Reject::UnknownSkeleton);
  follow(10);
  nowUs_ += 3 * kSecondUs;
  flood(Reject::OtherSender, Reject::SkeletonMismatch);
  std::vector<std::int64_t> hashes;
  stream_.listKnownHashes(hashes);
  EXPECT_EQ(std::count(hashes.begin(), hashes.end(), skeletonHash(unfit)), 0);
  for (int i = 0; i < 5; ++i) ASSERT_EQ(next(), Reject::None);
  expectReplays();
}

TEST_F(BoundStreams, RecordASampleOfWhatIsRefusedInVain) {
  follow(10);
  const std::size_t entries = record_.entries.size();
  for (int i = 0; i < 1000; ++i) {
    PoseMessage garbage = test::poseMessage(smallSkeleton(), 1, nowUs_);
    garbage.skeletonHash = i;
    EXPECT_EQ(take(kTrue, garbage), Reject::SkeletonMismatch);
  }
  EXPECT_EQ(record_.entries.size(), entries + kMostRefusedRecords);
  EXPECT_EQ(record_.numLeftOut, 1000U - kMostRefusedRecords);
  // What may decide about later poses is always there.
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(take(kTrue, test::poseMessage(smallSkeleton(), 1, -i, 1)), Reject::OutOfOrder);
  }
  EXPECT_EQ(record_.entries.size(), entries + kMostRefusedRecords + 50);
  ASSERT_EQ(next(), Reject::None);
  expectReplays();
}

}  // namespace
}  // namespace foretouch
