#include "middleware/depth/pair_depth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "lss/clearance.h"
#include "lss/index.h"
#include "lss/rounding.h"
#include "lss/separation.h"

namespace foretouch {
namespace internal {
namespace {

using Eigen::Vector3d;

/// What a facet's height over the origin rounds by, relative to the sums of magnitudes of its two
/// edges and of the pair's extent; and the normal itself, relative to its edges. In unit roundoffs,
/// counted in depth.md 3: halving the first breaks the proof.
constexpr double kFacetRounding = 32.0 * kUnitRoundoff;
constexpr double kNormalRounding = 16.0 * kUnitRoundoff;
/// Sums of two radii, and the uncertainty that is added to them.
constexpr double kReachRounding = 4.0 * kUnitRoundoff;

/// Unit, across `along`; any if that has no length.
Vector3d acrossOf(const Vector3d& along) {
  Eigen::Index least = 0;
  along.cwiseAbs().minCoeff(&least);
  Vector3d axis = Vector3d::Zero();
  axis[least] = 1.0;
  const Vector3d across = along.cross(axis);
  const double length = across.norm();
  return length > 0.0 && std::isfinite(length) ? Vector3d(across / length) : axis;
}

}  // namespace

double facetHeight(const Vector3d& normal, double size, double height, double extent) {
  const double slack = kFacetRounding * size * extent + kUnderflow;
  return (height - slack) / ((normal.norm() + kNormalRounding * size + kUnderflow) * kInflation);
}

namespace {

/// An axis less a triangle: the polytope that the origin leaves. Its facets are the triangle's own,
/// twice, and the parallelograms of the axis and each edge, twice.
class AxisLessTriangle {
 public:
  explicit AxisLessTriangle(const ConvexPair& pair) {
    const auto &a = pair.one.points, &v = pair.other.points;
    const Vector3d d = a[1] - a[0];
    const std::array<Vector3d, 3> edges{v[1] - v[0], v[2] - v[0], v[2] - v[1]};
    extent_ = (a[0] - v[0]).lpNorm<1>() + (a[1] - v[0]).lpNorm<1>() + edges[0].lpNorm<1>() +
              edges[1].lpNorm<1>();
    for (std::size_t i = 0; i < 2; ++i) {
      for (std::size_t j = 0; j < 3; ++j) corners_[3 * i + j] = a[i] - v[j];
    }
    add(0, edges[0], edges[1]);
    for (std::size_t k = 0; k < 3; ++k) add(k + 1, d, edges[k]);
  }

  /// Not unit, and zero where the facet has no area; each stands for two facets.
  [[nodiscard]] const std::array<Vector3d, 4>& normals() const { return normals_; }

  /// Not above the least height of a facet over the origin; 0 if the origin is not proven inside.
  [[nodiscard]] double insideBy() const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t f = 0; f < normals_.size(); ++f) {
      double most = -std::numeric_limits<double>::infinity(), fewest = -most;
      for (const Vector3d& corner : corners_) {
        const double height = normals_[f].dot(corner);
        most = std::max(most, height);
        fewest = std::min(fewest, height);
      }
      least =
          std::min(least, facetHeight(normals_[f], sizes_[f], std::min(most, -fewest), extent_));
    }
    return least > 0.0 ? least / kInflation : 0.0;
  }

 private:
  void add(std::size_t facet, const Vector3d& one, const Vector3d& other) {
    normals_[facet] = one.cross(other);
    sizes_[facet] = one.lpNorm<1>() * other.lpNorm<1>();
  }

  std::array<Vector3d, 6> corners_;
  std::array<Vector3d, 4> normals_;
  std::array<double, 4> sizes_{};
  double extent_ = 0.0;
};

/// The plane of the least need among those that are offered.
class LeastNeed {
 public:
  explicit LeastNeed(const ConvexPair& pair) : pair_(pair) {}

