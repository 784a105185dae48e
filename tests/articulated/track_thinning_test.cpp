// Thinned tracks against the judge's motion, in long double, of all poses that were pushed.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "articulated/track.h"
#include "judge/motion.h"
#include "tests/support/judged.h"
#include "tests/support/random_geometry.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using oracle::Real;
using test::Random;

/// Of the judge's own places, in metres.
constexpr Real kJudged = 1e-12L;

struct Pushed {
  std::int64_t us;
  Pose pose;
};

/// Joints that swing, each at its own rate, with some noise and signs that flip; and one in some
/// that leaps.
struct Swinging {
  Skeleton skeleton;
  std::vector<Vector3d> axes;
  std::vector<double> rates, sizes;
  double noise, leaps;

  Pose at(double seconds, Random& random) const {
    Pose pose = restPose(skeleton);
    for (std::size_t j = 0; j < axes.size(); ++j) {
      const double leap = random.chance(leaps) ? random.uniform(0.0, 3.1) : 0.0;
      const double half = 0.5 * (sizes[j] * std::sin(rates[j] * seconds) + leap);
      const Vector3d v = std::sin(half) * axes[j];
      const Quaternion swing(std::cos(half), v.x(), v.y(), v.z());
      Quaternion q = pose.rotations[j] * swing * random.turn(random.uniform(0.0, noise));
      if (random.chance(0.3)) q.coeffs() = -q.coeffs();
      pose.rotations[j] = q;
      const double along = j == 0 ? 2.0 * seconds : 0.01 * std::cos(rates[j] * seconds);
      pose.translations[j] += along * axes[j] + noise * random.inBox(0.1);
    }
    return pose;
  }
};

Swinging drawn(Random& random) {
  RawSkeleton raw;
  Swinging body;
  const int joints = 1 + random.below(12);
  for (int j = 0; j < joints; ++j) {
    const double size = j == 0 && random.chance(0.2) ? 1e4 : random.magnitude(0.02, 0.5);
    raw.joints.push_back({"joint" + std::to_string(j), j == 0 ? kNoParent : random.below(j),
                          size * random.direction(), random.rotation()});
    body.axes.push_back(random.direction());
    body.rates.push_back(random.magnitude(0.3, 20.0));
    body.sizes.push_back(random.uniform(0.0, 1.5));
  }
  body.skeleton = Skeleton::build(raw).value();
  body.noise = random.chance(0.5) ? 0.0 : random.magnitude(1e-6, 1e-1);
  body.leaps = random.chance(0.3) ? 0.05 : 0.0;
  return body;
}

/// Places of points around each link, link by link, at an instant of the motion between two poses.
std::vector<oracle::Vec3<Real>> placesAt(const Skeleton& skeleton, const Pose& from, const Pose& to,
                                         Real t, const std::vector<Vector3d>& points) {
  const oracle::Motion motion(test::plainJoints(skeleton, from, to));
  std::vector<oracle::MovingFrame<Real>> frames;
  motion.framesAt(t, frames);
  std::vector<oracle::Vec3<Real>> places;
  for (std::size_t link = 0; link < frames.size(); ++link) {
    places.push_back(frames[link].at(test::plain(points[link]).as<Real>()));
  }
  return places;
}

Real shareOf(std::int64_t beginUs, std::int64_t endUs, Real us) {
  return (us - static_cast<Real>(beginUs)) / static_cast<Real>(endUs - beginUs);
}

/// How far points are from where they were with all poses, at most, of many draws.
Real movedBy(const Track& track, const std::vector<Pushed>& pushed,
             const std::vector<double>& reach, Random& random, int draws) {
  Real worst = 0;
  for (int i = 0; i < draws; ++i) {
    const auto k = static_cast<std::size_t>(random.below(static_cast<int>(pushed.size()) - 1));
    const Pushed &from = pushed[k], &to = pushed[k + 1];
    const Real us = static_cast<Real>(from.us) + static_cast<Real>(random.uniform(0.0, 1.0)) *
                                                     static_cast<Real>(to.us - from.us);
    std::vector<Vector3d> points;
    for (const double r : reach) points.push_back(r * random.direction());
    const TrackPiece piece = track.pieceAt(from.us);
    const auto then =
        placesAt(track.skeleton(), from.pose, to.pose, shareOf(from.us, to.us, us), points);
    const auto now = placesAt(track.skeleton(), *piece.from, *piece.to,
                              shareOf(piece.beginUs, piece.endUs, us), points);
    for (std::size_t link = 0; link < then.size(); ++link) {
      worst = std::max(worst, norm(then[link] - now[link]));
    }
  }
  return worst;
}

struct Thinned {
  Track track;
  std::vector<Pushed> pushed;
  std::vector<double> reach;
};

