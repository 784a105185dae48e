#include "lss/rounding.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/support/random_geometry.h"

namespace foretouch {
namespace {

using internal::floatAbove;
using internal::floatBelow;
using internal::floatPaddedAbove;
using internal::timeAfter;

float nextUp(float x) {
  return std::nextafter(x, std::numeric_limits<float>::infinity());
}

/// Of either sign, from below the least float to near the largest.
double anyNumber(test::Random& random) {
  return random.magnitude(1e-50, 1e38) * (random.chance(0.5) ? 1.0 : -1.0);
}

TEST(FloatBounds, NeverRoundInward) {
  test::Random random(3);
  int inexact = 0;
  for (int i = 0; i < 100000; ++i) {
    const double x = anyNumber(random);
    const float below = floatBelow(x), above = floatAbove(x);
    ASSERT_LE(static_cast<double>(below), x);
    ASSERT_GE(static_cast<double>(above), x);
    // Neighbours, or one and the same.
    ASSERT_TRUE(above == below || above == nextUp(below)) << x;
    inexact += above != below ? 1 : 0;
  }
  EXPECT_GT(inexact, 99000);
}

TEST(FloatBounds, KeepFloatsAndWhatIsBeyondThem) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const float x : {0.5F, -0.5F, 0.0F, 0x1p-149F, std::numeric_limits<float>::max()}) {
    EXPECT_EQ(floatBelow(double{x}), x);
    EXPECT_EQ(floatAbove(double{x}), x);
  }
  EXPECT_EQ(floatBelow(2.0 * kLargest), std::numeric_limits<float>::max());
  EXPECT_EQ(floatAbove(2.0 * kLargest), kInfinity);
  EXPECT_EQ(floatBelow(-2.0 * kLargest), -kInfinity);
}

// Owns kFloatPadding and kFloatUnderflow.
TEST(FloatBounds, PaddingIsOutwardAndSmall) {
  test::Random random(4);
  int padded = 0;
  for (int i = 0; i < 100000; ++i) {
    const double x = anyNumber(random);
    const float above = floatPaddedAbove(x);
    ASSERT_GE(static_cast<double>(above), x);
    const float below = -floatPaddedAbove(-x);
    ASSERT_LE(static_cast<double>(below), x);
    if (std::abs(x) < 1e-30) continue;
    ASSERT_LE(above, nextUp(nextUp(floatAbove(x)))) << x;
    padded += above != floatAbove(x) ? 1 : 0;
  }
  EXPECT_GT(padded, 10000);
  EXPECT_GT(floatPaddedAbove(0.0), 0.0F);
}

TEST(TimeAfter, IsNeverLate) {
  test::Random random(5);
  int early = 0;
  for (int i = 0; i < 100000; ++i) {
    const double t = random.uniform(0.0, 1.0), step = random.magnitude(1e-18, 1.0);
    const double after = timeAfter(t, step, 1.0);
    if (after == 1.0) {
      // No double is between 1 and what rounds to 1.
      ASSERT_GE(static_cast<long double>(t) + step, 1.0L - 0x1p-54L);
      continue;
    }
    ASSERT_LT(after, 1.0);
    ASSERT_LE(static_cast<long double>(after), static_cast<long double>(t) + step);
    ASSERT_GE(after, t - 0x1p-53);
    ++early;
  }
  EXPECT_GT(early, 80000);
}

}  // namespace
}  // namespace foretouch
