#include "assets/import/polygon.h"

#include <Eigen/Geometry>

#include "lss/assert.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// The vector area, which is right for concave polygons and a fair mean if the corners share no
/// plane. Relative to a corner, not to the origin: far from it, products would lose the digits.
Vector3d meanNormal(const std::vector<Vector3d>& corners) {
  Vector3d normal = Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    normal += (corners[i] - corners[0]).cross(corners[i + 1] - corners[0]);
  }
  return normal;
}

/// The corners along the axis that the normal is nearest to, counter-clockwise; empty if there is
/// no normal.
std::vector<Vector2d> flattened(const std::vector<Vector3d>& corners) {
  const Vector3d normal = meanNormal(corners);
  Eigen::Index drop = 0;
  std::vector<Vector2d> flat;
  if (!(normal.cwiseAbs().maxCoeff(&drop) > 0.0) || !normal.allFinite()) return flat;
  Eigen::Index u = (drop + 1) % 3, v = (drop + 2) % 3;
  if (normal[drop] < 0.0) std::swap(u, v);
  flat.reserve(corners.size());
  for (const Vector3d& corner : corners) flat.emplace_back(corner[u], corner[v]);
  return flat;
}

double turn(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// A polygon that loses corner after corner.
class Clipper {
 public:
  explicit Clipper(std::vector<Vector2d> corners) : corners_(std::move(corners)) {
    const auto count = static_cast<std::uint32_t>(corners_.size());
    for (std::uint32_t i = 0; i < count; ++i) {
      next_.push_back((i + 1) % count);
      previous_.push_back((i + count - 1) % count);
    }
  }

  void cut(std::vector<CornerTriple>& triangles) {
    std::uint32_t corner = 1;
    for (std::size_t left = corners_.size(); left >= 3; --left) {
      corner = nextEar(corner, left);
      triangles.push_back({previous_[corner], corner, next_[corner]});
      next_[previous_[corner]] = next_[corner];
      previous_[next_[corner]] = previous_[corner];
      corner = next_[corner];
    }
  }

 private:
  /// The first ear from `start` on; failing that a corner on a straight edge, failing that `start`.
  [[nodiscard]] std::uint32_t nextEar(std::uint32_t start, std::size_t left) const {
    std::uint32_t straight = start;
    bool foundStraight = false;
    std::uint32_t corner = start;
    for (std::size_t tried = 0; tried < left; ++tried, corner = next_[corner]) {
      const double bend = bendAt(corner);
      if (bend > 0.0 && isEar(corner)) return corner;
      if (bend == 0.0 && !foundStraight) {
        straight = corner;
        foundStraight = true;
      }
    }
    return straight;
  }

  [[nodiscard]] double bendAt(std::uint32_t i) const {
    return turn(corners_[previous_[i]], corners_[i], corners_[next_[i]]);
  }

  /// For a convex corner: does its triangle hold no other corner? Corners in the same place as one
  /// of the triangle's do not count: polygons with holes touch themselves along a bridge.
  [[nodiscard]] bool isEar(std::uint32_t i) const {
    const Vector2d &a = corners_[previous_[i]], &b = corners_[i], &c = corners_[next_[i]];
    for (std::uint32_t k = next_[next_[i]]; k != previous_[i]; k = next_[k]) {
      const Vector2d& p = corners_[k];
      if (p == a || p == b || p == c) continue;
      if (turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0) return false;
    }
    return true;
  }

  std::vector<Vector2d> corners_;
  std::vector<std::uint32_t> next_, previous_;
};

}  // namespace

void cutPolygon(const std::vector<Vector3d>& corners, std::vector<CornerTriple>& triangles) {
  FORETOUCH_ASSERT(corners.size() >= 3);
  std::vector<Vector2d> flat = corners.size() > 3 ? flattened(corners) : std::vector<Vector2d>();
  if (!flat.empty()) return Clipper(std::move(flat)).cut(triangles);
  const auto count = static_cast<std::uint32_t>(corners.size());
  for (std::uint32_t i = 1; i + 1 < count; ++i) triangles.push_back({0, i, i + 1});
}

}  // namespace foretouch::internal
