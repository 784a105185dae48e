#include "tests/reference/rigid_query.h"

#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "judge/plain_motion.h"
#include "tests/reference/rigid_plane.h"
#include "tests/support/random_geometry.h"

namespace foretouch::test {
namespace {

using oracle::Precise3;
using oracle::preciseDistance;
using oracle::PreciseQuaternion;
using Real = oracle::Precise;
using Eigen::Vector3d;

const Triangle kWideFloor{{Vector3d(-9, -9, 0), Vector3d(9, -9, 0), Vector3d(0, 9, 0)}};

NlerpMotion sliding(const Vector3d& from, const Vector3d& to) {
  return {from, to, Quaternion::Identity(), Quaternion::Identity()};
}

/// Separation at t in fifty digits.
Real separationAt(const NlerpMotion& motion, const Triangle& moving, const Triangle& fixed,
                  double at) {
  const Real t(at);
  const auto mix = [&](double a, double b) { return Real((1 - t) * a + t * b); };
  PreciseQuaternion q{mix(motion.q0.w(), motion.q1.w()), mix(motion.q0.x(), motion.q1.x()),
                      mix(motion.q0.y(), motion.q1.y()), mix(motion.q0.z(), motion.q1.z())};
  const Real norm = sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  q = {q.w / norm, q.x / norm, q.y / norm, q.z / norm};
  const Precise3 x(mix(motion.x0.x(), motion.x1.x()), mix(motion.x0.y(), motion.x1.y()),
                   mix(motion.x0.z(), motion.x1.z()));
  std::array<Precise3, 3> m, f;
  for (int i = 0; i < 3; ++i) {
    m[i] = x + rotate(q, Precise3(moving.vertices[i]));
    f[i] = Precise3(fixed.vertices[i]);
  }
  Real least = preciseDistance(m[0], m[1], f);
  for (int i = 0; i < 3; ++i) {
    least = std::min(least, preciseDistance(m[i], m[(i + 1) % 3], f));
    least = std::min(least, preciseDistance(f[i], f[(i + 1) % 3], m));
  }
  return least;
}

double extentOf(const NlerpMotion& motion, const Triangle& moving, const Triangle& fixed) {
  const Vector3d& origin = fixed.vertices[0];
  double extent = std::max((motion.x0 - origin).lpNorm<Eigen::Infinity>(),
                           (motion.x1 - origin).lpNorm<Eigen::Infinity>());
  for (int i = 0; i < 3; ++i) {
    extent = std::max(extent, moving.vertices[i].lpNorm<Eigen::Infinity>());
    extent = std::max(extent, (fixed.vertices[i] - origin).lpNorm<Eigen::Infinity>());
  }
  return extent;
}

TEST(RigidTrianglePair, AVertexThatFallsOnAFaceIsTimedAndNamed) {
  const Triangle tip{{Vector3d(0, 0, 0), Vector3d(1, 0, 2), Vector3d(0, 1, 2)}};
  const auto answer = rigidTrianglePair(sliding({0, 0, 1}, {0, 0, -2}), tip, kWideFloor, 0.0);
  ASSERT_TRUE(answer.leaf.hits);
  EXPECT_LE(answer.leaf.toiLow, 1.0 / 3.0);
  EXPECT_NEAR(answer.leaf.toiLow, 1.0 / 3.0, 1e-10);
  EXPECT_FALSE(answer.startsInContact);
  EXPECT_EQ(answer.moving.kind, FeatureKind::Vertex);
  EXPECT_EQ(answer.moving.index, 0);
  EXPECT_EQ(answer.fixed.kind, FeatureKind::Face);
}

TEST(RigidTrianglePair, ARodThatTurnsMeetsAnEdgeWhenTheTangentSaysSo) {
  // From the x axis a quarter turn about z; nlerp's angle is 2 atan(t tan(45 deg) / (1 - t + t
  // ...)): q(t) = (1-t)(1,0,0,0) + t(c,0,0,s), so tan(angle/2) = t s / (1 - t + t c).
  const double c = std::cos(M_PI / 4), s = std::sin(M_PI / 4);
  const NlerpMotion motion{Vector3d::Zero(), Vector3d::Zero(), Quaternion(1, 0, 0, 0),
                           Quaternion(c, 0, 0, s)};
  const Triangle rod{{Vector3d(0, 0, 0), Vector3d(2, 0, 0), Vector3d(2, 0, 0)}};
  const Triangle pole{{Vector3d(1, 1, -1), Vector3d(1, 1, 1), Vector3d(1, 3, 0)}};  // at 45 degrees
  const double k = std::tan(M_PI / 8), toi = k / (s + k * (1.0 - c));
  const auto answer = rigidTrianglePair(motion, rod, pole, 0.0);
  ASSERT_TRUE(answer.leaf.hits);
  EXPECT_NEAR(answer.leaf.toiLow, toi, 1e-10);
  EXPECT_EQ(answer.moving.kind, FeatureKind::Edge);
  EXPECT_EQ(answer.fixed.kind, FeatureKind::Edge);
  EXPECT_EQ(answer.fixed.index, 0);
}

TEST(RigidTrianglePair, TheBandIsKeptToItsWidth) {
  const Triangle flat{{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)}};
  for (const double band : {0.0, 1e-6, 0.25}) {
    const double beyond = band + 2.0 * rigidBand(18.0);
    EXPECT_FALSE(rigidTrianglePair(sliding({-1, 0, beyond}, {1, 0, beyond}), flat, kWideFloor, band)
                     .leaf.hits);
    const auto inside =
        rigidTrianglePair(sliding({-1, 0, band}, {1, 0, band}), flat, kWideFloor, band);
    EXPECT_TRUE(inside.startsInContact);
    const auto falling = rigidTrianglePair(sliding({0, 0, 1}, {0, 0, 0}), flat, kWideFloor, band);
    ASSERT_TRUE(falling.leaf.hits);
    EXPECT_LE(falling.leaf.toiLow, 1.0 - band);
    EXPECT_NEAR(falling.leaf.toiLow, 1.0 - band, 2.0 * rigidBand(18.0));
  }
}

TEST(RigidTrianglePair, PiercedAtTheStartIsInContactThen) {
  const Triangle spike{{Vector3d(0, 0, -1), Vector3d(0, 0, 1), Vector3d(1, 0, 1)}};
  EXPECT_TRUE(
      rigidTrianglePair(sliding({0, 0, 0}, {0, 0, 5}), spike, kWideFloor, 0.0).startsInContact);
}

TEST(RigidTrianglePair, PointsAndSegmentsAreTriangles) {
  const Triangle point{{Vector3d(0, 0, 0), Vector3d(0, 0, 0), Vector3d(0, 0, 0)}};
  const Triangle other{{Vector3d(1, 1, 1), Vector3d(1, 1, 1), Vector3d(1, 1, 1)}};
  EXPECT_NEAR(rigidTrianglePair(sliding({0, 0, 0}, {2, 2, 2}), point, other, 0.0).leaf.toiLow, 0.5,
              1e-9);
  EXPECT_FALSE(rigidTrianglePair(sliding({0, 0, 0}, {2, 2, 2.001}), point, other, 0.0).leaf.hits);
  const Triangle bar{{Vector3d(-1, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 0, 0)}};
  const Triangle cross{{Vector3d(0, -1, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 0)}};
  EXPECT_NEAR(rigidTrianglePair(sliding({0, 0, 1}, {0, 0, -1}), bar, cross, 0.0).leaf.toiLow, 0.5,
              1e-9);
}

/// A case that moves by up to a turn of pi, degenerate triangles and near misses among them.
struct RigidCase {
  NlerpMotion motion;
  Triangle moving, fixed;
  double band;
};

RigidCase drawRigid(Random& random) {
  const RandomPair pair = randomPair(random, 0.5, Vector3d::Zero());
  RigidCase c{{random.inBox(1.0), random.inBox(1.0), random.rotation(), random.rotation()},
              {{pair.a, pair.b, random.inBox(0.5)}},
              {pair.v},
              random.chance(0.5) ? 0.0 : random.magnitude(1e-6, 1e-1)};
  if (random.chance(0.2)) c.moving.vertices[2] = c.moving.vertices[1];
  if (random.chance(0.2)) c.motion.q1 = c.motion.q0;
  c.motion.q0.coeffs() *= random.uniform(0.5, 2.0);
  c.motion.q1.coeffs() *= random.uniform(0.5, 2.0);
  if (c.motion.q0.coeffs().dot(c.motion.q1.coeffs()) < 0.0) c.motion.q1.coeffs() *= -1.0;
  return c;
}

/// Holds the answers of `query`, given a case and its random numbers, to separationAt().
template <class Query>
void expectSoundAndTight(const Query& query) {
  constexpr int kCases = 600;
  int hits = 0, clear = 0, starts = 0;
  double worst = 0.0;
  for (int seed = 0; seed < kCases; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const RigidCase c = drawRigid(random);
    const RigidAnswer answer = query(c, random);
    const double end = answer.leaf.hits ? answer.leaf.toiLow : 1.0;
    for (int k = 0; k < 24; ++k) {
      const double t = end * (k + random.uniform(0.0, 1.0)) / 24;
      if (t >= end) continue;
      ASSERT_GT(separationAt(c.motion, c.moving, c.fixed, t), c.band) << "t " << t;
    }
    hits += answer.leaf.hits;
    clear += !answer.leaf.hits;
    starts += answer.startsInContact;
    if (!answer.leaf.hits) continue;
    EXPECT_LE(answer.leaf.toiHigh - answer.leaf.toiLow, kLeafTimeAccuracy);
    const auto excess = static_cast<double>(
        Real(separationAt(c.motion, c.moving, c.fixed, answer.leaf.toiLow) - c.band));
    const double allowed = rigidBand(std::max(extentOf(c.motion, c.moving, c.fixed), c.band));
    EXPECT_LE(excess, allowed);
    worst = std::max(worst, excess / allowed);
  }
  std::printf("hits %d, starts %d, clear %d, share of rigidBand used %.3f\n", hits, starts, clear,
              worst);
  EXPECT_GT(hits - starts, kCases / 20);
  EXPECT_GT(clear, kCases / 4);
}

TEST(RigidTrianglePair, IsSoundAndTightAgainstFiftyDigits) {
  expectSoundAndTight([](const RigidCase& c, Random&) {
    return rigidTrianglePair(c.motion, c.moving, c.fixed, c.band);
  });
}

/// Whether the plane across n separates the triangles at the start.
bool separates(const RigidCase& c, const Vector3d& n) {
  const auto &m = c.moving.vertices, &f = c.fixed.vertices;
  const Eigen::Quaterniond turn(Eigen::Vector4d(c.motion.q0.coeffs().normalized()));
  double bottom = n.dot(turn * m[0]), top = n.dot(f[0]);
  for (int i = 1; i < 3; ++i) {
    bottom = std::min(bottom, n.dot(turn * m[i]));
    top = std::max(top, n.dot(f[i]));
  }
  return n.dot(c.motion.x0) + bottom - top > c.band;
}

TEST(RigidTrianglePairFromPlane, IsSoundAndTightWhateverThePlane) {
  int separating = 0, useless = 0;
  expectSoundAndTight([&](const RigidCase& c, Random& random) {
    Vector3d n = (1.0 - 1e-15) * random.direction();
    if (random.chance(0.8) && n.dot(c.motion.x0) < 0.0) n = -n;
    if (random.chance(0.1)) n.setZero();
    ++(separates(c, n) ? separating : useless);
    return internal::rigidTrianglePairFromPlane(c.motion, c.moving, c.fixed, c.band, n);
  });
  EXPECT_GT(separating, 100);
  EXPECT_GT(useless, 100);
}

TEST(RigidTrianglePairFromPlane, APlaneThatHoldsToTheEndIsTheAnswer) {
  const Triangle tip{{Vector3d(0, 0, 0), Vector3d(1, 0, 2), Vector3d(0, 1, 2)}};
  const NlerpMotion motion = sliding({0, 0, 1}, {0, 0, 0.5});
  const Vector3d up(0, 0, 1);
  EXPECT_FALSE(internal::rigidTrianglePairFromPlane(motion, tip, kWideFloor, 0.25, up).leaf.hits);
  const auto hit = internal::rigidTrianglePairFromPlane(motion, tip, kWideFloor, 0.75, up);
  ASSERT_TRUE(hit.leaf.hits);
  EXPECT_LE(hit.leaf.toiLow, 0.5);
  EXPECT_NEAR(hit.leaf.toiLow, 0.5, 1e-10);
}

TEST(RigidTrianglePair, DoesNotDependOnTheOrderOfVertices) {
  int hits = 0;
  for (int seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const RigidCase c = drawRigid(random);
    const auto first = rigidTrianglePair(c.motion, c.moving, c.fixed, c.band);
    const auto &m = c.moving.vertices, &f = c.fixed.vertices;
    const auto other =
        rigidTrianglePair(c.motion, {{m[2], m[0], m[1]}}, {{f[1], f[0], f[2]}}, c.band);
    ASSERT_EQ(first.leaf.hits, other.leaf.hits);
    EXPECT_NEAR(first.leaf.toiLow, other.leaf.toiLow, 1e-6);
    hits += first.leaf.hits;
  }
  EXPECT_GT(hits, 100);
}

}  // namespace
}  // namespace foretouch::test
