// tests/judge/rational_polynomial_test.cpp: roots and signs against polynomials built from known
// roots.
#include "judge/rational_polynomial.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/random_geometry.h"

namespace foretouch::oracle {
namespace {

using test::Random;

/// The form (t - m/2^k) up to a factor, in x = t/(1-t): x (2^k - m) - m.
Polynomial linearFactor(const Dyadic& t) {
  return {-t.numerator, (Integer(1) << t.exponent) - t.numerator};
}

Polynomial times(const Polynomial& a, const Polynomial& b) {
  Polynomial p(a.size() + b.size() - 1, Integer(0));
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) p[i + j] += a[i] * b[j];
  }
  return p;
}

TEST(InteriorRoots, FindsKnownRootsOnceEachAndInOrder) {
  int repeated = 0;
  for (std::uint64_t i = 0; i < 500; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(i);
    std::vector<int> numerators;
    Polynomial p{Integer(random.chance(0.5) ? 3 : -3)};
    for (int k = 0; k < 4; ++k) {
      const int m = 1 + random.below(15);  // sixteenths, so that some repeat
      p = times(p, linearFactor({m, 4}));
      numerators.push_back(m);
    }
    std::sort(numerators.begin(), numerators.end());
    const auto end = std::unique(numerators.begin(), numerators.end());
    repeated += end != numerators.end() ? 1 : 0;
    numerators.erase(end, numerators.end());
    std::vector<Root> roots = interiorRoots(p);
    ASSERT_EQ(roots.size(), numerators.size());
    for (std::size_t k = 0; k < roots.size(); ++k) {
      EXPECT_EQ(signAt(p, roots[k]), 0);
      refine(roots[k], 60);
      EXPECT_LE(roundedDown(roots[k].low), numerators[k] / 16.0);
      EXPECT_GE(roundedUp(roots[k].high), numerators[k] / 16.0);
      EXPECT_NEAR(roundedUp(roots[k].high), roundedDown(roots[k].low), 1e-15);
    }
  }
  EXPECT_GT(repeated, 50);
}

TEST(InteriorRoots, LeavesOutTheEndsAndWhatIsBeyond) {
  EXPECT_TRUE(interiorRoots({Integer(0), Integer(5)}).empty());              // t = 0 only
  EXPECT_TRUE(interiorRoots({Integer(1), Integer(1)}).empty());              // x = -1
  EXPECT_TRUE(interiorRoots({Integer(1), Integer(0), Integer(1)}).empty());  // x^2 = -1
  EXPECT_TRUE(interiorRoots({Integer(7)}).empty());
}

TEST(SignAtRoot, TellsZeroFromNearlyZero) {
  // x^2 = 2, irrational: x^2 - 2 vanishes there, x - p/q for a convergent p/q does not.
  const Polynomial two{Integer(-2), Integer(0), Integer(1)};
  const std::vector<Root> roots = interiorRoots(two);
  ASSERT_EQ(roots.size(), 1u);
  EXPECT_EQ(signAt(times(two, {Integer(5), Integer(-3)}), roots[0]), 0);
  Integer p = 1, q = 1;
  for (int i = 0; i < 60; ++i) {  // alternately below and above
    EXPECT_EQ(signAt(Polynomial{-p, q}, roots[0]), i % 2 == 0 ? 1 : -1) << i;
    const Integer next = p + 2 * q;
    q = p + q;
    p = next;
  }
}

TEST(Rounding, IsOutwardAndExactWherePossible) {
  EXPECT_EQ(roundedDown({3, 2}), 0.75);
  EXPECT_EQ(roundedUp({3, 2}), 0.75);
  const Dyadic fine{(Integer(1) << 80) + 1, 81};
  EXPECT_EQ(roundedDown(fine), 0.5);
  EXPECT_EQ(roundedUp(fine), std::nextafter(0.5, 1.0));
}

}  // namespace
}  // namespace foretouch::oracle
