#include "lss/lss_cover.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include <Eigen/Eigenvalues>

#include "lss/assert.h"
#include "lss/fit.h"
#include "lss/hull_volume.h"
#include "lss/vertex_order.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;

/// A choice: a split that saves less makes a query's work grow more than its answers improve.
constexpr double kWorthwhileSaving = 0.15;

/// Where to cut a part, in order of its triangles' middles along an axis.
constexpr double kCuts[] = {0.25, 0.5, 0.75};

/// Triangles as indices into their distinct vertices: each vertex of a mesh occurs about six times.
struct Indexed {
  std::vector<Vector3d> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

Indexed indexed(const std::vector<Triangle>& triangles) {
  Indexed mesh;
  for (const Triangle& triangle : triangles) {
    FORETOUCH_ASSERT(isFinite(triangle));
    mesh.points.insert(mesh.points.end(), triangle.vertices.begin(), triangle.vertices.end());
  }
  std::sort(mesh.points.begin(), mesh.points.end(), isBeforeByCoordinates<Vector3d>);
  mesh.points.erase(std::unique(mesh.points.begin(), mesh.points.end()), mesh.points.end());
  for (const Triangle& triangle : triangles) {
    auto& corners = mesh.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto found = std::lower_bound(mesh.points.begin(), mesh.points.end(),
                                          triangle.vertices[k], isBeforeByCoordinates<Vector3d>);
      corners[k] = static_cast<std::uint32_t>(found - mesh.points.begin());
    }
  }
  return mesh;
}

/// Triangles that one LSS contains.
struct Part {
  std::vector<std::uint32_t> triangles;
  Lss lss;
};

struct Split {
  std::pair<Part, Part> parts;
  double saving = 0.0;  ///< Cubic metres.
};

class Coverer {
 public:
  explicit Coverer(const Indexed& mesh) : mesh_(mesh), lastUse_(mesh.points.size(), 0) {}

  Part fitted(std::vector<std::uint32_t> triangles);
  /// The best of a few ways to cut it in two; nothing if none is worthwhile.
  std::optional<Split> bestSplit(const Part& part);

 private:
  std::vector<Vector3d> pointsOf(const std::vector<std::uint32_t>& triangles);
  [[nodiscard]] Vector3d middleOf(std::uint32_t triangle) const {
    const auto& [a, b, c] = mesh_.triangles[triangle];
    return (mesh_.points[a] + mesh_.points[b] + mesh_.points[c]) / 3.0;
  }
  [[nodiscard]] Eigen::Matrix3d principalAxes(const std::vector<std::uint32_t>& triangles) const;
  [[nodiscard]] std::vector<std::uint32_t> sortedAlong(const Vector3d& axis,
                                                       std::vector<std::uint32_t> triangles) const;

  const Indexed& mesh_;
  std::vector<std::uint32_t> lastUse_;  ///< Per point, the number of the last part that got it.
  std::uint32_t use_ = 0;
};

std::vector<Vector3d> Coverer::pointsOf(const std::vector<std::uint32_t>& triangles) {
  ++use_;
  std::vector<Vector3d> points;
  for (const std::uint32_t triangle : triangles) {
    for (const std::uint32_t point : mesh_.triangles[triangle]) {
      if (std::exchange(lastUse_[point], use_) != use_) points.push_back(mesh_.points[point]);
    }
  }
  return points;
}

/// Fitted to the extreme points, which nearly fixes the axis, then widened to every point.
Part Coverer::fitted(std::vector<std::uint32_t> triangles) {
  const std::vector<Vector3d> points = pointsOf(triangles);
  Part part{std::move(triangles), fitLss(extremePoints(points))};
  for (const Vector3d& p : points) growToContain(part.lss, p);
  return part;
}

Eigen::Matrix3d Coverer::principalAxes(const std::vector<std::uint32_t>& triangles) const {
  Vector3d mean = Vector3d::Zero();
  for (const std::uint32_t t : triangles) {
    mean += middleOf(t) / static_cast<double>(triangles.size());
  }
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const std::uint32_t t : triangles) {
    const Vector3d w = middleOf(t) - mean;
    covariance += w * w.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  return solver.info() == Eigen::Success ? solver.eigenvectors() : Eigen::Matrix3d::Identity();
}

