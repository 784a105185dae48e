#include "middleware/exact/closed_mesh.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <string>
#include <utility>

#include "articulated/skeleton.h"
#include "lss/index.h"
#include "middleware/exact/within_distance.h"
#include "middleware/scene/scene_parts.h"
#include "tessellation/open_edges.h"

namespace foretouch::internal {
namespace {

std::string said(const std::array<double, 3>& p) {
  char text[96];
  std::snprintf(text, sizeof text, "(%g, %g, %g)", p[0], p[1], p[2]);
  return text;
}

Error openEdge(const Scene& scene, const OpenEdge& edge) {
  const std::string belongs =
      edge.count == 1 ? "one triangle" : std::to_string(edge.count) + " triangles";
  return Error::at(edge.triangle, ErrorCode::Mismatch,
                   "expected a closed mesh: of object '" +
                       scene.objectNames()[slotOf(edge.object)] + "', the edge from " +
                       said(edge.from) + " to " + said(edge.to) + " belongs to " + belongs +
                       ", where an inside needs two");
}

void cross(const Eigen::Vector3d& p, const Triangle& triangle, ObjectId object,
           ObjectsAround& around) {
  const RayUp ray = rayUp(p, triangle);
  if (ray == RayUp::Touches) around.atSurface.push_back(object);
  if (ray == RayUp::Crosses) around.inside.push_back(object);
}

/// Keeps of what was crossed what was so an odd number of times.
void keepOdd(std::vector<ObjectId>& crossed) {
  std::sort(crossed.begin(), crossed.end());
  std::size_t kept = 0;
  for (std::size_t first = 0; first < crossed.size();) {
    std::size_t last = first;
    while (last < crossed.size() && crossed[last] == crossed[first]) ++last;
    const ObjectId object = crossed[first];
    if ((last - first) % 2 != 0) crossed[kept++] = object;
    first = last;
  }
  crossed.resize(kept);
}

void keepOne(std::vector<ObjectId>& objects) {
  std::sort(objects.begin(), objects.end());
  objects.erase(std::unique(objects.begin(), objects.end()), objects.end());
}

void findAtSurface(const SceneParts& scene, const Eigen::Vector3d& p, double rounding,
                   ObjectsAround& around) {
  std::uint64_t visited = 0;
  Aabb near;
  near.add(p);
  near.grow(rounding);
  around.ids.clear();
  around.atSurface.clear();
  scene.bvh.collect(near, around.ids, visited);
  for (const TriangleId id : around.ids) {
    if (isWithin(p, scene.triangles[slotOf(id)], rounding)) {
      around.atSurface.push_back(scene.objectOf[slotOf(id)]);
    }
  }
}

void findInside(const SceneParts& scene, const Eigen::Vector3d& p, ObjectsAround& around) {
  std::uint64_t visited = 0;
  Aabb above;
  above.add(p);
  above.max.z() = kMaxCoordinate;
  around.ids.clear();
  around.inside.clear();
  scene.bvh.collect(above, around.ids, visited);
  for (const TriangleId id : around.ids) {
    cross(p, scene.triangles[slotOf(id)], scene.objectOf[slotOf(id)], around);
  }
  keepOdd(around.inside);
}

}  // namespace

void findObjectsAround(const SceneParts& scene, const Eigen::Vector3d& p, double rounding,
                       ObjectsAround& around) {
  findAtSurface(scene, p, rounding, around);
  findInside(scene, p, around);
  keepOne(around.atSurface);
}

void findObjectsAround(const std::vector<Triangle>& triangles, const Eigen::Vector3d& p,
                       double rounding, ObjectsAround& around) {
  around.inside.clear();
  around.atSurface.clear();
  for (const Triangle& triangle : triangles) {
    if (isWithin(p, triangle, rounding)) around.atSurface.push_back(0);
    cross(p, triangle, 0, around);
  }
  keepOdd(around.inside);
  keepOne(around.atSurface);
}

Result<ClosedMesh> ClosedMesh::build(Scene scene) {
  const SceneParts& parts = scene.parts();
  const auto open = openEdges(parts.triangles.data(), parts.finiteIds(), parts.objectOf.data());
  if (!open.empty()) return openEdge(scene, open.front());
  return ClosedMesh(std::move(scene));
}

PointPlace ClosedMesh::placeOf(const Eigen::Vector3d& p, double rounding, Memory& memory) const {
  findAtSurface(scene_.parts(), p, rounding, memory);
  if (!memory.atSurface.empty()) return PointPlace::AtSurface;
  findInside(scene_.parts(), p, memory);
  if (!memory.atSurface.empty()) return PointPlace::AtSurface;
  return memory.inside.empty() ? PointPlace::Outside : PointPlace::Inside;
}

}  // namespace foretouch::internal
