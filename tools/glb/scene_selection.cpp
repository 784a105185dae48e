#include "tools/glb/scene_selection.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "lss/assert.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

double squareToNearest(const Triangle& triangle, const std::vector<Vector3d>& places) {
  const auto& v = triangle.vertices;
  const Vector3d low = v[0].cwiseMin(v[1]).cwiseMin(v[2]);
  const Vector3d high = v[0].cwiseMax(v[1]).cwiseMax(v[2]);
  double least = std::numeric_limits<double>::infinity();
  for (const Vector3d& place : places) {
    least = std::min(least, (place.cwiseMax(low).cwiseMin(high) - place).squaredNorm());
  }
  return least;
}

}  // namespace

std::vector<TriangleId> nearestTriangles(const Scene& scene, const std::vector<Vector3d>& places,
                                         std::vector<TriangleId> always, std::size_t most) {
  FORETOUCH_ASSERT(!places.empty());
  std::sort(always.begin(), always.end());
  const bool areAllFew = scene.numTriangles() <= most;
  std::vector<std::pair<double, TriangleId>> keyed;
  for (TriangleId id = 0; id < static_cast<TriangleId>(scene.numTriangles()); ++id) {
    const Triangle& triangle = scene.triangle(id);
    if (!isFinite(triangle)) continue;
    constexpr double kFirst = -1.0;
    double key = kFirst;
    if (!areAllFew && !std::binary_search(always.begin(), always.end(), id)) {
      key = squareToNearest(triangle, places);
    }
    keyed.emplace_back(key, id);
  }
  if (keyed.size() > most) {
    std::nth_element(keyed.begin(), keyed.begin() + static_cast<std::ptrdiff_t>(most), keyed.end());
    keyed.resize(most);
  }
  std::vector<TriangleId> ids;
  ids.reserve(keyed.size());
  for (const auto& [key, id] : keyed) ids.push_back(id);
  std::sort(ids.begin(), ids.end());
  return ids;
}

}  // namespace foretouch::tools
