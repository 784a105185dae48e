// A stream's solid avatar: what it is asked, what its messages say, and that it passes through
// nothing whatever the stream does.
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "articulated/motion.h"
#include "middleware/query/query.h"
#include "network/stream/stream_solver.h"
#include "network/wire/codec.h"
#include "tests/network/small_stream.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::hipsAt;
using test::kStepUs;
using test::skeletonMessage;
using test::smallAvatar;
using test::smallSkeleton;

/// A wall of 10 m across x = 1.
Scene solidWall() {
  RawScene raw;
  raw.objectNames = {"wall"};
  const Vector3d a(1, -9, -9), b(1, 9, -9), c(1, 9, 9), d(1, -9, 9);
  raw.triangles = {{a, b, c}, {a, c, d}};
  raw.objectOf = {0, 0};
  return Scene::build(raw).value();
}

class SolidStreams : public testing::Test {
 protected:
  SolidStreams() { begin(); }

  void begin() {
    solver_.emplace(StreamSolver::make(0, smallAvatar(), solidWall(), {}, {}).value());
    EXPECT_TRUE(solver_->makeSolid({}).ok());
    EXPECT_EQ(solver_->take(skeletonMessage(smallSkeleton())), Reject::None);
  }
  [[nodiscard]] Reject take(const PoseMessage& message) {
    const Reject reject = solver_->take(message, answer_);
    if (reject == Reject::None) solver_->solid()->follow(solver_->lastStep(), shown_);
    return reject;
  }
  /// Accepted, and the way of its answer proven once more by a query of its own.
  void follow(const PoseMessage& message) {
    const Pose before = shown_.way.empty() ? Pose() : shown_.shown();
    const bool wasPlaced = shown_.isCertified;
    ASSERT_EQ(take(message), Reject::None);
    Bytes bytes;
    encode(shown_, bytes);
    SolidMessage read;
    ASSERT_EQ(decode(bytes, read), Reject::None);
    if (!shown_.isCertified || shown_.hasAppeared || !wasPlaced) return;
    Pose at = before;
    for (const Pose& pose : read.way) {
      EXPECT_TRUE(isFree(at, pose)) << message.sequence;
      at = pose;
    }
  }
  [[nodiscard]] static bool isFree(const Pose& from, const Pose& to) {
    QueryOptions options;
    options.tolerance = kMinTolerance;
    const Query query = Query::build(smallAvatar(), solidWall(), options).value();
    Scratch scratch;
    StepContacts contacts;
    query.answer(ChainMotion(smallAvatar().skeleton(), from, to), scratch, contacts);
    for (const LinkContact& contact : contacts.links) {
      if (contact.verdict != Verdict::Clear) return false;
    }
    return true;
  }
  [[nodiscard]] double shownX() const { return shown_.shown().translations[0].x(); }

  std::optional<StreamSolver> solver_;
  ContactsMessage answer_;
  SolidMessage shown_;
};

TEST(SolidStreamOptions, ThatAreRefusedAreNamed) {
  auto solver = StreamSolver::make(0, smallAvatar(), solidWall(), {}, {}).value();
  EXPECT_EQ(solver.solid(), nullptr);
  SolidOptions options;
  options.skin = 1.0;
  const auto made = solver.makeSolid(options);
  ASSERT_FALSE(made.ok());
  EXPECT_EQ(made.error().file, "skin");
  EXPECT_EQ(solver.solid(), nullptr);
}

TEST(SolidStreamOptions, AvatarsWithMoreJointsThanAMessageHoldsAreRefused) {
  const auto made = [](std::size_t numJoints) {
    RawSkeleton raw;
    std::vector<std::vector<Lss>> bones;
    for (std::size_t j = 0; j < numJoints; ++j) {
      raw.joints.push_back({"J" + std::to_string(j), j == 0 ? kNoParent : 0,
                            Vector3d(0.0, 0.1, 0.0), Quaternion::Identity()});
      bones.push_back({{{0.0, 0.0, 0.0}, {0.0, 0.1, 0.0}, 0.01}});
    }
    const Avatar avatar = Avatar::build(Skeleton::build(raw).value(), bones).value();
    return SolidStream::make(0, avatar, solidWall(), {});
  };
  EXPECT_TRUE(made(kMaxSolidJoints).ok());
  const auto tooMany = made(kMaxSolidJoints + 1);
  ASSERT_FALSE(tooMany.ok());
  EXPECT_EQ(tooMany.error().code, ErrorCode::LimitExceeded);
}

TEST_F(SolidStreams, SayWhatTheyAnswer) {
  follow(hipsAt(0.0, 1));
  EXPECT_EQ(shown_.kind, StepKind::First);
  EXPECT_EQ(shown_.stepUs, kFirstSolidStepUs);
  PoseMessage pose = hipsAt(0.1, 4);
  follow(pose);
  EXPECT_EQ(shown_.avatar, 0);
  EXPECT_EQ(shown_.session, 1);
  EXPECT_EQ(shown_.sequence, 4);
  EXPECT_EQ(shown_.utimeUs, pose.utimeUs);
  EXPECT_EQ(shown_.kind, StepKind::AcrossGap);
  EXPECT_EQ(shown_.lost, 2);
  EXPECT_EQ(shown_.stepUs, 3 * kStepUs);
  EXPECT_EQ(shown_.avatarHash, skeletonHash(smallSkeleton()));
  EXPECT_EQ(shown_.skin, SolidOptions().skin);
  EXPECT_EQ(shown_.state, SolidState::Equal);
  EXPECT_TRUE(shown_.isCertified);
  EXPECT_EQ(shown_.joints.size(), 4U);
  EXPECT_EQ(shown_.linkDeviation.size(), 4U);
}

