#include "lss/triangle_separation.h"

#include <algorithm>
#include <iostream>

#include <gtest/gtest.h>

#include "judge/plain_motion.h"
#include "lss/separation.h"
#include "tests/support/random_geometry.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using oracle::Precise3;
using Real = oracle::Precise;

std::array<Precise3, 3> precise(const Triangle& t) {
  return {Precise3(t.vertices[0]), Precise3(t.vertices[1]), Precise3(t.vertices[2])};
}

Real preciseTriangleDistance(const Triangle& one, const Triangle& other) {
  return oracle::preciseDistance(precise(one), precise(other));
}

struct Pair {
  Triangle one, other;
};

Pair randomTriangles(test::Random& random, double size, const Vector3d& center) {
  Pair pair;
  const test::RandomPair p = test::randomPair(random, size, center);
  pair.one.vertices = {p.a, p.b, center + random.inBox(size)};
  pair.other.vertices = p.v;
  if (random.chance(0.1)) pair.one.vertices[2] = pair.other.vertices[1];  // a shared corner
  if (random.chance(0.05)) pair.one.vertices[2] = 0.5 * (p.a + p.b);      // no area
  if (random.chance(0.05)) pair.one.vertices = {p.v[0], p.v[1], center + random.inBox(size)};
  return pair;
}

TEST(TriangleSeparation, BoundsHoldRoundingIncluded) {
  double worstShare = 0.0;
  int tight = 0;
  constexpr int kCases = 4000;
  for (int i = 0; i < kCases; ++i) {
    SCOPED_TRACE(i);
    test::Random random(static_cast<std::uint64_t>(i));
    const double size = random.magnitude(1e-6, 1e3);
    const Vector3d center = i % 3 == 0 ? Vector3d(random.inBox(1e6 * size)) : Vector3d(0, 0, 0);
    const Pair pair = randomTriangles(random, size, center);
    const TriangleSeparation s = triangleSeparation(pair.one, pair.other);
    const double truth = static_cast<double>(preciseTriangleDistance(pair.one, pair.other));
    ASSERT_LE(s.lower(), truth);
    ASSERT_GE(s.upper, truth);
    const Precise3 n(s.nhat);
    ASSERT_LE(oracle::norm(n), Real(1));
    double extent = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      extent += (pair.one.vertices[k] - pair.other.vertices[0]).lpNorm<1>();
      extent += (pair.other.vertices[k] - pair.other.vertices[0]).lpNorm<1>();
      for (const Vector3d& vertex : pair.other.vertices) {
        ASSERT_LE(Real(s.clearance[k]),
                  oracle::dot(n, Precise3(pair.one.vertices[k]) - Precise3(vertex)));
      }
    }
    const double slack = kSeparationRounding * extent;
    if (slack > 0.0) {
      worstShare = std::max(
          {worstShare, (s.lower() + slack - truth) / slack, (truth - (s.upper - slack)) / slack});
    }
    if (s.upper - s.lower() < 1e-9 * size) ++tight;
  }
  std::cout << "worst share of the rounding slack used: " << worstShare << "\n";
  EXPECT_LT(worstShare, 0.5);
  EXPECT_GT(worstShare, 0.001) << "the test no longer sees any rounding";
  EXPECT_GT(tight, kCases * 9 / 10) << "a bound that is not tight proves nothing";
}

TEST(TriangleSeparation, SwappingTheTrianglesTurnsTheNormal) {
  for (int i = 0; i < 2000; ++i) {
    SCOPED_TRACE(i);
    test::Random random(static_cast<std::uint64_t>(i));
    const Pair pair = randomTriangles(random, 1.0, Vector3d::Zero());
    const auto s = triangleSeparation(pair.one, pair.other);
    const auto swapped = triangleSeparation(pair.other, pair.one);
    EXPECT_NEAR(s.distance, swapped.distance, 1e-12);
    if (s.lower() > 1e-3) {
      EXPECT_LT((s.nhat + swapped.nhat).norm(), 1e-9);
    }
  }
}

TEST(TriangleSeparation, PiercingTrianglesAreNeverProvenApart) {
  int piercing = 0;
  for (int i = 0; i < 3000; ++i) {
    test::Random random(static_cast<std::uint64_t>(i));
    const Pair pair = randomTriangles(random, 1.0, Vector3d::Zero());
    if (preciseTriangleDistance(pair.one, pair.other) > Real(0)) continue;
    ++piercing;
    const auto s = triangleSeparation(pair.one, pair.other);
    EXPECT_LE(s.lower(), 0.0);
    EXPECT_LE(s.upper, 1e-7);
  }
  EXPECT_GT(piercing, 300);
}

}  // namespace
}  // namespace foretouch
