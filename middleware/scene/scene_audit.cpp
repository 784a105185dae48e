// auditScene(): counts and measures a scene.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "lss/extended_precision.h"
#include "lss/index.h"
#include "lss/rounding.h"
#include "middleware/scene/raw_scene.h"
#include "middleware/scene/sort_by_hash.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;

// Exact sign of a determinant. A long double of 64 bits and 15 bits of exponent holds the product
// of two half doubles exactly and never leaves its range, whatever the doubles are.
using Wide = long double;
static_assert(std::numeric_limits<Wide>::digits >= 64 &&
              std::numeric_limits<Wide>::max_exponent >= 16384);

/// A sum of any number of terms without rounding: a non-overlapping expansion, smallest first
/// ([Shewchuk97] Grow-Expansion).
class ExactSum {
 public:
  void add(Wide term) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const Wide part = parts_[i];
      const Wide sum = term + part;
      const Wide partSeen = sum - term;
      const Wide lost = (term - (sum - partSeen)) + (part - partSeen);
      if (lost != 0) parts_[kept++] = lost;
      term = sum;
    }
    if (term != 0) parts_[kept++] = term;
    size_ = kept;
  }
  [[nodiscard]] bool isZero() const { return size_ == 0; }

 private:
  std::array<Wide, 18> parts_{};  // three per product, six products
  std::size_t size_ = 0;
};

/// The double as a sum of its upper 26 and its lower 27 bits.
std::array<Wide, 2> halves(double number) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &number, sizeof bits);
  bits &= ~((std::uint64_t{1} << 27) - 1);
  double upper = 0.0;
  std::memcpy(&upper, &bits, sizeof upper);
  return {upper, number - upper};
}

void addProduct(ExactSum& sum, double x, double y, Wide sign) {
  const auto [upperX, lowerX] = halves(x);
  const auto [upperY, lowerY] = halves(y);
  sum.add(sign * upperX * upperY);
  sum.add(sign * (upperX * lowerY + lowerX * upperY));  // equally scaled: 55 bits, exact
  sum.add(sign * lowerX * lowerY);
}

/// True: three points of the plane do not lie on a line. A filter: false says nothing.
bool isOffLine(double ax, double ay, double bx, double by, double cx, double cy) {
  const double left = (ax - cx) * (by - cy);
  const double right = (ay - cy) * (bx - cx);
  // With u = 2^-53, each product is off by 3u + O(u^2) of itself (two differences, one product); 4u
  // leaves room for the roundings of this comparison and, above 1e-280, for underflow. An overflow
  // is NaN here or fails the comparison, and goes the exact way too.
  constexpr double kRounding = 4.0 * kUnitRoundoff;
  const double magnitude = std::abs(left) + std::abs(right);
  return magnitude > 1e-280 && std::abs(left - right) > kRounding * magnitude;
}

/// Do three points of the plane lie on a line? The determinant ab + bc + ca, without rounding.
bool onLine(double ax, double ay, double bx, double by, double cx, double cy) {
  const internal::ExtendedPrecision digits;
  ExactSum determinant;
  addProduct(determinant, ax, by, 1);
  addProduct(determinant, bx, ay, -1);
  addProduct(determinant, bx, cy, 1);
  addProduct(determinant, cx, by, -1);
  addProduct(determinant, cx, ay, 1);
  addProduct(determinant, ax, cy, -1);
  return determinant.isZero();
}

/// Three points in space lie on a line exactly if they do in all three coordinate planes.
bool hasNoArea(const Triangle& triangle) {
  const auto& [a, b, c] = triangle.vertices;
  const bool hasArea = isOffLine(a.x(), a.y(), b.x(), b.y(), c.x(), c.y()) ||
                       isOffLine(a.y(), a.z(), b.y(), b.z(), c.y(), c.z()) ||
                       isOffLine(a.z(), a.x(), b.z(), b.x(), c.z(), c.x());
  return !hasArea && onLine(a.x(), a.y(), b.x(), b.y(), c.x(), c.y()) &&
         onLine(a.y(), a.z(), b.y(), b.z(), c.y(), c.z()) &&
         onLine(a.z(), a.x(), b.z(), b.x(), c.z(), c.x());
}

