#include "middleware/triggers/closed_mesh.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <string>
#include <tuple>
#include <utility>

#include "articulated/skeleton.h"
#include "lss/index.h"
#include "lss/separation.h"
#include "middleware/exact/ray_up.h"
#include "middleware/scene/scene_parts.h"

namespace foretouch::internal {
namespace {

using Place = std::array<double, 3>;

/// Adding 0 turns -0 into 0.
Place placeAt(const Eigen::Vector3d& v) {
  return {v.x() + 0.0, v.y() + 0.0, v.z() + 0.0};
}

/// Of one object and one triangle.
struct Edge {
  ObjectId object;
  Place from, to;  // from < to
  TriangleId triangle;
  [[nodiscard]] auto key() const { return std::tie(object, from, to); }
};

std::string said(const Place& p) {
  char text[96];
  std::snprintf(text, sizeof text, "(%g, %g, %g)", p[0], p[1], p[2]);
  return text;
}

Error openEdge(const Scene& scene, const Edge& edge, std::size_t count) {
  const std::string belongs = count == 1 ? "one triangle" : std::to_string(count) + " triangles";
  return Error::at(edge.triangle, ErrorCode::Mismatch,
                   "expected a closed mesh: of object '" +
                       scene.objectNames()[slotOf(edge.object)] + "', the edge from " +
                       said(edge.from) + " to " + said(edge.to) + " belongs to " + belongs +
                       ", where an inside needs two");
}

std::vector<Edge> edgesOf(const Scene& scene) {
  std::vector<Edge> edges;
  for (const TriangleId id : scene.parts().finiteIds()) {
    const auto& v = scene.triangle(id).vertices;
    for (std::size_t k = 0; k < 3; ++k) {
      Edge edge{scene.object(id), placeAt(v[k]), placeAt(v[(k + 1) % 3]), id};
      // An edge without length is no border.
      if (edge.from == edge.to) continue;
      if (edge.to < edge.from) std::swap(edge.from, edge.to);
      edges.push_back(edge);
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& x, const Edge& y) {
    return x.key() != y.key() ? x.key() < y.key() : x.triangle < y.triangle;
  });
  return edges;
}

}  // namespace

Result<ClosedMesh> ClosedMesh::build(Scene scene) {
  const std::vector<Edge> edges = edgesOf(scene);
  for (std::size_t first = 0; first < edges.size();) {
    std::size_t last = first;
    while (last < edges.size() && edges[last].key() == edges[first].key()) ++last;
    if ((last - first) % 2 != 0) return openEdge(scene, edges[first], last - first);
    first = last;
  }
  return ClosedMesh(std::move(scene));
}

PointPlace ClosedMesh::placeOf(const Eigen::Vector3d& p, double rounding, Memory& memory) const {
  const SceneParts& parts = scene_.parts();
  std::uint64_t visited = 0;
  Aabb near;
  near.add(p);
  near.grow(rounding);
  memory.ids.clear();
  parts.bvh.collect(near, memory.ids, visited);
  for (const TriangleId id : memory.ids) {
    const Separation apart = separation(Hull::segment(p, p), Hull::of(scene_.triangle(id)));
    if (!(apart.lower() > rounding)) return PointPlace::AtSurface;
  }
  Aabb above;
  above.add(p);
  above.max.z() = kMaxCoordinate;
  memory.ids.clear();
  memory.crossed.clear();
  parts.bvh.collect(above, memory.ids, visited);
  for (const TriangleId id : memory.ids) {
    const RayUp ray = rayUp(p, scene_.triangle(id));
    if (ray == RayUp::Touches) return PointPlace::AtSurface;
    if (ray == RayUp::Crosses) memory.crossed.push_back(scene_.object(id));
  }
  std::sort(memory.crossed.begin(), memory.crossed.end());
  for (std::size_t first = 0; first < memory.crossed.size();) {
    std::size_t last = first;
    while (last < memory.crossed.size() && memory.crossed[last] == memory.crossed[first]) ++last;
    if ((last - first) % 2 != 0) return PointPlace::Inside;
    first = last;
  }
  return PointPlace::Outside;
}

}  // namespace foretouch::internal
