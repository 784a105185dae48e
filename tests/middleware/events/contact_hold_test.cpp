// How long two parts stay in contact, held against parts that move in every way that their bounds
// allow.
#include "middleware/events/contact_hold.h"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "lss/index.h"
#include "tests/support/random_geometry.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;
using test::Random;

/// A part whose points have these velocities, and change them by no more than their bounds.
MovingHull randomPart(Random& random, int count, bool moves) {
  MovingHull part;
  part.hull.count = count;
  for (std::size_t i = 0; i < 3; ++i) part.hull.points[i] = random.inBox(0.3);
  part.radius = count == 2 && random.chance(0.7) ? random.magnitude(1e-3, 0.1) : 0.0;
  part.moves = moves;
  const Vector3d common = random.inBox(random.magnitude(0.01, 3.0));
  for (std::size_t i = 0; i < 3; ++i) {
    part.velocity[i] = common + random.inBox(0.3);
    part.acceleration[i] = random.chance(0.3) ? 0.0 : random.magnitude(0.01, 10.0);
  }
  return part;
}

/// As it is after `s`, if each point is pushed in a direction of its own.
Hull after(const MovingHull& part, const std::array<Vector3d, 3>& pushes, double s) {
  Hull hull = part.hull;
  if (!part.moves) return hull;
  for (std::size_t i = 0; i < 3; ++i) {
    hull.points[i] += s * part.velocity[i] + 0.5 * s * s * part.acceleration[i] * pushes[i];
  }
  return hull;
}

std::array<Vector3d, 3> pushes(Random& random) {
  return {random.direction(), random.direction(), random.direction()};
}

struct HoldTally {
  int held = 0, whole = 0;
};

/// The furthest apart that the two come while they are said to hold, less the radii.
template <typename Says>
HoldTally holdAll(int count, int otherCount, double limit, const Says& says) {
  HoldTally tally;
  for (int i = 0; i < 3000; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    const MovingHull one = randomPart(random, count, true);
    const MovingHull other = randomPart(random, otherCount, random.chance(0.5));
    const MovingPair pair = movingPair(one, other);
    const double rest = random.chance(0.2) ? 0.01 : 1.0, held = says(pair, rest);
    EXPECT_LE(held, rest);
    tally.held += held > 0.0 ? 1 : 0;
    tally.whole += held == rest ? 1 : 0;
    const auto ofOne = pushes(random), ofOther = pushes(random);
    for (int k = 0; k <= 20 && held > 0.0; ++k) {
      const double s = held * k / 20.0;
      const Separation apart = separation(after(one, ofOne, s), after(other, ofOther, s));
      const double gap = apart.distance - one.radius - other.radius;
      EXPECT_LE(gap, limit + 1e-12) << "case " << i << " after " << s << " of " << held;
    }
  }
  return tally;
}

TEST(ContactHold, StaysWithinTheLimit) {
  for (const int otherCount : {2, 3}) {
    const HoldTally tally = holdAll(2, otherCount, 0.02, [](const MovingPair& pair, double rest) {
      return staysWithin(pair, 0.02, rest);
    });
    EXPECT_GT(tally.held, 300);
    EXPECT_GT(tally.whole, 20);
    EXPECT_LT(tally.whole, tally.held);
  }
}

TEST(ContactHold, StaysPierced) {
  for (const int count : {2, 3}) {
    const HoldTally tally = holdAll(count, 3, 0.0, [](const MovingPair& pair, double rest) {
      return staysPierced(pair, rest);
    });
    EXPECT_GT(tally.held, 100);
    EXPECT_GT(tally.whole, 5);
    EXPECT_LT(tally.whole, tally.held);
  }
}

// Nothing but points that move: they part when they are two tolerances and their radii apart.
TEST(ContactHold, IsHardlyShorterThanTheTruth) {
  MovingHull one, other;
  one.hull = Hull::segment(Vector3d::Zero(), Vector3d::Zero());
  other.hull = Hull::segment(Vector3d(0.1, 0, 0), Vector3d(0.1, 0, 0));
  one.radius = other.radius = 0.1;
  one.moves = true;
  one.velocity = {Vector3d(1, 0, 0), Vector3d(1, 0, 0), Vector3d::Zero()};
  const double held = staysWithin(movingPair(one, other), 0.002, 1.0);  // until x = 0.302
  EXPECT_LE(held, 0.302);
  EXPECT_GT(held, 0.98 * 0.302);
  EXPECT_EQ(staysWithin(movingPair(one, other), 0.002, 0.3), 0.3);
  EXPECT_EQ(staysWithin(movingPair(one, other), -0.11, 1.0), 0.0);  // farther apart now
}

// A needle that slides along itself through a triangle: as far as its end, and not by tolerances.
TEST(ContactHold, TakesStepsOfTheTrianglesSize) {
  MovingHull needle;
  needle.hull = Hull::segment(Vector3d(0, 0, -1), Vector3d(0, 0, 1));
  needle.moves = true;
  needle.velocity = {Vector3d(0, 0, 1), Vector3d(0, 0, 1), Vector3d::Zero()};
  const MovingHull triangle =
      MovingHull::still({{Vector3d(-1, -1, 0), Vector3d(1, -1, 0), Vector3d(0, 1, 0)}});
  const MovingPair pair = movingPair(needle, triangle);
  EXPECT_GT(staysPierced(pair, 1.0), 0.05);
  EXPECT_LE(staysPierced(pair, 10.0), 1.0);
  EXPECT_LT(staysWithin(pair, 1e-6, 1.0), 1e-5);
}

}  // namespace
}  // namespace foretouch::internal
