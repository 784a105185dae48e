// Sides of lines and planes against fifty digits, where doubles alone would often be wrong.
#include "middleware/exact/side_of.h"

#include <cmath>

#include <gtest/gtest.h>

#include "judge/plain_motion.h"
#include "tests/support/random_geometry.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;
using oracle::Precise3;
using Real = oracle::Precise;

/// What is not zero here is far above 1e-40.
int signOfPrecise(const Real& value) {
  return value > Real("1e-40") ? 1 : value < Real("-1e-40") ? -1 : 0;
}

/// Of single precision: products of three are exact in fifty digits, and not in doubles.
Vector3d roundedToFloat(const Vector3d& p) {
  return p.cast<float>().cast<double>();
}

/// By chance the doubles' determinant has another sign than the true one.
TEST(SideOf, TurnsAreThoseOfFiftyDigits) {
  int ofEach[3] = {}, wrongInDoubles = 0;
  for (std::uint64_t seed = 0; seed < 20'000; ++seed) {
    test::Random random(seed);
    const Vector3d a = random.inBox(2.0), b = a + random.inBox(1.0);
    Vector3d p = a + random.uniform(-1.0, 2.0) * (b - a);
    if (random.chance(0.2)) p = random.chance(0.5) ? a : b;
    if (random.chance(0.1)) p.x() = std::nextafter(p.x(), 9.0);
    const Precise3 u = Precise3(b) - Precise3(a), v = Precise3(p) - Precise3(a);
    const int truth = signOfPrecise(u.x * v.y - u.y * v.x);
    ASSERT_EQ(turnOf(a, b, p), truth) << seed;
    const Vector3d w = b - a, x = p - a;
    const double inDoubles = w.x() * x.y() - w.y() * x.x();
    wrongInDoubles += (inDoubles > 0.0) - (inDoubles < 0.0) != truth;
    ++ofEach[truth + 1];
  }
  for (const int count : ofEach) EXPECT_GT(count, 1000);
  EXPECT_GT(wrongInDoubles, 100);
}

TEST(SideOf, SidesAreThoseOfFiftyDigits) {
  int ofEach[3] = {}, wrongInDoubles = 0;
  for (std::uint64_t seed = 0; seed < 20'000; ++seed) {
    test::Random random(seed);
    Vector3d points[3];
    for (Vector3d& p : points) p = roundedToFloat(random.inBox(1.0));
    const auto& [a, b, c] = points;
    Vector3d d = roundedToFloat(a + random.uniform(-1.0, 2.0) * (b - a) +
                                random.uniform(-1.0, 2.0) * (c - a));
    // On the plane to the last bits of a double, or exactly.
    if (random.chance(0.5)) d = a + 0.5 * (b - a) + 0.25 * (c - a);
    const Precise3 u = Precise3(b) - Precise3(a), v = Precise3(c) - Precise3(a),
                   w = Precise3(d) - Precise3(a);
    const int truth = signOfPrecise(u.x * (v.y * w.z - v.z * w.y) + u.y * (v.z * w.x - v.x * w.z) +
                                    u.z * (v.x * w.y - v.y * w.x));
    ASSERT_EQ(sideOf(a, b, c, d), truth) << seed;
    const double inDoubles = (b - a).dot((c - a).cross(d - a));
    wrongInDoubles += (inDoubles > 0.0) - (inDoubles < 0.0) != truth;
    ++ofEach[truth + 1];
  }
  for (const int count : ofEach) EXPECT_GT(count, 1000);
  EXPECT_GT(wrongInDoubles, 100);
}

}  // namespace
}  // namespace foretouch::internal
