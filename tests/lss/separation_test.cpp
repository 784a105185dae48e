#include "lss/separation.h"

#include <algorithm>
#include <iostream>
#include <string>

#include <gtest/gtest.h>

#include "judge/plain_motion.h"
#include "lss/clearance.h"
#include "lss/index.h"
#include "tests/support/random_geometry.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using oracle::Precise3;
using Real = oracle::Precise;

/// How many points each side has.
struct Kind {
  int one, other;
};

struct HullPair {
  Hull one, other;
};

HullPair randomHulls(test::Random& random, Kind kind, double size, const Vector3d& center) {
  const test::RandomPair p = test::randomPair(random, size, center);
  HullPair pair{{{p.a, p.b, center + random.inBox(size)}, 3}, {p.v, 3}};
  if (random.chance(0.1)) pair.one.points[2] = pair.other.points[1];  // a shared corner
  if (random.chance(0.05)) pair.one.points[2] = 0.5 * (p.a + p.b);    // no area
  if (random.chance(0.05)) pair.one.points[0] = p.v[0];
  if (kind.one == 2) pair.one = Hull::segment(pair.one.points[0], pair.one.points[1]);
  if (kind.other == 2) pair.other = Hull::segment(p.v[0], p.v[1]);
  return pair;
}

std::array<Precise3, 3> precise(const Hull& hull) {
  return {Precise3(hull.points[0]), Precise3(hull.points[1]), Precise3(hull.points[2])};
}

double extentOf(const HullPair& pair) {
  double extent = 0.0;
  const Vector3d& origin = pair.other.points[0];
  for (std::size_t i = 0; i < countOf(pair.one.count); ++i) {
    extent += (pair.one.points[i] - origin).lpNorm<1>();
  }
  for (std::size_t j = 0; j < countOf(pair.other.count); ++j) {
    extent += (pair.other.points[j] - origin).lpNorm<1>();
  }
  return extent;
}

struct Judged {
  double truth, lower, upper, slack;
};

/// The plane's clearances themselves, point by point, in fifty digits; and the distance.
Judged judge(const HullPair& pair) {
  const Separation s = separation(pair.one, pair.other);
  const Precise3 n(s.nhat);
  EXPECT_LE(oracle::norm(n), Real(1));
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < countOf(pair.one.count); ++i) {
    const Precise3 x(pair.one.points[i]);
    double tightest = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < countOf(pair.other.count); ++j) {
      const Precise3 y(pair.other.points[j]);
      const double clearance = s.clearance[i] + s.spare[j];
      EXPECT_LE(Real(clearance), oracle::dot(n, x - y)) << i << ' ' << j;
      tightest = std::min(tightest, clearance);
      EXPECT_GE(s.spare[j], 0.0);
    }
    EXPECT_EQ(tightest, s.clearance[i]) << "some point of the other side leaves nothing to spare";
    least = std::min(least, s.clearance[i]);
  }
  EXPECT_EQ(s.lower(), least);
  const double near = 4.0 * kSeparationRounding * extentOf(pair) + 1e-150;
  EXPECT_NEAR(s.difference.norm(), s.distance, near);
  EXPECT_LE((s.onOne - s.onOther - s.difference).norm(),
            near + 8.0 * kUnitRoundoff * pair.other.points[0].norm());
  return {static_cast<double>(oracle::preciseDistance(precise(pair.one), precise(pair.other))),
          s.lower(), s.upper, kSeparationRounding * extentOf(pair)};
}

class Separations : public testing::TestWithParam<Kind> {};

// Owns kSeparationRounding: both bounds hold against fifty digits, and the share of the slack that
// rounding really used is printed, so that a change of the constant is seen for what it is.
TEST_P(Separations, BoundsHoldRoundingIncluded) {
  double worstShare = 0.0;
  int tight = 0;
  constexpr int kCases = 10000;
  for (int i = 0; i < kCases; ++i) {
    SCOPED_TRACE(i);
    test::Random random(static_cast<std::uint64_t>(i));
    const double size = random.magnitude(1e-6, 1e3);
    const Vector3d center =
        i % 3 == 0 ? Vector3d(random.inBox(1e6 * size)) : Vector3d(Vector3d::Zero());
    const Judged j = judge(randomHulls(random, GetParam(), size, center));
    ASSERT_LE(j.lower, j.truth);
    ASSERT_GE(j.upper, j.truth);
    if (j.slack > 0.0) {
      const double used = std::max(j.lower + j.slack - j.truth, j.truth - (j.upper - j.slack));
      worstShare = std::max(worstShare, used / j.slack);
    }
    if (j.upper - j.lower < 1e-9 * size) ++tight;
  }
  std::cout << "worst share of the rounding slack used: " << worstShare << "\n";
  EXPECT_LT(worstShare, 0.5);
  EXPECT_GT(worstShare, 0.001) << "the test no longer sees any rounding";
  EXPECT_GT(tight, kCases * 9 / 10) << "a bound that is not tight proves nothing";
}

