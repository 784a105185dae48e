#include "bench/scene.h"

#include <queue>
#include <utility>

#include "lss/index.h"

namespace foretouch::tools {
namespace {

/// Does not halve shorter edges (m): that would be finer than any scan.
constexpr double kShortestHalved = 1e-6;

struct LongestEdge {
  double squaredLength;
  std::size_t triangle;
  int corner;  ///< The edge goes from this corner to the next.
  /// Among equally long edges, the first triangle's comes first.
  bool operator<(const LongestEdge& other) const {
    return squaredLength != other.squaredLength ? squaredLength < other.squaredLength
                                                : triangle > other.triangle;
  }
};

LongestEdge longestEdge(const Triangle& t, std::size_t index) {
  LongestEdge longest{-1.0, index, 0};
  for (int corner = 0; corner < 3; ++corner) {
    const Eigen::Vector3d edge = t.vertices[slotOf((corner + 1) % 3)] - t.vertices[slotOf(corner)];
    if (edge.squaredNorm() > longest.squaredLength) {
      longest.squaredLength = edge.squaredNorm();
      longest.corner = corner;
    }
  }
  return longest;
}

}  // namespace

RawScene subdivided(RawScene scene, std::size_t count) {
  if (scene.triangles.size() >= count) return scene;
  std::vector<LongestEdge> edges;
  edges.reserve(count);
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
    if (isFinite(scene.triangles[i])) edges.push_back(longestEdge(scene.triangles[i], i));
  }
  scene.triangles.reserve(count);
  scene.objectOf.reserve(count);
  std::priority_queue<LongestEdge> queue(std::less<LongestEdge>(), std::move(edges));
  while (scene.triangles.size() < count && !queue.empty()) {
    const LongestEdge edge = queue.top();
    if (!(edge.squaredLength > kShortestHalved * kShortestHalved)) break;
    queue.pop();
    const Triangle whole = scene.triangles[edge.triangle];
    const auto from = slotOf(edge.corner), to = (from + 1) % 3;
    const Eigen::Vector3d middle = 0.5 * whole.vertices[from] + 0.5 * whole.vertices[to];
    Triangle half = whole;
    scene.triangles[edge.triangle].vertices[to] = middle;
    half.vertices[from] = middle;
    scene.triangles.push_back(half);
    scene.objectOf.push_back(scene.objectOf[edge.triangle]);
    queue.push(longestEdge(scene.triangles[edge.triangle], edge.triangle));
    queue.push(longestEdge(half, scene.triangles.size() - 1));
  }
  return scene;
}

}  // namespace foretouch::tools