  void offer(const Vector3d& direction) {
    const double length = direction.norm();
    if (!(length > 0.0) || !std::isfinite(length)) return;
    const PartingPlane plane = partingPlaneAlong(pair_, (kUnitShrink / length) * direction);
    if (plane.need < best_.need) best_ = plane;
  }
  void offerBoth(const Vector3d& direction) {
    offer(direction);
    offer(-direction);
  }
  [[nodiscard]] const PartingPlane& best() const { return best_; }

 private:
  const ConvexPair& pair_;
  PartingPlane best_{Vector3d::Zero(), std::numeric_limits<double>::infinity()};
};

/// Where the axes meet, the way from the one to the other has no direction.
void offerAcross(const ConvexPair& pair, LeastNeed& least) {
  const Vector3d d = pair.one.points[1] - pair.one.points[0];
  const Vector3d e = pair.other.points[1] - pair.other.points[0];
  least.offerBoth(acrossOf(d));
  least.offerBoth(acrossOf(e));
  if (pair.other.count == 2) {
    least.offerBoth(d.cross(e));
    return;
  }
  least.offerBoth(acrossOf(pair.other.points[2] - pair.other.points[1]));
  const AxisLessTriangle difference(pair);
  for (const Vector3d& normal : difference.normals()) least.offerBoth(normal);
}

PartingPlane partingPlaneOf(const ConvexPair& pair, const Separation& apart) {
  LeastNeed least(pair);
  least.offer(apart.difference);
  double extent = 0.0;
  for (std::size_t i = 0; i < 2; ++i) {
    extent += (pair.one.points[i] - pair.other.points[0]).lpNorm<1>();
    extent += (pair.other.points[i + 1] - pair.other.points[0]).lpNorm<1>();
  }
  if (!(apart.distance > kNoisyDirection * extent)) {
    least.offerBoth(apart.featureNormal);
    offerAcross(pair, least);
  }
  return least.best();
}

}  // namespace

ConvexPair pairOf(const Lss& one, const Hull& other, double radius, double rounding) {
  const double reach = one.radius + radius;
  return {Hull::segment(one.a, one.b), other,
          (1.0 - kReachRounding) * reach - (1.0 + kReachRounding) * 2.0 * rounding,
          (1.0 + kReachRounding) * (reach + 2.0 * rounding)};
}

PartingPlane partingPlaneAlong(const ConvexPair& pair, const Vector3d& nhat) {
  const double gap = gapAlong(pair.one, pair.other, nhat);
  const double need = pair.most - gap;
  return {nhat, need + kReachRounding * (std::abs(gap) + pair.most)};
}

PartingPlane partingPlaneOf(const ConvexPair& pair) {
  return partingPlaneOf(pair, separation(pair.one, pair.other));
}

Vector3d wayThrough(const PartingPlane& plane) {
  if (plane.need < 0.0) return Vector3d::Zero();
  // |nhat|^2 is above kUnitShrink^2 less four roundoffs.
  return (plane.need * kInflation + kUnderflow) * plane.nhat;
}

PairDepth depthOf(const ConvexPair& pair) {
  const Separation apart = separation(pair.one, pair.other);
  PairDepth depth;
  if (apart.lower() > pair.most) return depth;
  depth.lower = std::max(0.0, pair.least - apart.upper);
  if (pair.other.count == 3) {
    const double inside = AxisLessTriangle(pair).insideBy();
    if (inside > 0.0) depth.lower = std::max(depth.lower, (pair.least + inside) / kInflation);
  }
  depth.wayOut = wayThrough(partingPlaneOf(pair, apart));
  depth.upper = depth.wayOut.norm() * kInflation;
  return depth;
}

}  // namespace internal

PairDepth depthOf(const Lss& one, const Lss& other, double rounding) {
  return internal::depthOf(
      internal::pairOf(one, Hull::segment(other.a, other.b), other.radius, rounding));
}

PairDepth depthOf(const Lss& one, const Triangle& other, double rounding) {
  return internal::depthOf(internal::pairOf(one, Hull::of(other), 0.0, rounding));
}

}  // namespace foretouch
