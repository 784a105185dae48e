// Whether a point is within a distance of a triangle, against fifty digits, an ulp beside it.
#include "middleware/exact/within_distance.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "judge/plain_distance.h"
#include "tests/support/random_geometry.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;
using oracle::Precise;
using PrecisePoint = oracle::Vec3<Precise>;

Precise distanceOf(const Vector3d& p, const Triangle& triangle) {
  const auto& v = triangle.vertices;
  return oracle::preciseDistance(PrecisePoint(p), PrecisePoint(p),
                                 {PrecisePoint(v[0]), PrecisePoint(v[1]), PrecisePoint(v[2])});
}

TEST(IsWithin, AgreesWithFiftyDigitsAnUlpBesideTheDistance) {
  int within = 0, beyond = 0;
  for (int i = 0; i < 6000; ++i) {
    SCOPED_TRACE(i);
    test::Random random(static_cast<std::uint64_t>(i));
    const Vector3d far = i % 3 == 0 ? Vector3d(random.inBox(1e6)) : Vector3d(Vector3d::Zero());
    const test::RandomPair pair = test::randomPair(random, 1.0, far);
    const Triangle triangle{pair.v};
    Vector3d p = pair.a;
    if (random.chance(0.6)) {  // near a corner, an edge or the face
      Vector3d weights = random.inBox(1.0).cwiseAbs();
      if (random.chance(0.6)) weights.x() = 0.0;
      if (random.chance(0.3)) weights.y() = 0.0;
      weights /= weights.sum();
      p = weights.x() * pair.v[0] + weights.y() * pair.v[1] + weights.z() * pair.v[2];
      const double off = random.magnitude(1e-15, 1e-2);
      p += off * random.direction();
    }
    const Precise truth = distanceOf(p, triangle);
    const double about = static_cast<double>(truth);
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double distance : {0.0, 0.5 * about, std::nextafter(about, 0.0), about,
                                  std::nextafter(about, infinity), 2.0 * about}) {
      // What rounds to the distance in fifty digits is not judged.
      if (abs(truth - Precise(distance)) <= Precise("1e-40")) continue;
      ASSERT_EQ(isWithin(p, triangle, distance), truth < Precise(distance)) << distance;
      ++(truth < Precise(distance) ? within : beyond);
    }
  }
  EXPECT_GT(within, 10000);
  EXPECT_GT(beyond, 10000);
}

TEST(IsWithin, IsSoAtTheDistanceItself) {
  const Triangle flat{{Vector3d(0, 0, 0), Vector3d(4, 0, 0), Vector3d(0, 4, 0)}};
  for (const Vector3d& p : {Vector3d(1, 1, 5), Vector3d(2, -3, 4), Vector3d(-3, 0, -4)}) {
    EXPECT_TRUE(isWithin(p, flat, 5.0)) << p.transpose();
    EXPECT_FALSE(isWithin(p, flat, std::nextafter(5.0, 0.0))) << p.transpose();
  }
  EXPECT_TRUE(isWithin(Vector3d(1, 1, 0), flat, 0.0));
  EXPECT_FALSE(isWithin(Vector3d(1, 1, 1e-300), flat, 0.0));
  const Triangle point{{Vector3d(1, 2, 3), Vector3d(1, 2, 3), Vector3d(1, 2, 3)}};
  EXPECT_TRUE(isWithin(Vector3d(1, 2, 3), point, 0.0));
  EXPECT_FALSE(isWithin(Vector3d(1, 2, 4), point, 0.5));
  EXPECT_TRUE(isWithin(Vector3d(1, 2, 4), point, std::numeric_limits<double>::infinity()));
}

}  // namespace
}  // namespace foretouch::internal
