#include "articulated/track.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/support/random_motion.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using oracle::Precise;
using oracle::Precise3;
using test::Random;

constexpr std::int64_t kNoKnot = std::numeric_limits<std::int64_t>::max();

Skeleton oneJoint() {
  RawSkeleton raw;
  raw.joints = {{"root", kNoParent, Vector3d::Zero(), Quaternion::Identity()}};
  return Skeleton::build(raw).value();
}

Pose at(double x) {
  return {{Quaternion::Identity()}, {Vector3d(x, 0, 0)}};
}

TEST(Track, HasAMotionBetweenEachTwoKnots) {
  Track track(oneJoint());
  EXPECT_TRUE(track.isEmpty());
  for (const int i : {0, 1, 2}) ASSERT_TRUE(track.push(100 * i, at(i)).ok());
  EXPECT_EQ(track.knownFromUs(), 0);
  EXPECT_EQ(track.knownUntilUs(), 200);
  for (const std::int64_t us : {0, 99, 100, 199}) {
    const TrackPiece piece = track.pieceAt(us);
    EXPECT_EQ(piece.beginUs, us / 100 * 100);
    EXPECT_EQ(piece.endUs, us / 100 * 100 + 100);
    EXPECT_EQ(piece.from->translations[0].x(), static_cast<double>(us / 100));
    EXPECT_EQ(piece.to->translations[0].x(), static_cast<double>(us / 100 + 1));
    EXPECT_FALSE(piece.isHeld);
    EXPECT_EQ(track.nextKnotUs(us), us / 100 * 100 + 100);
  }
  EXPECT_EQ(track.pieceAt(25).at(25), 0.25);
  EXPECT_EQ(track.pieceAt(0).at(100), 1.0);
}

TEST(Track, SaysThatItHoldsStillAfterTheLastKnot) {
  Track track(oneJoint());
  ASSERT_TRUE(track.push(5, at(1)).ok());
  const TrackPiece rest = track.pieceAt(1000);
  EXPECT_TRUE(rest.isHeld);
  EXPECT_EQ(rest.beginUs, 5);
  EXPECT_EQ(rest.from, rest.to);
  EXPECT_EQ(track.nextKnotUs(5), kNoKnot);
}

void expectRefused(Track& track, std::int64_t utimeUs, const Pose& pose, ErrorCode code,
                   const std::string& words) {
  const std::size_t before = track.numKnots();
  const Result<Done> pushed = track.push(utimeUs, pose);
  ASSERT_FALSE(pushed.ok());
  EXPECT_EQ(pushed.error().code, code);
  EXPECT_NE(describe(pushed.error()).find(words), std::string::npos) << describe(pushed.error());
  EXPECT_EQ(track.numKnots(), before);
}

TEST(Track, RefusesByNameWhatDoesNotFollow) {
  Track track(oneJoint());
  ASSERT_TRUE(track.push(100, at(0)).ok());
  ASSERT_TRUE(track.push(200, at(1)).ok());
  expectRefused(track, 200, at(2), ErrorCode::OutOfRange, "after the last one, at 200 us");
  expectRefused(track, 150, at(2), ErrorCode::OutOfRange, "found one at 150 us");
  EXPECT_EQ(track.push(150, at(2)).error().index, 1) << "the last knot";
  expectRefused(track, 201 + kLongestPieceUs, at(2), ErrorCode::LimitExceeded, "at most");
  expectRefused(track, kNoKnot, at(2), ErrorCode::OutOfRange, "of zero");
  Pose bad = at(2);
  bad.rotations[0] = Quaternion(std::nan(""), 0, 0, 0);
  expectRefused(track, 300, bad, ErrorCode::NonFinite, "not finite");
  expectRefused(track, 300, Pose{}, ErrorCode::Mismatch, "expected one of each");
  // What was refused has left no trace.
  ASSERT_TRUE(track.push(300, at(2)).ok());
  EXPECT_EQ(track.pieceAt(250).to->translations[0].x(), 2.0);
}

TEST(Track, ForgetsWhatNoLaterMotionNeeds) {
  Track track(oneJoint());
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(track.push(10 * i, at(i)).ok());
  track.forgetBefore(35);
  EXPECT_EQ(track.knownFromUs(), 30);
  EXPECT_EQ(track.numKnots(), 7u);
  EXPECT_EQ(track.pieceAt(35).from->translations[0].x(), 3.0);
  track.forgetBefore(1000);
  EXPECT_EQ(track.numKnots(), 1u);
  EXPECT_EQ(track.knownFromUs(), 90);
  expectRefused(track, 500, at(2), ErrorCode::OutOfRange, "in the past");
  EXPECT_TRUE(track.push(1001, at(2)).ok());
}