/// The three points without their order. Adding 0 turns -0 into 0.
using PointSet = std::array<std::array<double, 3>, 3>;
PointSet pointsOf(const Triangle& triangle) {
  PointSet points;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d& v = triangle.vertices[k];
    points[k] = {v.x() + 0.0, v.y() + 0.0, v.z() + 0.0};
  }
  std::sort(points.begin(), points.end());
  return points;
}

std::uint64_t hashOfPoints(const PointSet& points) {
  std::uint64_t hash = 0;
  for (const auto& point : points) {
    for (const double coordinate : point) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &coordinate, sizeof bits);
      hash = (hash ^ bits) * 0x9E3779B97F4A7C15;
      hash ^= hash >> 29;
    }
  }
  return hash;
}

/// Duplicates among triangles with equal hashes. Equal hashes prove nothing: the points decide.
std::size_t duplicatesIn(std::vector<PointSet>& sameHash) {
  std::sort(sameHash.begin(), sameHash.end());
  std::size_t duplicates = 0;
  for (std::size_t i = 1; i < sameHash.size(); ++i) duplicates += sameHash[i] == sameHash[i - 1];
  return duplicates;
}

/// Sorts 16 bytes per triangle, and the points themselves only where hashes are equal.
std::size_t countDuplicates(const std::vector<Triangle>& triangles) {
  std::vector<internal::HashedTriangle> hashes;
  hashes.reserve(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (!isFinite(triangles[i])) continue;
    hashes.emplace_back(hashOfPoints(pointsOf(triangles[i])), static_cast<TriangleId>(i));
  }
  internal::sortByHash(hashes, std::less<>());
  std::size_t duplicates = 0;
  std::vector<PointSet> sameHash;
  for (std::size_t first = 0, last = 0; first < hashes.size(); first = last) {
    while (last < hashes.size() && hashes[last].first == hashes[first].first) ++last;
    if (last - first < 2) continue;
    sameHash.clear();
    for (std::size_t i = first; i < last; ++i) {
      sameHash.push_back(pointsOf(triangles[slotOf(hashes[i].second)]));
    }
    duplicates += duplicatesIn(sameHash);
  }
  return duplicates;
}

/// Edge lengths, triangle by triangle.
void measure(const Triangle& triangle, SceneAudit& audit) {
  // Squares of ordinary lengths say at once that an edge is neither the longest nor the shortest.
  constexpr double kLeast = 1e-100, kMost = 1e100, kRounding = 1e-12;
  const double shortest = audit.shortestEdge * (1.0 + kRounding);
  const double longest = audit.longestEdge * (1.0 - kRounding);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d& vertex = triangle.vertices[k];
    const Vector3d edge = triangle.vertices[(k + 1) % 3] - vertex;
    const double square = edge.squaredNorm();
    const bool isOrdinary = square > kLeast && square < kMost;
    if (isOrdinary && square > shortest * shortest && square < longest * longest) continue;
    // hypot: squares of tiny and of huge coordinates leave the range of doubles, lengths do not. Of
    // two: not every standard library's of three keeps that.
    const double length = std::hypot(std::hypot(edge.x(), edge.y()), edge.z());
    audit.longestEdge = std::max(audit.longestEdge, length);
    if (length > 0.0) audit.shortestEdge = std::min(audit.shortestEdge, length);
  }
}

}  // namespace

Eigen::AlignedBox3d boundsOf(const RawScene& raw) {
  Eigen::AlignedBox3d box;
  for (const Triangle& triangle : raw.triangles) {
    if (!isFinite(triangle)) continue;
    for (const Vector3d& vertex : triangle.vertices) box.extend(vertex);
  }
  return box;
}

SceneAudit auditScene(const RawScene& raw) {
  SceneAudit audit;
  audit.shortestEdge = std::numeric_limits<double>::infinity();
  for (const Triangle& triangle : raw.triangles) {
    if (!isFinite(triangle)) {
      ++audit.droppedNonFinite;
      continue;
    }
    ++audit.triangles;
    audit.zeroArea += hasNoArea(triangle);
    measure(triangle, audit);
  }
  if (audit.triangles > 0) {
    const Eigen::AlignedBox3d box = boundsOf(raw);
    audit.boxMin = box.min();
    audit.boxMax = box.max();
  }
  if (audit.longestEdge == 0.0) audit.shortestEdge = 0.0;
  audit.duplicates = countDuplicates(raw.triangles);
  return audit;
}

}  // namespace foretouch
