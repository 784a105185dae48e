#include "tessellation/sheet_bound.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/support/random_geometry.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

/// At most this far from the patch: the least over its rulings, each a segment, searched ever
/// finer.
double distanceToPatch(const AxisEnds& begin, const AxisEnds& end, const Vector3d& p) {
  const auto apart = [&](double t) {
    const Vector3d a = begin.a + t * (end.a - begin.a), b = begin.b + t * (end.b - begin.b);
    const double square = (b - a).squaredNorm();
    const double s = square > 0.0 ? std::clamp((p - a).dot(b - a) / square, 0.0, 1.0) : 0.0;
    return (a + s * (b - a) - p).norm();
  };
  double best = 0.0, least = apart(0.0);
  for (int i = 1; i <= 256; ++i) {
    if (apart(i / 256.0) < least) least = apart(best = i / 256.0);
  }
  for (double step = 1.0 / 256; step > 1e-12; step *= 0.7) {
    for (const double t : {best - step, best + step}) {
      if (t >= 0.0 && t <= 1.0 && apart(t) < least) least = apart(best = t);
    }
  }
  return least;
}

AxisEnds moved(const AxisEnds& ends, const Vector3d& axis, double angle, const Vector3d& about,
               const Vector3d& shift) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  return {about + turn * (ends.a - about) + shift, about + turn * (ends.b - about) + shift};
}

TEST(HullLeavesSheetBy, BoundsEveryPointOfTheHull) {
  double closest = 0.0;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    AxisEnds begin{random.inBox(0.3), random.inBox(0.3)};
    if (random.chance(0.1)) begin.b = begin.a;
    AxisEnds end = moved(
        begin, random.direction(), random.magnitude(1e-4, 2.0),
        random.chance(0.3) ? Vector3d(0.5 * (begin.a + begin.b)) : Vector3d(random.inBox(0.5)),
        random.chance(0.5) ? Vector3d::Zero() : random.inBox(0.2));
    if (random.chance(0.1)) end = {random.inBox(0.3), random.inBox(0.3)};
    if (random.chance(0.1)) end.a = begin.a;
    const double bound = hullLeavesSheetBy(begin, end);
    for (int i = 0; i < 8; ++i) {
      Eigen::Vector4d w;
      for (double& x : w) x = random.chance(0.3) ? 0.0 : random.uniform(0, 1);
      if (w.sum() == 0.0) continue;
      w /= w.sum();
      const double apart = distanceToPatch(
          begin, end, w[0] * begin.a + w[1] * begin.b + w[2] * end.a + w[3] * end.b);
      ASSERT_LE(apart, bound + 1e-10);
      if (bound > 1e-6) closest = std::max(closest, apart / bound);
    }
  }
  EXPECT_GT(closest, 0.9);
}

/// A flat turn about a point beyond an end: the sheet and its hull are the same but for the second
/// order. About the middle: the bow tie's hull is wider by a quarter of the ends' relative path.
TEST(HullLeavesSheetBy, IsOfSecondOrderWhereTheEndsMoveToOneSide) {
  const AxisEnds axis{{0, 0, 0}, {0.3, 0.05, 0}};
  double previous = 0.0;
  for (const double angle : {0.04, 0.02, 0.01}) {
    const double bound = hullLeavesSheetBy(
        axis, moved(axis, Vector3d::UnitZ(), angle, Vector3d(-0.2, 0.1, 0), Vector3d::Zero()));
    if (previous > 0.0) {
      EXPECT_LT(bound, 0.3 * previous);
    }
    previous = bound;
  }
  const AxisEnds bowTie{{-0.2, 0, 0}, {0.2, 0, 0}};
  const AxisEnds turned =
      moved(bowTie, Vector3d::UnitZ(), 0.02, Vector3d::Zero(), Vector3d::Zero());
  EXPECT_NEAR(hullLeavesSheetBy(bowTie, turned), 0.4 * 0.02 / 4, 1e-5);
}

}  // namespace
}  // namespace foretouch::test
