// How long a clearance lasts: the parabola in fifty digits, never below zero until then, and below
// it right after.
#include "lss/safe_step.h"

#include <cmath>

#include <gtest/gtest.h>

#include "judge/plain_motion.h"
#include "tests/support/random_geometry.h"

namespace foretouch {
namespace {

using Real = oracle::Precise;

TEST(SafeStep, LastsAsLongAsTheClearanceAndHardlyShorter) {
  int neverEnds = 0, closing = 0, turning = 0;
  for (int i = 0; i < 20000; ++i) {
    SCOPED_TRACE(i);
    test::Random random(static_cast<std::uint64_t>(i));
    const double clearance = random.magnitude(1e-12, 1e3);
    const double acceleration = random.chance(0.2) ? 0.0 : random.magnitude(1e-9, 1e6);
    double speed = random.magnitude(1e-9, 1e3) * (random.chance(0.5) ? 1.0 : -1.0);
    if (random.chance(0.1)) speed = 0.0;
    const double s = internal::safeStep(clearance, speed, acceleration);
    if (speed >= 0.0 && acceleration == 0.0) {
      EXPECT_TRUE(std::isinf(s));
      ++neverEnds;
      continue;
    }
    (speed <= 0.0 ? closing : turning) += 1;
    const auto left = [&](const Real& t) {
      return Real(clearance) + t * Real(speed) - Real(acceleration) * t * t / Real(2);
    };
    ASSERT_GT(s, 0.0);
    // Concave, and above zero at its begin: what is not below zero at the end was never.
    EXPECT_GE(left(Real(s)), Real(0));
    EXPECT_LT(left(Real(s) * (Real(1) + Real(1e-11))), Real(0));
  }
  EXPECT_GT(neverEnds, 500);
  EXPECT_GT(closing, 5000);
  EXPECT_GT(turning, 5000);
}

}  // namespace
}  // namespace foretouch
