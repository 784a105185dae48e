#include "middleware/depth/hull_depth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include <Eigen/Geometry>

#include "lss/rounding.h"
#include "middleware/depth/pair_depth.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

constexpr int kMostLooks = 300;
/// The rounding of a support point, its difference and a height of it, relative to the extent.
constexpr double kSupportRounding = 32.0 * kUnitRoundoff;
/// Edges of a first body that are shorter than this share of the extent make a flat one.
constexpr double kFlat = 1e-12;
/// A facet gives way to a point that is at least so far above it, by a share of the extent: also
/// where they are in one plane, else facets without area would stay.
constexpr double kSamePlane = -1e-13;

/// The farthest ball of a hull, `nhat` not longer than 1.
struct Farthest {
  Vector3d point;
  double height;
};
Farthest farthest(const RoundHull& hull, const Vector3d& nhat) {
  std::size_t best = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.centres.size(); ++i) {
    const double height = nhat.dot(hull.centres[i]) + hull.radii[i];
    if (height > most) {
      most = height;
      best = i;
    }
  }
  return {hull.centres[best] + hull.radii[best] * nhat, most};
}

/// Bounds the sum of magnitudes of any point, as a unit vector has one of less than 2.
double extentOf(const RoundHull& hull) {
  double most = 0.0;
  for (std::size_t i = 0; i < hull.centres.size(); ++i) {
    most = std::max(most, hull.centres[i].lpNorm<1>() + 2.0 * hull.radii[i]);
  }
  return most;
}

/// Points of the difference other - one, and closed surfaces of triangles through them.
class Difference {
 public:
  Difference(const RoundHull& one, const RoundHull& other, double rounding)
      : one_(one), other_(other), extent_(extentOf(one) + extentOf(other)) {
    unsure_ = 2.0 * rounding + kSupportRounding * extent_;
  }

  HullDepth find() {
    const bool hasVolume = start();
    for (int look = 0; hasVolume && look < kMostLooks && depth_.upper > 0.0; ++look) {
      if (!refine()) break;
    }
    if (hasVolume && depth_.upper > 0.0) depth_.lower = std::min(insideBy(), depth_.upper);
    return depth_;
  }

 private:
  struct Facet {
    std::array<std::size_t, 3> at;  // corners, seen from outside counter-clockwise
    Vector3d nhat;
    double height;  // of its plane over the origin
  };
  using Edge = std::pair<std::size_t, std::size_t>;

  [[nodiscard]] static bool isDirection(double length) {
    return length > 0.0 && std::isfinite(length);
  }

  /// The point farthest along a unit direction, which also offers a way out.
  std::size_t look(const Vector3d& direction) {
    const Vector3d nhat = kUnitShrink * direction;
    const Farthest most = farthest(other_, nhat), least = farthest(one_, -nhat);
    // Along -direction `other` begins where `one` ends after a move by this much.
    const double need = std::max(0.0, (most.height + least.height) + unsure_) * kInflation;
    if (most.height + least.height + unsure_ < 0.0 || need < depth_.upper) {
      depth_.upper = most.height + least.height + unsure_ < 0.0 ? 0.0 : need;
      depth_.nhat = nhat;
    }
    points_.push_back(most.point - least.point);
    return points_.size() - 1;
  }

