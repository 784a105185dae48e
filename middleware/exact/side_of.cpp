#include "middleware/exact/side_of.h"

#include <cmath>

#include "lss/rounding.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

/// Each of the determinant's six products of three components passes eight roundings: three
/// subtractions, two products, three sums. So does the sum of their magnitudes, to which this is
/// relative; twice eight covers both. Halving it breaks the proof. With two products of two
/// components, there are fewer.
constexpr double kSideOfRounding = 16.0 * kUnitRoundoff;
/// Absorbs underflow: six products below 2^-1074, each times a length of up to 2e100.
constexpr double kSideOfUnderflow = 1e-200;

int exactSideOf(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  const auto points = exactly<4>({&a, &b, &c, &d});
  std::array<Exact, 3> from;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      from[i][axis] = points[i + 1][axis] - points[0][axis];
    }
  }
  const auto& [u, v, w] = from;
  return signOf(u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) +
                u[2] * (v[0] * w[1] - v[1] * w[0]));
}

int exactTurnOf(const Vector3d& a, const Vector3d& b, const Vector3d& p) {
  const auto [x, y, z] = exactly<3>({&a, &b, &p});
  return signOf((y[0] - x[0]) * (z[1] - x[1]) - (y[1] - x[1]) * (z[0] - x[0]));
}

}  // namespace

int sideOf(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  const Vector3d u = b - a, v = c - a, w = d - a;
  const double determinant = u.x() * (v.y() * w.z() - v.z() * w.y()) +
                             u.y() * (v.z() * w.x() - v.x() * w.z()) +
                             u.z() * (v.x() * w.y() - v.y() * w.x());
  const Vector3d p = u.cwiseAbs(), q = v.cwiseAbs(), r = w.cwiseAbs();
  const double magnitude = p.x() * (q.y() * r.z() + q.z() * r.y()) +
                           p.y() * (q.z() * r.x() + q.x() * r.z()) +
                           p.z() * (q.x() * r.y() + q.y() * r.x());
  const double bound = kSideOfRounding * magnitude + kSideOfUnderflow;
  if (determinant > bound) return 1;
  return determinant < -bound ? -1 : exactSideOf(a, b, c, d);
}

int turnOf(const Vector3d& a, const Vector3d& b, const Vector3d& p) {
  const double left = (b.x() - a.x()) * (p.y() - a.y());
  const double right = (b.y() - a.y()) * (p.x() - a.x());
  const double bound = kSideOfRounding * (std::abs(left) + std::abs(right)) + kSideOfUnderflow;
  if (left - right > bound) return 1;
  return left - right < -bound ? -1 : exactTurnOf(a, b, p);
}

}  // namespace foretouch::internal
