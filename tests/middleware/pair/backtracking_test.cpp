#include "middleware/pair/backtracking.h"

#include <cmath>

#include <gtest/gtest.h>

#include "judge/plain_motion.h"
#include "lss/safe_step.h"
#include "tests/support/random_geometry.h"

namespace foretouch::internal {
namespace {

using test::Random;
using Real = oracle::Precise;

// Owns kStepShrink: the step, in fifty digits, keeps the clearance, and wastes nothing.
TEST(SafeStep, NeverOverstepsAndWastesLittle) {
  for (int i = 0; i < 50000; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const double clearance = random.magnitude(1e-12, 1e3);
    const double speed =
        random.chance(0.1) ? 0.0 : random.magnitude(1e-9, 1e3) * (random.chance(0.7) ? -1.0 : 1.0);
    const double acceleration = random.chance(0.1) ? 0.0 : random.magnitude(1e-9, 1e4);
    const double s = safeStep(clearance, speed, acceleration);
    ASSERT_GT(s, 0.0);
    if (std::isinf(s)) {
      ASSERT_TRUE(acceleration == 0.0 && speed >= 0.0);
      continue;
    }
    const auto left = [&](const Real& x) {
      return Real(clearance) + x * Real(speed) - Real(acceleration) * x * x / 2;
    };
    ASSERT_GE(left(Real(s)), Real(0));
    ASSERT_LT(left(Real(s) * (1 + Real("1e-10"))), Real(0))
        << "a shorter step than the bound allows";
  }
}

TEST(Pieces, EveryInstantLiesInThePieceItIsToldToLieIn) {
  for (int count = 1; count <= kMaxPieces; ++count) {
    const Pieces pieces{count};
    for (int k = 0; k < count; ++k) {
      const double begin = pieces.timeOf(k), end = pieces.timeOf(k + 1);
      EXPECT_EQ(pieces.at(begin), k);
      EXPECT_EQ(pieces.at(std::nextafter(end, 0.0)), k);
      if (k > 0) {
        EXPECT_EQ(pieces.at(std::nextafter(begin, 0.0)), k - 1);
      }
    }
    EXPECT_EQ(pieces.timeOf(count), 1.0);
  }
}

}  // namespace
}  // namespace foretouch::internal
