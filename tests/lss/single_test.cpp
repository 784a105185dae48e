#include "lss/single.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/random_geometry.h"

namespace foretouch {
namespace {

/// A float's bits say so: a double that a float holds has its last 29 bits clear (normal numbers).
bool hasFloatsBits(double number) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &number, sizeof bits);
  return (bits & ((std::uint64_t{1} << 29) - 1)) == 0;
}

TEST(NearestFloat, RoundsInLoopsThatTheCompilerVectorises) {
  test::Random random(1);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 3000; ++i) points.push_back(random.inBox(1) * random.magnitude(1e-20, 1e20));
  int inexact = 0;
  for (Eigen::Vector3d& p : points) {
    const Eigen::Vector3d before = p;
    p = nearestFloat(p);
    inexact += p != before;
    ASSERT_LE((p - before).cwiseAbs().maxCoeff(), 6e-8 * before.cwiseAbs().maxCoeff());
  }
  for (const Eigen::Vector3d& p : points) {
    for (const double number : p) ASSERT_TRUE(hasFloatsBits(number)) << number;
  }
  EXPECT_GT(inexact, 2900);
}

TEST(NearestFloat, KeepsFloatsTheSignOfZeroAndInfinity) {
  for (const double number : {0.0, 1.0, -0.5, 16777216.0}) {
    EXPECT_EQ(nearestFloat(number), number);
  }
  EXPECT_TRUE(std::signbit(nearestFloat(-0.0)));
  EXPECT_EQ(nearestFloat(1e300), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(nearestFloat(std::nan(""))));
}

}  // namespace
}  // namespace foretouch
