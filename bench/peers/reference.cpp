#include "bench/peers/reference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lss/assert.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kLeafTriangles = 4;
/// Metres. Computed distances within kilometres of the origin err by less (2e-13 a coordinate).
constexpr double kRoundingAllowance = 1e-11;

double squared(const Vector3d& v) {
  return v.squaredNorm();
}

double pointToSegment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d ab = b - a;
  const double length = squared(ab);
  const double s = length > 0.0 ? std::clamp((p - a).dot(ab) / length, 0.0, 1.0) : 0.0;
  return squared(p - (a + s * ab));
}

/// Squared. The least of a convex function on a square lies inside or on an edge: all are tried.
double segmentToSegment(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                        const Vector3d& d) {
  double least = std::min(std::min(pointToSegment(a, c, d), pointToSegment(b, c, d)),
                          std::min(pointToSegment(c, a, b), pointToSegment(d, a, b)));
  const Vector3d u = b - a, v = d - c, w = a - c;
  const double uu = squared(u), uv = u.dot(v), vv = squared(v);
  const double determinant = uu * vv - uv * uv;
  if (!(determinant > 0.0)) return least;
  const double s = (uv * v.dot(w) - vv * u.dot(w)) / determinant;
  const double r = (uu * v.dot(w) - uv * u.dot(w)) / determinant;
  if (s < 0.0 || s > 1.0 || r < 0.0 || r > 1.0) return least;
  return std::min(least, squared((a + s * u) - (c + r * v)));
}

/// Whether `p`, seen along `normal`, lies over the triangle.
bool isOver(const Vector3d& p, const Triangle& triangle, const Vector3d& normal) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d& from = triangle.vertices[i];
    const Vector3d edge = triangle.vertices[(i + 1) % 3] - from;
    if (normal.dot(edge.cross(p - from)) < 0.0) return false;
  }
  return true;
}

/// Squared distance of the segment ab and a triangle.
double segmentToTriangle(const Vector3d& a, const Vector3d& b, const Triangle& triangle) {
  const auto& v = triangle.vertices;
  double least =
      std::min(std::min(segmentToSegment(a, b, v[0], v[1]), segmentToSegment(a, b, v[1], v[2])),
               segmentToSegment(a, b, v[2], v[0]));
  const Vector3d normal = (v[1] - v[0]).cross(v[2] - v[0]);
  const double area = normal.norm();
  if (!(area > 0.0)) return least;
  const double heightA = normal.dot(a - v[0]) / area, heightB = normal.dot(b - v[0]) / area;
  if (isOver(a, triangle, normal)) least = std::min(least, heightA * heightA);
  if (isOver(b, triangle, normal)) least = std::min(least, heightB * heightB);
  if ((heightA < 0.0) != (heightB < 0.0)) {
    const double s = heightA / (heightA - heightB);
    if (isOver(a + s * (b - a), triangle, normal)) return 0.0;
  }
  return least;
}

/// Squared distance of two boxes: no more than that of anything inside them.
double boxToBox(const Vector3d& low, const Vector3d& high, const Vector3d& otherLow,
                const Vector3d& otherHigh) {
  return squared((low - otherHigh).cwiseMax(otherLow - high).cwiseMax(0.0));
}

}  // namespace

ReferenceScene::ReferenceScene(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
  FORETOUCH_ASSERT(!triangles_.empty());
  nodes_.emplace_back();
  split(0, 0, triangles_.size());
}

void ReferenceScene::split(std::size_t node, std::size_t first, std::size_t count) {
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (std::size_t i = first; i < first + count; ++i) {
    for (const Vector3d& v : triangles_[i].vertices) {
      low = low.cwiseMin(v);
      high = high.cwiseMax(v);
    }
  }
  nodes_[node].low = low;
  nodes_[node].high = high;
  if (count <= kLeafTriangles) {
    nodes_[node].first = static_cast<std::int32_t>(first);
    nodes_[node].count = static_cast<std::int32_t>(count);
    return;
  }
  Eigen::Index widest = 0;
  (high - low).maxCoeff(&widest);
  const auto place = [widest](const Triangle& t) {
    return t.vertices[0][widest] + t.vertices[1][widest] + t.vertices[2][widest];
  };
  const auto begin = triangles_.begin() + static_cast<std::ptrdiff_t>(first);
  const std::size_t half = count / 2;
  std::nth_element(begin, begin + static_cast<std::ptrdiff_t>(half),
                   begin + static_cast<std::ptrdiff_t>(count),
                   [&](const Triangle& x, const Triangle& y) { return place(x) < place(y); });
  const std::size_t left = nodes_.size();
  nodes_[node].first = static_cast<std::int32_t>(left);
  nodes_.resize(left + 2);
  split(left, first, half);
  split(left + 1, first + half, count - half);
}

double ReferenceScene::distance(const Vector3d& a, const Vector3d& b, double bound) const {
  const Vector3d low = a.cwiseMin(b), high = a.cwiseMax(b);
  const auto toNode = [&](std::size_t node) {
    return boxToBox(low, high, nodes_[node].low, nodes_[node].high);
  };
  double least = bound * bound;
  std::vector<std::pair<double, std::size_t>> waiting = {{toNode(0), 0}};
  while (!waiting.empty()) {
    const auto [nearest, index] = waiting.back();
    waiting.pop_back();
    if (nearest >= least) continue;
    const Node& node = nodes_[index];
    const auto first = static_cast<std::size_t>(node.first);
    if (node.count > 0) {
      for (std::size_t i = first; i < first + static_cast<std::size_t>(node.count); ++i) {
        least = std::min(least, segmentToTriangle(a, b, triangles_[i]));
      }
      continue;
    }
    std::pair<double, std::size_t> one{toNode(first), first}, other{toNode(first + 1), first + 1};
    if (one.first < other.first) std::swap(one, other);  // the nearer one is taken up first
    waiting.push_back(one);
    waiting.push_back(other);
  }
  return std::sqrt(least);
}

FirstTouch firstTouch(const ReferenceScene& scene, const RigidSweep& sweep, double radius) {
  const double speed = fastestAxisPoint(sweep);
  double t = 0.0, bound = std::numeric_limits<double>::infinity();
  for (int step = 0; step < kReferenceSteps; ++step) {
    const AxisInWorld axis = axisAt(sweep, t);
    const double distance = scene.distance(axis.a, axis.b, bound);
    const double separation = distance - radius - kRoundingAllowance;
    if (separation <= kReferenceSeparation) return {TouchOutcome::Touch, t};
    if (separation >= speed * (1.0 - t)) return {TouchOutcome::Free, 1.0};
    t += separation / speed;
    // What was nearest cannot be farther now than this; twice the step leaves room for rounding.
    bound = distance + 2.0 * separation;
  }
  return {TouchOutcome::Uncertain, t};
}

}  // namespace foretouch::tools