/// Pushed one by one, and thinned every now and then.
Thinned thinned(Random& random, double metres, int poses) {
  const Swinging body = drawn(random);
  Thinned made{Track(body.skeleton), {}, {}};
  for (int j = 0; j < body.skeleton.numJoints(); ++j) {
    made.reach.push_back(random.chance(0.2) ? 0.0 : random.magnitude(0.01, 0.5));
  }
  const int every = 1 + random.below(poses);
  std::int64_t us = random.below(1000);
  for (int i = 0; i < poses; ++i) {
    EXPECT_TRUE(made.track.push(us, body.at(1e-6 * static_cast<double>(us), random)).ok());
    made.pushed.push_back({us, *made.track.pieceAt(us).from});
    us += 4000 + random.below(8000);
    if (i % every != every - 1) continue;
    // With less than what is allowed, too, and again up to instants before.
    const double some = random.chance(0.3) ? 0.5 * metres : metres;
    made.track.thinBefore(us - random.below(100'000), made.reach, some);
  }
  made.track.thinBefore(us, made.reach, metres);
  return made;
}

TEST(TrackThinning, NoPointIsFartherThanSaidFromWhereAllPosesHaveIt) {
  Real tightest = 0;
  std::size_t kept = 0, all = 0;
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const double metres = random.magnitude(1e-6, 1.0);
    const Thinned made = thinned(random, metres, 60);
    const Real moved = movedBy(made.track, made.pushed, made.reach, random, 300);
    ASSERT_LE(moved, static_cast<Real>(metres) + kJudged);
    tightest = std::max(tightest, moved / static_cast<Real>(metres));
    kept += made.track.numKnots();
    all += made.pushed.size();
    EXPECT_EQ(made.track.knownFromUs(), made.pushed.front().us);
    EXPECT_EQ(made.track.knownUntilUs(), made.pushed.back().us);
  }
  EXPECT_GT(tightest, 0.3L);
  EXPECT_LT(kept, 2 * all / 3);
  EXPECT_GT(kept, all / 20);
}

// The judge sees it if one more pose is dropped than may be.
TEST(TrackThinning, DroppingMoreMovesPointsFartherThanSaid) {
  int seen = 0;
  for (int i = 0; i < 100; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    const double metres = random.magnitude(1e-4, 1e-1);
    const Thinned made = thinned(random, 4.0 * metres, 60);
    seen += movedBy(made.track, made.pushed, made.reach, random, 300) > static_cast<Real>(metres);
  }
  EXPECT_GT(seen, 50);
}

TEST(TrackThinning, KeepsTheMotionFromTheInstantOn) {
  Random random(7);
  const Swinging body = drawn(random);
  Track track(body.skeleton);
  std::vector<Pushed> pushed;
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(track.push(10'000 * i, body.at(0.01 * i, random)).ok());
    pushed.push_back({10'000 * i, *track.pieceAt(10'000 * i).from});
  }
  const std::vector<double> reach(countOf(body.skeleton.numJoints()), 0.2);
  track.thinBefore(505'000, reach, 100.0);
  EXPECT_EQ(track.numKnots(), 51u) << "the first one, and all from 500 ms on";
  for (std::int64_t k = 50; k < 100; ++k) {
    const TrackPiece piece = track.pieceAt(10'000 * k);
    EXPECT_EQ(piece.beginUs, 10'000 * k);
    const Pose& pose = pushed[static_cast<std::size_t>(k)].pose;
    for (std::size_t j = 0; j < pose.rotations.size(); ++j) {
      EXPECT_EQ(piece.from->rotations[j].coeffs(), pose.rotations[j].coeffs());
      EXPECT_EQ(piece.from->translations[j], pose.translations[j]);
    }
  }
  // Nothing is dropped for nothing: 0 m allows no rounding.
  const std::size_t before = track.numKnots();
  track.thinBefore(2'000'000, reach, 0.0);
  EXPECT_EQ(track.numKnots(), before);
}

// A body that rests, or turns at a constant rate, needs two poses.
TEST(TrackThinning, DropsAllThatSaysNothing) {
  RawSkeleton raw;
  raw.joints = {{"root", kNoParent, Vector3d::Zero(), Quaternion::Identity()}};
  Track track(Skeleton::build(raw).value());
  for (int i = 0; i <= 200; ++i) {
    const double half = 0.002 * i;
    const Pose pose{{Quaternion(std::cos(half), 0, std::sin(half), 0)}, {Vector3d(0.1 * i, 0, 0)}};
    ASSERT_TRUE(track.push(1000 * i, pose).ok());
    if (i % 40 == 39) track.thinBefore(1000 * i, {0.5}, 1e-9);
  }
  track.thinBefore(200'000, {0.5}, 1e-9);
  EXPECT_EQ(track.numKnots(), 2u);
  ASSERT_TRUE(track.push(300'000, {{Quaternion::Identity()}, {Vector3d::Zero()}}).ok());
  EXPECT_EQ(track.pieceAt(250'000).from->translations[0].x(), 20.0);
}

// Two neighbouring rotations at a right angle: the motion goes one way round or the other.
TEST(TrackThinning, LeavesHalfTurnsAlone) {
  RawSkeleton raw;
  raw.joints = {{"root", kNoParent, Vector3d::Zero(), Quaternion::Identity()}};
  Track track(Skeleton::build(raw).value());
  const std::vector<Quaternion> turns = {Quaternion(1, 0, 0, 0), Quaternion(0, 0, 1, 0),
                                         Quaternion(-1, 0, 0, 0), Quaternion(0, 0, -1, 0)};
  for (std::size_t i = 0; i < turns.size(); ++i) {
    ASSERT_TRUE(
        track.push(1000 * static_cast<std::int64_t>(i), {{turns[i]}, {Vector3d::Zero()}}).ok());
  }
  track.thinBefore(10'000, {0.5}, 0.4);
  EXPECT_EQ(track.numKnots(), turns.size());
}

}  // namespace
}  // namespace foretouch
