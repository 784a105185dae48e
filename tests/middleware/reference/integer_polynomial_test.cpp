#include "tests/reference/integer_polynomial.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace foretouch::internal {
namespace {

Polynomial polynomial(long c0, long c1, long c2 = 0, long c3 = 0) {
  Polynomial p;
  p.c = {c0, c1, c2, c3};
  return p;
}

/// The bracket's lower end, as a double.
double lowOf(const Root& root) {
  return std::ldexp(static_cast<double>(root.low.numerator), -root.low.log2);
}

void expectRoots(const Polynomial& p, const std::vector<double>& expected) {
  Roots roots(p);
  ASSERT_EQ(roots.count(), static_cast<int>(expected.size()));
  for (int i = 0; i < roots.count(); ++i) {
    EXPECT_LE(lowOf(roots[i]), expected[i]);
    EXPECT_GE(lowOf(roots[i]) + std::ldexp(1.0, -kRootBits), expected[i]);
    EXPECT_EQ(signAt(p, roots[i]), 0);
  }
}

TEST(Roots, OfSimpleRootsEachIsFound) {
  expectRoots(polynomial(-1, 3), {1.0 / 3.0});
  expectRoots(polynomial(-1, 0, 2), {std::sqrt(0.5)});
  expectRoots(polynomial(-6, 11 * 5, -6 * 25, 125), {0.2, 0.4, 0.6});  // (5t-1)(5t-2)(5t-3)
  expectRoots(polynomial(1, 1), {});
  expectRoots(polynomial(5, 0), {});
}

TEST(Roots, AtTheEndsOfTheUnitSpanCount) {
  expectRoots(polynomial(0, 1), {0.0});
  expectRoots(polynomial(-1, 1), {1.0});
  expectRoots(polynomial(0, 1, -3, 2), {0.0, 0.5, 1.0});
  expectRoots(polynomial(0, 0, 0, 7), {0.0});
}

TEST(Roots, ThatAreMultipleAreFoundOnce) {
  expectRoots(polynomial(1, -6, 9), {1.0 / 3.0});                    // (3t-1)^2
  expectRoots(polynomial(-1, 9, -27, 27), {1.0 / 3.0});              // (3t-1)^3
  expectRoots(polynomial(-2, 15, -36, 27), {1.0 / 3.0, 2.0 / 3.0});  // (3t-1)^2 (3t-2)
  expectRoots(polynomial(1, -4, 4), {0.5});
}

TEST(Roots, ThatAreCloseComeApart) {
  const long n = 1L << 30;  // (nt - 1)(nt - 2): 2^-30 apart
  Polynomial p;
  p.c = {2, -3 * Integer(n), Integer(n) * n, 0};
  expectRoots(p, {std::ldexp(1.0, -30), std::ldexp(2.0, -30)});
  const Integer m = Integer(1) << 300;  // and 2^-300 apart, far below what doubles resolve
  p.c = {m * m / 9 + 2 * m / 3, -2 * m * m / 3 - 2 * m, m * m, 0};  // near a double root at 1/3
  Roots roots(p);
  for (int i = 0; i < roots.count(); ++i) EXPECT_NEAR(lowOf(roots[i]), 1.0 / 3.0, 1e-9);
}

TEST(SignAt, OfARootIsExact) {
  Roots third(polynomial(-1, 3));
  EXPECT_EQ(signAt(polynomial(-1, 3), third[0]), 0);
  EXPECT_EQ(signAt(polynomial(1, -3), third[0]), 0);
  EXPECT_EQ(signAt(polynomial(-1, 2), third[0]), -1);
  EXPECT_EQ(signAt(Polynomial{}, third[0]), 0);
  Polynomial nearly;  // 3t - 1 - 2^-400: negative at 1/3, by less than any double tells
  const Integer m = Integer(1) << 400;
  nearly.c = {-m - 1, 3 * m, 0, 0};
  EXPECT_EQ(signAt(nearly, third[0]), -1);
  nearly.c[0] += 2;
  EXPECT_EQ(signAt(nearly, third[0]), 1);
}

TEST(SignAt, OfAnIrrationalRootSharedByAnotherPolynomialIsZero) {
  Roots root(polynomial(-1, 0, 2));                         // sqrt(1/2)
  EXPECT_EQ(signAt(polynomial(-3, 1, 6, -2), root[0]), 0);  // (2t^2 - 1)(3 - t)
  EXPECT_EQ(signAt(polynomial(-3, 1, 6, -1), root[0]), 1);
}

}  // namespace
}  // namespace foretouch::internal
