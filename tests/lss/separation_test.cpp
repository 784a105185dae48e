#include "lss/separation.h"

#include <algorithm>
#include <iostream>

#include <gtest/gtest.h>

#include "judge/plain_motion.h"
#include "tests/support/random_geometry.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using oracle::Precise3;
using Real = oracle::Precise;

struct Judged {
  double truth, lower, upper, slack;
};

Judged judge(const test::RandomPair& p) {
  const Separation s = separation(p.a, p.b, {p.v});
  const Precise3 n(s.nhat), a(p.a), b(p.b);
  const std::array<Precise3, 3> v = {Precise3(p.v[0]), Precise3(p.v[1]), Precise3(p.v[2])};
  // The plane's clearances themselves, in fifty digits.
  EXPECT_LE(oracle::norm(n), Real(1));
  Real top = oracle::dot(n, v[0]);
  for (const Precise3& vertex : v) top = std::max(top, oracle::dot(n, vertex));
  EXPECT_LE(Real(s.clearanceA), oracle::dot(n, a) - top);
  EXPECT_LE(Real(s.clearanceB), oracle::dot(n, b) - top);
  const double extent = (p.a - p.v[0]).lpNorm<1>() + (p.b - p.v[0]).lpNorm<1>() +
                        (p.v[1] - p.v[0]).lpNorm<1>() + (p.v[2] - p.v[0]).lpNorm<1>();
  return {static_cast<double>(oracle::preciseDistance(a, b, v)), s.lower(), s.upper,
          kSeparationRounding * extent};
}

// Owns kSeparationRounding: both bounds hold against fifty digits, and the share of the slack that
// rounding really used is printed, so that a change of the constant is seen for what it is.
TEST(Separation, BoundsHoldRoundingIncluded) {
  double worstShare = 0.0;
  int tight = 0;
  constexpr int kCases = 40000;
  for (int i = 0; i < kCases; ++i) {
    SCOPED_TRACE(i);
    test::Random random(static_cast<std::uint64_t>(i));
    const double size = random.magnitude(1e-6, 1e3);
    const Vector3d center =
        i % 3 == 0 ? Vector3d(random.inBox(1e6 * size)) : Vector3d(Vector3d::Zero());
    const test::RandomPair p = test::randomPair(random, size, center);
    const Judged j = judge(p);
    ASSERT_LE(j.lower, j.truth);
    ASSERT_GE(j.upper, j.truth);
    if (j.slack > 0.0) {
      const double used = std::max(j.lower + j.slack - j.truth, j.truth - (j.upper - j.slack));
      worstShare = std::max(worstShare, used / j.slack);
    }
    if (j.upper - j.lower < 1e-10 * size) ++tight;
  }
  std::cout << "worst share of the rounding slack used: " << worstShare << "\n";
  EXPECT_LT(worstShare, 0.5);
  EXPECT_GT(worstShare, 0.001) << "the test no longer sees any rounding";
  EXPECT_GT(tight, kCases * 9 / 10) << "a bound that is not tight proves nothing";
}

TEST(Separation, GapOfBoundsIsFarBelowTheSmallestTolerancesWhenApart) {
  for (int i = 0; i < 20000; ++i) {
    SCOPED_TRACE(i);
    test::Random random(static_cast<std::uint64_t>(i));
    const Judged j = judge(test::randomPair(random, 2.0, Vector3d::Zero()));
    if (j.truth > 0.01) {
      ASSERT_LT(j.upper - j.lower, 1e-11);
    }
  }
}

TEST(Separation, CrossingPairsAreNeverProvenApart) {
  int crossing = 0;
  for (int i = 0; i < 5000; ++i) {
    test::Random random(static_cast<std::uint64_t>(i));
    const Judged j = judge(test::randomPair(random, 1.0, Vector3d::Zero()));
    if (j.truth > 0.0) continue;
    ++crossing;
    EXPECT_LE(j.lower, 0.0);
    EXPECT_LE(j.upper, 1e-7);
  }
  EXPECT_GT(crossing, 200);
}

TEST(Separation, DenormalsAndHugeExtentsStayBounded) {
  for (const double size : {1e-310, 1e-200, 1e-150, 1e7}) {
    test::RandomPair p;
    p.a = Vector3d(0, 2, 0) * size;
    p.b = Vector3d(1, 2, 0) * size;
    p.v = {Vector3d(0, 0, 0), Vector3d(1, 0, 0) * size, Vector3d(0, 0, 1) * size};
    const Judged j = judge(p);
    EXPECT_LE(j.lower, j.truth);
    EXPECT_GE(j.upper, j.truth);
  }
}

}  // namespace
}  // namespace foretouch