TEST_P(Separations, GapOfBoundsIsFarBelowTheSmallestTolerancesWhenApart) {
  for (int i = 0; i < 4000; ++i) {
    SCOPED_TRACE(i);
    test::Random random(static_cast<std::uint64_t>(i));
    const Judged j = judge(randomHulls(random, GetParam(), 2.0, Vector3d::Zero()));
    if (j.truth > 0.01) {
      ASSERT_LT(j.upper - j.lower, 1e-11);
    }
  }
}

/// A corner of one side just above a face of the other, whose far points turn the difference of the
/// closest points into noise: what proves them apart is the face's own normal, on either side of
/// it.
TEST_P(Separations, CornersJustAboveFacesAreProvenApart) {
  const Kind kind = GetParam();
  if (kind.one == 2 && kind.other == 2) return;  // no face
  for (int i = 0; i < 2000; ++i) {
    SCOPED_TRACE(i);
    test::Random random(static_cast<std::uint64_t>(i));
    const Vector3d n = random.direction();
    const Vector3d u = n.unitOrthogonal(), v = n.cross(u);
    const Hull face{{Vector3d(u), Vector3d(-0.5 * u + 0.8 * v), Vector3d(-0.5 * u - 0.8 * v)}, 3};
    const double height = random.magnitude(1e-10, 1e-5);
    const double side = random.chance(0.5) ? 1.0 : -1.0;
    const Vector3d corner = random.uniform(-0.2, 0.2) * u + side * height * n;
    const auto above = [&] {
      return Vector3d(corner + side * random.uniform(0.1, 1.0) * n + random.uniform(-1.0, 1.0) * u +
                      random.uniform(-1.0, 1.0) * v);
    };
    const bool isFaceOther = kind.other == 3 && (kind.one == 2 || random.chance(0.5));
    const int count = isFaceOther ? kind.one : kind.other;
    const Hull tip =
        count == 2 ? Hull::segment(corner, above()) : Hull{{corner, above(), above()}, 3};
    const Separation s = isFaceOther ? separation(tip, face) : separation(face, tip);
    ASSERT_GT(s.lower(), 0.99 * height - 1e-13);
  }
}

/// Edges so nearly parallel that where their lines cross is noise: of two that do not cross, the
/// nearest points are at an end, at every size.
TEST(SeparationOfEdges, ThatAreNearlyParallelIsTight) {
  for (int i = 0; i < 3000; ++i) {
    SCOPED_TRACE(i);
    test::Random random(static_cast<std::uint64_t>(i));
    const double size = random.magnitude(1e-3, 1e3);
    const Vector3d along = random.direction(), away = along.unitOrthogonal();
    const double height = size * random.magnitude(1e-9, 1e-6);
    const Vector3d rise = random.magnitude(1e-9, 1e-7) * size * away;
    const Vector3d start = random.uniform(-0.3, 0.3) * size * along;
    const Hull one = Hull::segment(start, start + size * along);
    const Hull other = Hull::segment(height * away, size * along + height * away + rise);
    const double truth = static_cast<double>(oracle::preciseDistance(precise(one), precise(other)));
    const Separation s = separation(one, other);
    EXPECT_LE(s.upper - truth, 1e-13 * size);
  }
}

/// As corners above faces: what proves edges apart that cross just above each other is the normal
/// of both, on either side.
TEST(SeparationOfEdges, ThatCrossJustAboveEachOtherIsProven) {
  for (int i = 0; i < 2000; ++i) {
    SCOPED_TRACE(i);
    test::Random random(static_cast<std::uint64_t>(i));
    const Vector3d n = random.direction(), u = n.unitOrthogonal(), v = n.cross(u);
    const double height = random.magnitude(1e-10, 1e-5) * (random.chance(0.5) ? 1.0 : -1.0);
    const double angle = random.uniform(0.2, 2.9);
    const Vector3d across = std::cos(angle) * u + std::sin(angle) * v;
    const double early = random.uniform(0.1, 1.0), late = random.uniform(0.1, 1.0);
    const Hull one = Hull::segment(-early * u, late * u);
    const Hull other = Hull::segment(height * n - late * across, height * n + early * across);
    EXPECT_GT(separation(one, other).lower(), 0.99 * std::abs(height) - 1e-13);
  }
}

