// Points of a contact lie on both surfaces, by distances of their own.
#include "middleware/query/manifold.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "lss/separation.h"
#include "tests/support/random_geometry.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;
using test::Random;

/// From the segment, in closed form.
double fromSegment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d d = b - a;
  const double length = d.squaredNorm();
  const double share = length > 0.0 ? std::clamp((p - a).dot(d) / length, 0.0, 1.0) : 0.0;
  return (p - a - share * d).norm();
}

/// From the triangle: by its plane where the foot of the perpendicular lies within, else by edges.
double fromTriangle(const Vector3d& p, const Hull& t) {
  const Vector3d &a = t.points[0], &b = t.points[1], &c = t.points[2];
  const Vector3d n = (b - a).cross(c - a);
  const bool isAbove = n.cross(b - a).dot(p - a) >= 0.0 && n.cross(c - b).dot(p - b) >= 0.0 &&
                       n.cross(a - c).dot(p - c) >= 0.0;
  if (isAbove) return std::abs(n.dot(p - a)) / n.norm();
  return std::min({fromSegment(p, a, b), fromSegment(p, b, c), fromSegment(p, c, a)});
}

double offSurface(const Vector3d& p, const ManifoldPart& part) {
  if (part.hull.count == 3) return fromTriangle(p, part.hull);
  return std::abs(fromSegment(p, part.hull.points[0], part.hull.points[1]) - part.radius);
}

ManifoldPart lssIn(Random& random, double half) {
  const Vector3d a = random.inBox(half), b = random.inBox(half);
  return {Hull::segment(a, b), random.uniform(0.01, 0.2), 0, -1};
}

TEST(Manifold, TellsPointsOnBothSurfaces) {
  Random random(20);
  std::size_t points = 0, several = 0, missing = 0;
  for (int i = 0; i < 20'000; ++i) {
    const ManifoldPart one = lssIn(random, 0.3);
    ManifoldPart other = lssIn(random, 0.3);
    if (i % 2 == 1) {
      const Triangle triangle{{random.inBox(0.3), random.inBox(0.3), random.inBox(0.3)}};
      other = {Hull::of(triangle), 0.0, -1, 0};
    }
    const Separation apart = separation(one.hull, other.hull);
    const Vector3d nhat =
        apart.distance > 0.0 ? Vector3d(apart.difference.normalized()) : random.direction();
    Manifold manifold;
    manifold.begin(0.02, nhat);
    manifold.offer(one, other);
    ContactDetails details;
    manifold.choose(details);
    for (std::size_t k = 0; k < details.numPoints; ++k) {
      const ContactPoint& point = details.points[k];
      ASSERT_LE(offSurface(point.p_WLink, one), 2e-9) << i;
      ASSERT_LE(offSurface(point.p_WOther, other), 2e-9) << i;
    }
    points += details.numPoints;
    several += details.numPoints > 1 ? 1 : 0;
    const double gap = apart.distance - one.radius - other.radius;
    missing += details.numPoints == 0 && apart.distance > 1e-6 && gap <= 0.02 ? 1 : 0;
  }
  EXPECT_GT(points, 10'000u);
  EXPECT_GT(several, 2'000u);
  EXPECT_EQ(missing, 0u);
}

}  // namespace
}  // namespace foretouch::internal
