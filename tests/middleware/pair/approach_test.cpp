// How fast two points meet, against the root of its quadratic.
#include "middleware/pair/approach.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/random_geometry.h"

namespace foretouch::internal {
namespace {

TEST(Approach, LosesWhatTheAccelerationsTakeUntilTheyMeet) {
  int meeting = 0, apart = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    SCOPED_TRACE(seed);
    test::Random random(seed);
    const Eigen::Vector3d nhat = random.direction();
    const double speed = random.uniform(0.1, 5.0), gap = random.magnitude(1e-3, 10.0);
    const double rest = random.uniform(0.01, 20.0);
    const Eigen::Vector3d common = random.inBox(3.0), across = nhat.cross(random.inBox(1.0));
    const MaterialPoint one{common - speed * nhat + across, random.uniform(0.01, 1.0),
                            random.uniform(0.0, 0.1)};
    const MaterialPoint other{common, random.uniform(0.01, 1.0), random.uniform(0.0, 0.1)};
    // Slowed down by both, after a time t it has closed speed t - a t^2 / 2 of the gap.
    const double a = one.acceleration + other.acceleration;
    const double square = speed * speed - 2.0 * a * gap;
    const bool meets = square > 0.0 && (speed - std::sqrt(square)) / a < rest;
    ++(meets ? meeting : apart);
    const double least = meets ? std::sqrt(square) : speed - a * rest;
    const double rounding = one.velocityRounding + other.velocityRounding;
    const Approach found = approachAlong(nhat, gap, one, other, rest);
    EXPECT_NEAR(found.speed, speed, 1e-14);
    EXPECT_NEAR(found.lower, least - rounding, 1e-12 * (1.0 + a * rest));
    EXPECT_NEAR(found.upper + found.lower, 2.0 * speed, 1e-13 * (1.0 + a * rest));
  }
  EXPECT_GT(meeting, 100);
  EXPECT_GT(apart, 100);
}

}  // namespace
}  // namespace foretouch::internal