TEST(Track, KeepsItsKnotsWhileTheRingTurns) {
  Track track(oneJoint());
  Random random(1);
  std::int64_t first = 0, next = 0;
  for (int i = 0; i < 2000; ++i) {
    if (random.chance(0.55) || first == next) {
      ASSERT_TRUE(track.push(10 * next, at(static_cast<double>(next))).ok());
      ++next;
    } else if (next - first > 1) {
      track.forgetBefore(10 * ++first);
    }
    ASSERT_EQ(track.numKnots(), static_cast<std::size_t>(next - first));
    for (std::int64_t k = first; k < next; ++k) {
      ASSERT_EQ(track.pieceAt(10 * k).from->translations[0].x(), static_cast<double>(k));
    }
  }
  EXPECT_GT(next, 1000);
}

/// The whole at an instant of a part, and the part there, in fifty digits: the largest distance of
/// points `rho` from their links' origins.
double offBy(const test::RandomMotion& m, const TrackPiece& piece, std::int64_t begin,
             std::int64_t end, const Pose& from, const Pose& to, double share, double rho,
             Random& random) {
  const Precise s = (Precise(static_cast<double>(begin - piece.beginUs)) +
                     Precise(share) * Precise(static_cast<double>(end - begin))) /
                    Precise(static_cast<double>(piece.endUs - piece.beginUs));
  const auto whole = oracle::preciseFrames(m.precise, s);
  const auto part = oracle::preciseFrames(test::plainJoints(m.skeleton, from, to), Precise(share));
  double worst = 0.0;
  for (std::size_t link = 0; link < whole.size(); ++link) {
    const Vector3d p_L = rho * random.direction();
    worst = std::max(worst, static_cast<double>(norm(whole[link].at(p_L) - part[link].at(p_L))));
  }
  return worst;
}

TEST(Track, PartsOfAMotionAreItselfWithinTheirRounding) {
  double worstShare = 0.0;
  for (int i = 0; i < 400; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    test::RandomMotion m = test::randomMotion(random, 1 + random.below(10));
    if (random.chance(0.3)) {  // all but half turns
      const auto j = static_cast<std::size_t>(random.below(m.skeleton.numJoints()));
      m.to.rotations[j] =
          m.from.rotations[j] * random.turn(std::acos(-1.0) - random.magnitude(1e-16, 1e-9));
      m.precise = test::plainJoints(m.skeleton, m.from, m.to);
    }
    const std::int64_t start = random.below(1'000'000);
    const std::int64_t length = static_cast<std::int64_t>(random.magnitude(2.0, 1e12));
    Track track(m.skeleton);
    ASSERT_TRUE(track.push(start, m.from).ok());
    ASSERT_TRUE(track.push(start + length, m.to).ok());
    const TrackPiece piece = track.pieceAt(start);
    const ChainMotion motion(m.skeleton, *piece.from, *piece.to);
    std::int64_t begin = start + static_cast<std::int64_t>(random.uniform(0.0, 1.0) *
                                                           static_cast<double>(length - 1));
    std::int64_t end = begin + 1 +
                       static_cast<std::int64_t>(random.uniform(0.0, 1.0) *
                                                 static_cast<double>(start + length - begin - 1));
    if (random.chance(0.3)) begin = start;
    if (random.chance(0.3)) end = start + length;
    if (random.chance(0.1)) {
      begin = start + 1;
      end = start + length;
    }
    Pose from, to;
    partOf(piece, motion, begin, end, from, to);
    const double rho = random.magnitude(1e-3, 1.0);
    const double allowed = partRounding(piece, motion, begin, end, rho);
    const double share = random.uniform(0.0, 1.0);
    const double off = offBy(m, piece, begin, end, from, to, share, rho, random);
    if (begin == start && end == start + length) {
      EXPECT_EQ(allowed, 0.0);
      EXPECT_EQ(off, 0.0);
      continue;
    }
    ASSERT_LE(off, allowed);
    worstShare = std::max(worstShare, off / allowed);
  }
  EXPECT_GT(worstShare, 1e-3);
}

TEST(Track, WhatHoldsStillDoesNotMove) {
  Track track(oneJoint());
  ASSERT_TRUE(track.push(0, at(3)).ok());
  const TrackPiece rest = track.pieceAt(10);
  const ChainMotion motion(track.skeleton(), *rest.from, *rest.to);
  Pose from, to;
  partOf(rest, motion, 10, 1'000'000'000, from, to);
  EXPECT_EQ(from.translations[0], Vector3d(3, 0, 0));
  EXPECT_EQ(to.translations[0], Vector3d(3, 0, 0));
  EXPECT_EQ(partRounding(rest, motion, 10, 20, 1.0), 0.0);
}

TEST(WhenSilent, HasAWordForEach) {
  EXPECT_STREQ(toString(WhenSilent::Wait), "wait");
  EXPECT_STREQ(toString(WhenSilent::HoldStill), "hold-still");
  EXPECT_STREQ(toString(WhenSilent::Undecided), "undecided");
}

}  // namespace
}  // namespace foretouch