  /// Four points that are not in one plane. False: there are none, to rounding.
  bool start() {
    const double flat = kFlat * extent_;
    std::array<std::size_t, 2> ends{};
    double length = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t from = look(-Vector3d::Unit(axis)), to = look(Vector3d::Unit(axis));
      const double apart = (points_[to] - points_[from]).norm();
      if (apart <= length) continue;
      length = apart;
      ends = {from, to};
    }
    if (!(length > flat)) return false;
    const Vector3d along = (points_[ends[1]] - points_[ends[0]]) / length;
    std::size_t third = 0;
    double aside = 0.0;
    const Vector3d across = along.unitOrthogonal(), beside = along.cross(across);
    for (const Vector3d& direction :
         {Vector3d(across), Vector3d(-across), beside, Vector3d(-beside)}) {
      const std::size_t point = look(direction);
      const double apart = along.cross(points_[point] - points_[ends[0]]).norm();
      if (apart <= aside) continue;
      aside = apart;
      third = point;
    }
    if (!(aside > flat)) return false;
    const Vector3d normal = along.cross(points_[third] - points_[ends[0]]).normalized();
    std::size_t fourth = 0;
    double above = 0.0;
    for (const Vector3d& direction : {normal, Vector3d(-normal)}) {
      const std::size_t point = look(direction);
      const double apart = std::abs(normal.dot(points_[point] - points_[ends[0]]));
      if (apart <= above) continue;
      above = apart;
      fourth = point;
    }
    if (!(above > flat)) return false;
    addBody({ends[0], ends[1], third, fourth}, normal);
    return true;
  }

  void addBody(std::array<std::size_t, 4> p, const Vector3d& normal) {
    // So that the fourth is below the first three.
    if (normal.dot(points_[p[3]] - points_[p[0]]) > 0.0) std::swap(p[0], p[1]);
    add({p[0], p[1], p[2]});
    add({p[0], p[3], p[1]});
    add({p[1], p[3], p[2]});
    add({p[2], p[3], p[0]});
  }

  void add(const std::array<std::size_t, 3>& at) {
    const Vector3d& p = points_[at[0]];
    Vector3d normal = (points_[at[1]] - p).cross(points_[at[2]] - p);
    const double length = normal.norm();
    // A facet without area stays, so that the surface is closed, and says nothing good.
    normal = isDirection(length) ? Vector3d(normal / length) : Vector3d::Zero();
    facets_.push_back({at, normal, normal.dot(p)});
  }

  /// Goes on from the facet that is lowest over the origin. False: nothing is left to gain.
  bool refine() {
    const auto lowest =
        std::min_element(facets_.begin(), facets_.end(),
                         [](const Facet& x, const Facet& y) { return x.height < y.height; });
    if (lowest->nhat.isZero()) return false;
    const Vector3d nhat = lowest->nhat;
    const double height = lowest->height;
    const Vector3d p = points_[look(nhat)];
    if (nhat.dot(p) - height <= kHullDepthGap * extent_) return false;
    return cover(points_.size() - 1);
  }

  /// Facets below the point give way to those from their border to it. Whatever is taken away, what
  /// comes has the same border: the surface stays closed.
  bool cover(std::size_t point) {
    const Vector3d& p = points_[point];
    border_.clear();
    std::size_t kept = 0;
    for (const Facet& facet : facets_) {
      if (!(facet.nhat.dot(p) - facet.height > kSamePlane * extent_)) {
        facets_[kept++] = facet;
        continue;
      }
      for (std::size_t k = 0; k < 3; ++k) addToBorder({facet.at[k], facet.at[(k + 1) % 3]});
    }
    if (kept == facets_.size()) return false;
    facets_.resize(kept);
    for (const Edge& edge : border_) add({edge.first, edge.second, point});
    return true;
  }

  /// An edge and the same the other way are inside what is taken away.
  void addToBorder(const Edge& edge) {
    const auto back = std::find(border_.begin(), border_.end(), Edge{edge.second, edge.first});
    if (back == border_.end()) {
      border_.push_back(edge);
    } else {
      *back = border_.back();
      border_.pop_back();
    }
  }

  /// Not above the depth: 0 unless the origin is proven behind every facet.
  [[nodiscard]] double insideBy() const {
    double least = std::numeric_limits<double>::infinity();
    for (const Facet& facet : facets_) {
      const Vector3d& p = points_[facet.at[0]];
      const Vector3d one = points_[facet.at[1]] - p, other = points_[facet.at[2]] - p;
      const Vector3d normal = one.cross(other);
      const double size = one.lpNorm<1>() * other.lpNorm<1>();
      least = std::min(least, facetHeight(normal, size, normal.dot(p), extent_));
    }
    return std::max(0.0, least / kInflation - unsure_);
  }

  const RoundHull& one_;
  const RoundHull& other_;
  double extent_, unsure_;
  std::vector<Vector3d> points_;
  std::vector<Facet> facets_;
  std::vector<Edge> border_;
  HullDepth depth_;
};

}  // namespace

HullDepth depthOf(const RoundHull& one, const RoundHull& other, double rounding) {
  return Difference(one, other, rounding).find();
}

}  // namespace foretouch::internal
