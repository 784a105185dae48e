#include "middleware/query/manifold.h"

#include <algorithm>
#include <tuple>

#include <Eigen/Geometry>

#include "lss/index.h"
#include "lss/rounding.h"
#include "lss/separation.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

/// No reported point is farther from its surface (m), but for rounding.
constexpr double kMostOff = 1e-9;

/// A point that is the radius away from some point of the hull: on the surface, unless it is nearer
/// to another one. The ball around an axis's end is, on the side of the axis.
bool isOnSurface(const ManifoldPart& part, const Vector3d& p) {
  if (part.radius == 0.0) return true;
  const double off = part.radius - separation(Hull::segment(p, p), part.hull).distance;
  return off <= kMostOff + 16.0 * kUnitRoundoff * p.norm();
}

/// By separation, then by place: not by number.
bool comesBefore(const ContactPoint& x, const ContactPoint& y) {
  const auto key = [](const ContactPoint& p) {
    return std::make_tuple(p.separation, p.p_WOther.x(), p.p_WOther.y(), p.p_WOther.z(),
                           p.p_WLink.x(), p.p_WLink.y(), p.p_WLink.z(), p.lss, p.linkTriangle,
                           p.triangle);
  };
  return key(x) < key(y);
}

/// Moves the point that `measure` finds largest, if that is above zero, to the details.
template <typename Measure>
bool takeLargest(const std::vector<ContactPoint>& points, const Measure& measure,
                 ContactDetails& details) {
  double largest = 0.0;
  const ContactPoint* best = nullptr;
  for (const ContactPoint& point : points) {
    const double size = measure(point.p_WOther);
    if (size > largest) {
      largest = size;
      best = &point;
    }
  }
  if (best == nullptr) return false;
  details.points[details.numPoints++] = *best;
  return true;
}

/// Up to four of the points, which come nearest first.
void choosePoints(const std::vector<ContactPoint>& points, ContactDetails& details) {
  if (points.empty()) return;
  details.points[details.numPoints++] = points.front();
  const auto at = [&](std::size_t i) -> const Vector3d& { return details.points[i].p_WOther; };
  const auto distance = [&](const Vector3d& p) { return (p - at(0)).squaredNorm(); };
  if (!takeLargest(points, distance, details)) return;
  const auto area = [&](const Vector3d& p) { return (at(1) - at(0)).cross(p - at(0)).norm(); };
  if (!takeLargest(points, area, details)) return;
  const Vector3d side = (at(1) - at(0)).cross(at(2) - at(0));
  // How far outside of the triangle: on the far side of one of its edges.
  const auto outside = [&](const Vector3d& p) {
    double most = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3d edge = at((i + 1) % 3) - at(i);
      most = std::max(most, -edge.cross(p - at(i)).dot(side));
    }
    return most;
  };
  takeLargest(points, outside, details);
}

}  // namespace

void Manifold::begin(double within, const Vector3d& nhat) {
  within_ = within;
  nhat_ = nhat;
  points_.clear();
}

void Manifold::offer(const ManifoldPart& one, const ManifoldPart& other) {
  const auto corner = [](const Hull& hull, std::size_t i) {
    return Hull::segment(hull.points[i], hull.points[i]);
  };
  keep(one, other, one.hull, other.hull);
  for (std::size_t i = 0; i < countOf(one.hull.count); ++i) {
    keep(one, other, corner(one.hull, i), other.hull);
  }
  for (std::size_t i = 0; i < countOf(other.hull.count); ++i) {
    keep(one, other, one.hull, corner(other.hull, i));
  }
}

void Manifold::keep(const ManifoldPart& one, const ManifoldPart& other, const Hull& hull,
                    const Hull& otherHull) {
  const Separation apart = separation(hull, otherHull);
  const double gap = apart.distance - (one.radius + other.radius);
  if (gap > within_) return;
  const Vector3d n = apart.distance > 0.0 ? Vector3d(apart.difference.stableNormalized()) : nhat_;
  const Vector3d p = apart.onOne - one.radius * n, q = apart.onOther + other.radius * n;
  if (!isOnSurface(one, p) || !isOnSurface(other, q)) return;
  points_.push_back({p, q, gap, other.triangle, one.lss, one.triangle});
}

void Manifold::choose(ContactDetails& details) {
  std::sort(points_.begin(), points_.end(), comesBefore);
  choosePoints(points_, details);
}

}  // namespace foretouch::internal
