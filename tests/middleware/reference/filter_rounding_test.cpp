// The filter's and the curves' rounding bounds, held against fifty digits.
#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>

#include "judge/plain_motion.h"
#include "tests/middleware/reference/leaf_samples.h"
#include "tests/reference/filter_corners.h"
#include "tests/reference/rigid_curves.h"

namespace foretouch::test {
namespace {

using oracle::Precise3;
using oracle::PreciseQuaternion;
using Real = oracle::Precise;
using internal::Corners;

Precise3 cornerAt(const internal::MovingPolygon& polygon, int i, bool end) {
  const LinearPoint &p = *polygon.plus[i], &q = *polygon.minus[i];
  return Precise3(end ? p.to : p.from) - Precise3(end ? q.to : q.from);
}

Real det(const Precise3& a, const Precise3& b, const Precise3& c) {
  return dot(cross(a, b), c);
}

std::array<Real, 4> preciseVolume(const internal::MovingPolygon& polygon) {
  const auto c = [&](int i, bool end) { return cornerAt(polygon, i, end); };
  const auto d = [&](bool x, bool y, bool z) { return det(c(0, x), c(1, y), c(2, z)); };
  return {3 * d(false, false, false),
          d(true, false, false) + d(false, true, false) + d(false, false, true),
          d(true, true, false) + d(true, false, true) + d(false, true, true),
          3 * d(true, true, true)};
}

FourPoints awkward(Random& random) {
  FourPoints points = random.chance(0.5) ? anywhere(random) : nearLattice(random);
  const Eigen::Vector3d far = random.magnitude(1e-3, 1e6) * random.direction();
  const Eigen::Vector3d stretch(random.magnitude(1e-6, 1e6), 1.0, random.magnitude(1e-6, 1e6));
  for (LinearPoint& p : points) {
    p.from = stretch.cwiseProduct(p.from) + far;
    p.to = stretch.cwiseProduct(p.to) + far;
  }
  return points;
}

double share(const Real& computed, const Real& truth, double bound) {
  const Real error = abs(computed - truth);
  return bound > 0.0 ? static_cast<double>(Real(error / bound)) : (error > 0 ? 1e300 : 0.0);
}

TEST(FilterCorners, RoundingStaysBelowItsBounds) {
  double volumes = 0.0, sides = 0.0;
  for (int seed = 0; seed < 3000; ++seed) {
    Random random(seed);
    const FourPoints p = awkward(random);
    const std::array<LinearPoint, 2> one = {p[0], p[1]}, other = {p[2], p[3]};
    const auto polygon = internal::polygonOf(one, other);
    const Corners corners = internal::cornersOf(polygon);
    const internal::Cubic volume = internal::volumeOf(corners);
    const auto truth = preciseVolume(polygon);
    for (int k = 0; k < 4; ++k) {
      volumes = std::max(
          volumes, share(volume[k], truth[k], internal::kVolumeRounding * corners.largestVolume()));
    }
    const double t = random.uniform(0.0, 1.0);
    for (int j = 0; j < 4; ++j) {
      const auto at = [&](int i) {
        return Real(1 - Real(t)) * cornerAt(polygon, i, false) +
               Real(t) * cornerAt(polygon, i, true);
      };
      const Precise3 side = cross(at(j), at(corners.next(j)));
      for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        sides = std::max(sides, share(valueAt(internal::sideOf(corners, j, u, v), t), side[axis],
                                      internal::kSideRounding * corners.largestSide(u, v)));
      }
    }
  }
  RecordProperty("worstVolumeShare", std::to_string(volumes));
  RecordProperty("worstSideShare", std::to_string(sides));
  std::printf("share of the bound used: volumes %.3f, sides %.3f\n", volumes, sides);
  EXPECT_LE(volumes, 0.5);
  EXPECT_LE(sides, 0.5);
  EXPECT_GT(volumes, 0.005);  // the truth is not the computed value again
}

/// Signs alone decide; a halved or restricted cubic stays within its bound too.
TEST(Cubic, HalvesAndPartsStayWithinTheirRounding) {
  double worst = 0.0;
  for (int seed = 0; seed < 3000; ++seed) {
    Random random(seed);
    internal::Cubic c;
    for (double& x : c) x = random.uniform(-1.0, 1.0);
    const double from = random.uniform(0.0, 1.0), to = random.uniform(from, 1.0);
    const internal::Cubic part = internal::restrictTo(c, from, to);
    const auto blossom = [&](const Real& x, const Real& y, const Real& z) {
      const auto mix = [](const Real& a, const Real& b, const Real& t) {
        return Real((1 - t) * a + t * b);
      };
      std::array<Real, 3> one;
      for (int i = 0; i < 3; ++i) one[i] = mix(c[i], c[i + 1], x);
      return mix(mix(one[0], one[1], y), mix(one[1], one[2], y), z);
    };
    const Real a(from), b(to);
    const std::array<Real, 4> truth = {blossom(a, a, a), blossom(a, a, b), blossom(a, b, b),
                                       blossom(b, b, b)};
    for (int k = 0; k < 4; ++k)
      worst = std::max(worst, share(part[k], truth[k], 16.0 * kUnitRoundoff));
    const auto [left, right] = internal::halve(c);
    const Real half(0.5), zero(0), unit(1);
    worst = std::max(worst, share(left[2], blossom(zero, half, half), 3.0 * kUnitRoundoff));
    worst = std::max(worst, share(right[0], blossom(half, half, half), 3.0 * kUnitRoundoff));
    worst = std::max(worst, share(right[1], blossom(half, half, unit), 3.0 * kUnitRoundoff));
    worst =
        std::max(worst, share(internal::valueAt(c, from), blossom(a, a, a), 16.0 * kUnitRoundoff));
  }
  EXPECT_LE(worst, 1.0);
  EXPECT_GT(worst, 0.01);
}

TEST(RigidCurves, RoundingStaysBelowItsBound) {
  double worst = 0.0, worstPosition = 0.0;
  for (int seed = 0; seed < 3000; ++seed) {
    Random random(seed);
    NlerpMotion motion{random.inBox(3.0), random.inBox(3.0), random.rotation(), random.rotation()};
    motion.q0.coeffs() *= random.uniform(0.5, 2.0);
    motion.q1.coeffs() *= random.uniform(0.5, 2.0);
    if (motion.q0.coeffs().dot(motion.q1.coeffs()) < 0.0) motion.q1.coeffs() *= -1.0;
    Triangle triangle;
    for (auto& v : triangle.vertices) v = random.magnitude(1e-3, 1e2) * random.direction();
    const Eigen::Vector3d origin = random.inBox(2.0), n = (1.0 - 1e-15) * random.direction();
    const internal::RigidCurves curves(motion, triangle, origin);
    const double t = random.uniform(0.0, 1.0);
    const Real T(t);
    const auto mix = [&](double a, double b) { return Real((1 - T) * a + T * b); };
    PreciseQuaternion q{mix(motion.q0.w(), motion.q1.w()), mix(motion.q0.x(), motion.q1.x()),
                        mix(motion.q0.y(), motion.q1.y()), mix(motion.q0.z(), motion.q1.z())};
    const Real weight = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z, norm = sqrt(weight);
    q = {q.w / norm, q.x / norm, q.y / norm, q.z / norm};
    for (int i = 0; i < 3; ++i) {
      const Precise3 x(mix(motion.x0.x(), motion.x1.x()), mix(motion.x0.y(), motion.x1.y()),
                       mix(motion.x0.z(), motion.x1.z()));
      const Precise3 truth = x + rotate(q, Precise3(triangle.vertices[i])) - Precise3(origin);
      const Real along = weight * dot(Precise3(n), truth);
      const double value = internal::valueAt(curves.along(n, i), t);
      worst = std::max(worst, share(value, along, internal::kRigidRounding * curves.scale()));
      const Precise3 computed(curves.at(t).vertices[i]);
      worstPosition = std::max(worstPosition, share(norm * 0 + oracle::norm(computed - truth), 0,
                                                    curves.positionError(t)));
    }
  }
  std::printf("share of the bound used: along %.3f, positions %.3f\n", worst, worstPosition);
  EXPECT_LE(worst, 0.25);
  EXPECT_LE(worstPosition, 0.25);
  EXPECT_GT(worst, 0.001);
}

}  // namespace
}  // namespace foretouch::test