std::vector<std::uint32_t> Coverer::sortedAlong(const Vector3d& axis,
                                                std::vector<std::uint32_t> triangles) const {
  std::vector<std::pair<double, std::uint32_t>> keyed;
  for (const std::uint32_t t : triangles) keyed.emplace_back(axis.dot(middleOf(t)), t);
  std::sort(keyed.begin(), keyed.end());
  for (std::size_t i = 0; i < keyed.size(); ++i) triangles[i] = keyed[i].second;
  return triangles;
}

std::optional<Split> Coverer::bestSplit(const Part& part) {
  const std::size_t n = part.triangles.size();
  if (n < 2) return std::nullopt;
  const double whole = volume(part.lss);
  const Eigen::Matrix3d axes = principalAxes(part.triangles);
  std::optional<Split> best;
  for (int axis = 0; axis < 3; ++axis) {
    const auto order = sortedAlong(axes.col(axis), part.triangles);
    for (const double cut : kCuts) {
      const auto first =
          std::clamp<std::size_t>(static_cast<std::size_t>(cut * static_cast<double>(n)), 1, n - 1);
      const auto middle = order.begin() + static_cast<std::ptrdiff_t>(first);
      Part low = fitted({order.begin(), middle}), high = fitted({middle, order.end()});
      const double saving = whole - volume(low.lss) - volume(high.lss);
      if (saving > kWorthwhileSaving * whole && (!best || saving > best->saving)) {
        best = Split{{std::move(low), std::move(high)}, saving};
      }
    }
  }
  return best;
}

/// The LSS that the triangle lies deepest in, and how far it sticks out of it.
std::pair<std::size_t, double> deepestIn(const std::vector<Lss>& lss, const Triangle& triangle) {
  std::pair<std::size_t, double> deepest{0, std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < lss.size(); ++i) {
    const double out = sticksOut(lss[i], triangle);
    if (out < deepest.second) deepest = {i, out};
  }
  return deepest;
}

}  // namespace

std::vector<Lss> coverTriangles(const std::vector<Triangle>& triangles, int maxLss) {
  FORETOUCH_ASSERT(maxLss >= 1);
  if (triangles.empty()) return {};
  const Indexed mesh = indexed(triangles);
  Coverer coverer(mesh);
  std::vector<std::uint32_t> all(triangles.size());
  std::iota(all.begin(), all.end(), 0u);
  std::vector<Part> parts = {coverer.fitted(std::move(all))};
  std::vector<std::optional<Split>> splits(1);
  if (maxLss > 1) splits[0] = coverer.bestSplit(parts[0]);
  while (static_cast<int>(parts.size()) < maxLss) {
    const auto best = std::max_element(
        splits.begin(), splits.end(),
        [](const auto& a, const auto& b) { return (a ? a->saving : 0.0) < (b ? b->saving : 0.0); });
    if (!*best) break;
    auto [low, high] = std::move((*best)->parts);
    const auto at = static_cast<std::size_t>(best - splits.begin());
    const bool isLast = static_cast<int>(parts.size()) + 1 == maxLss;
    splits[at] = isLast ? std::nullopt : coverer.bestSplit(low);
    splits.push_back(isLast ? std::nullopt : coverer.bestSplit(high));
    parts[at] = std::move(low);
    parts.push_back(std::move(high));
  }
  std::vector<Lss> lss;
  for (const Part& part : parts) lss.push_back(part.lss);
  return lss;
}

CoverMeasure measureCover(const std::vector<Lss>& lss, const std::vector<Triangle>& triangles) {
  CoverMeasure measure;
  std::vector<std::vector<Vector3d>> points(lss.size());
  for (const Triangle& triangle : triangles) {
    const auto [owner, out] = deepestIn(lss, triangle);
    if (out > 0.0) ++measure.outside;
    measure.worstOutside = std::max(measure.worstOutside, out);
    if (lss.empty()) continue;
    points[owner].insert(points[owner].end(), triangle.vertices.begin(), triangle.vertices.end());
  }
  for (std::size_t i = 0; i < lss.size(); ++i) {
    if (points[i].empty()) continue;
    measure.lssVolume += volume(lss[i]);
    measure.hullVolume += hullVolume(points[i]);
  }
  return measure;
}

}  // namespace foretouch