TEST_P(Separations, SwappingTheSidesTurnsTheNormal) {
  for (int i = 0; i < 2000; ++i) {
    SCOPED_TRACE(i);
    test::Random random(static_cast<std::uint64_t>(i));
    const HullPair pair = randomHulls(random, GetParam(), 1.0, Vector3d::Zero());
    const auto s = separation(pair.one, pair.other);
    const auto swapped = separation(pair.other, pair.one);
    EXPECT_NEAR(s.distance, swapped.distance, 1e-9);
    if (s.lower() > 1e-3) {
      EXPECT_LT((s.nhat + swapped.nhat).norm(), 1e-9);
      EXPECT_LT((s.onOne - swapped.onOther - (s.onOther - swapped.onOne)).norm(), 1e-9);
    }
  }
}

/// In fifty digits, along a direction that is nobody's own.
TEST_P(Separations, ClearancesAndGapsAlongADirectionAreBoundsAndTight) {
  for (int i = 0; i < 2000; ++i) {
    SCOPED_TRACE(i);
    test::Random random(static_cast<std::uint64_t>(i));
    const HullPair pair = randomHulls(random, GetParam(), 1.0, random.inBox(100.0));
    const Vector3d direction = random.direction();
    const auto along = [&](const Vector3d& nhat) {
      Real least = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < countOf(pair.one.count); ++k) {
        for (std::size_t j = 0; j < countOf(pair.other.count); ++j) {
          const Precise3 apart = Precise3(pair.one.points[k]) - Precise3(pair.other.points[j]);
          least = std::min(least, oracle::dot(Precise3(nhat), apart));
        }
      }
      return least;
    };
    const double slack = 4.0 * kSeparationRounding * extentOf(pair);
    const double gap = gapAlong(pair.one, pair.other, direction);
    EXPECT_LE(Real(gap), along(direction));
    EXPECT_GE(Real(gap + slack), along(direction));
    // Never below what proves nothing; else the gap along the unit vector.
    const double clearance = clearanceAlong(pair.one, pair.other, 3.0 * direction);
    if (along(direction) > Real(slack)) {
      EXPECT_LE(Real(clearance), along(direction));
      EXPECT_GE(Real(clearance + slack), along(direction));
    } else {
      EXPECT_LE(clearance, slack);
    }
  }
}

TEST_P(Separations, CrossingPairsAreNeverProvenApart) {
  int crossing = 0;
  for (int i = 0; i < 3000; ++i) {
    test::Random random(static_cast<std::uint64_t>(i));
    HullPair pair = randomHulls(random, GetParam(), 1.0, Vector3d::Zero());
    if (i % 4 == 0) pair.one.points[1] = 0.5 * (pair.other.points[0] + pair.other.points[1]);
    if (pair.one.count == 2) pair.one = Hull::segment(pair.one.points[0], pair.one.points[1]);
    const Judged j = judge(pair);
    if (j.truth > 1e-15) continue;
    ++crossing;
    EXPECT_LE(j.lower, 1e-15);
    EXPECT_LE(j.upper, 1e-7);
  }
  EXPECT_GT(crossing, 150);
}

TEST_P(Separations, DenormalsAndHugeExtentsStayBounded) {
  for (const double size : {1e-310, 1e-200, 1e-150, 1e7}) {
    HullPair pair{{{Vector3d(0, 2, 0) * size, Vector3d(1, 2, 0) * size, Vector3d(0, 3, 1) * size},
                   GetParam().one},
                  {{Vector3d(0, 0, 0), Vector3d(1, 0, 0) * size, Vector3d(0, 0, 1) * size},
                   GetParam().other}};
    if (pair.one.count == 2) pair.one = Hull::segment(pair.one.points[0], pair.one.points[1]);
    if (pair.other.count == 2) {
      pair.other = Hull::segment(pair.other.points[0], pair.other.points[1]);
    }
    const Judged j = judge(pair);
    EXPECT_LE(j.lower, j.truth);
    EXPECT_GE(j.upper, j.truth);
  }
}

std::string nameOf(const testing::TestParamInfo<Kind>& tested) {
  const auto side = [](int count) {
    return count == 2 ? std::string("Segment") : std::string("Triangle");
  };
  return side(tested.param.one) + "And" + side(tested.param.other);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Separations,
                         testing::Values(Kind{2, 3}, Kind{3, 3}, Kind{2, 2}, Kind{3, 2}), nameOf);

}  // namespace
}  // namespace foretouch