// What is free is shown bit for bit; what is behind the wall is not shown.
TEST_F(SolidStreams, FollowWhereTheWayIsFreeAndStopAtWalls) {
  for (int n = 0; n < 60; ++n) {
    const double x = 0.05 * n;
    follow(hipsAt(x, n + 1));
    const Pose& tracked = *solver_->lastStep().to;
    if (x < 0.6) {
      ASSERT_EQ(shown_.state, SolidState::Equal) << x;
      EXPECT_EQ(shown_.shown().translations[0], tracked.translations[0]);
      EXPECT_EQ(shown_.shown().rotations[1].coeffs(), tracked.rotations[1].coeffs());
    }
    EXPECT_LT(shownX(), 1.0);
  }
  EXPECT_NE(shown_.state, SolidState::Equal);
  EXPECT_TRUE(shown_.isCertified);
}

TEST_F(SolidStreams, ShowThePosesOfTheSolidAvatarItself) {
  auto solid = SolidAvatar::build(smallAvatar(), solidWall(), {}).value();
  SolidTick tick;
  for (int n = 0; n < 40; ++n) {
    follow(hipsAt(0.04 * n, n + 1));
    const double dtS = n == 0 ? 0.01 : static_cast<double>(kStepUs) * 1e-6;
    ASSERT_TRUE(solid.follow({*solver_->lastStep().to, dtS}, tick).ok());
    ASSERT_EQ(shown_.state, tick.state);
    ASSERT_EQ(shown_.deviation, tick.deviation);
    ASSERT_EQ(shown_.clearance, std::isfinite(tick.clearance) ? tick.clearance : 0.0);
    ASSERT_EQ(shown_.contacts.size(), tick.contacts.size());
    for (std::size_t joint = 0; joint < 4; ++joint) {
      ASSERT_EQ(shown_.shown().rotations[joint].coeffs(), tick.shown.rotations[joint].coeffs());
      ASSERT_EQ(shown_.shown().translations[joint], tick.shown.translations[joint]);
    }
  }
}

// A gap, another session, another clock: the body walks on from where it stood, and no way leads
// through the wall.
TEST_F(SolidStreams, GoOnFromWhereTheyWereWhateverBegins) {
  follow(hipsAt(0.0, 1));
  follow(hipsAt(0.1, 2));
  const double before = shownX();
  follow(hipsAt(3.0, 500));  // beyond the wall, after 497 lost
  EXPECT_EQ(shown_.kind, StepKind::AcrossGap);
  EXPECT_EQ(shown_.stepUs, kMostSolidStepUs);
  EXPECT_LT(shownX(), 1.0);
  EXPECT_GE(shownX(), before);
  follow(hipsAt(3.0, 1, 2));  // another session
  EXPECT_EQ(shown_.kind, StepKind::First);
  EXPECT_EQ(shown_.stepUs, kFirstSolidStepUs);
  EXPECT_LT(shownX(), 1.0);
  EXPECT_TRUE(shown_.isCertified);
  EXPECT_NE(shown_.state, SolidState::Placing);
}

TEST_F(SolidStreams, HaveNoPlaceUntilAllRootsAreKnownOnce) {
  for (int n = 1; n < 4; ++n) {
    PoseMessage pose = hipsAt(0.0, n);
    pose.joints[0].flags = 0;  // the hips
    follow(pose);
    EXPECT_EQ(shown_.state, SolidState::Placing);
    EXPECT_FALSE(shown_.isCertified);
    EXPECT_EQ(shown_.counters.queries, 0U);
    EXPECT_EQ(shown_.times, std::vector<double>{0.0});
    EXPECT_EQ(shown_.joints[0], SolidJointState::Lost);
    EXPECT_EQ(shown_.joints[1], SolidJointState::Free);
  }
  follow(hipsAt(0.0, 4));
  EXPECT_EQ(shown_.state, SolidState::Equal);
  EXPECT_TRUE(shown_.isCertified);
  PoseMessage lost = hipsAt(3.0, 5);
  lost.joints[0].flags = 0;
  follow(lost);
  EXPECT_NE(shown_.state, SolidState::Placing);
  EXPECT_LT(shownX(), 0.5);  // what a lost joint says means nothing
}

TEST_F(SolidStreams, RememberWhatWasShownBefore) {
  follow(hipsAt(0.0, 1));
  EXPECT_EQ(solver_->solid()->shownBefore().translations[0].x(), 0.0);
  follow(hipsAt(0.1, 2));
  EXPECT_EQ(solver_->solid()->shownBefore().translations[0].x(), 0.0);
  follow(hipsAt(0.2, 3));
  EXPECT_EQ(solver_->solid()->shownBefore().translations[0].x(), 0.1);
}

// The same messages give the same bytes, but for the stamps and the time that it took.
TEST_F(SolidStreams, RepeatEveryByte) {
  const auto bytesOfRun = [&] {
    begin();
    shown_ = {};
    std::vector<Bytes> all;
    for (int n = 0; n < 120; ++n) {
      PoseMessage pose = hipsAt(0.6 + 0.5 * std::sin(0.3 * n), n + 1 + n / 40);
      if (n % 7 == 3) pose.joints[2].flags = 0;
      EXPECT_EQ(take(pose), Reject::None);
      Bytes bytes;
      encode(shown_, bytes);
      const ByteView repeated = verdictBytes(bytes);
      all.emplace_back(repeated.data, repeated.data + repeated.size);
    }
    return all;
  };
  EXPECT_EQ(bytesOfRun(), bytesOfRun());
}

}  // namespace
}  // namespace foretouch
