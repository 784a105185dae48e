#include "tessellation/open_edges.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "lss/index.h"

namespace foretouch::internal {
namespace {

using Place = std::array<double, 3>;

/// Adding 0 turns -0 into 0.
Place placeAt(const Eigen::Vector3d& v) {
  return {v.x() + 0.0, v.y() + 0.0, v.z() + 0.0};
}

auto keyOf(const OpenEdge& edge) {
  return std::tie(edge.object, edge.from, edge.to);
}

std::vector<OpenEdge> edgesOf(const Triangle* triangles, const std::vector<std::int32_t>& ids,
                              const std::int32_t* objectOf) {
  std::vector<OpenEdge> edges;
  for (const std::int32_t id : ids) {
    const auto& v = triangles[slotOf(id)].vertices;
    const std::int32_t object = objectOf == nullptr ? 0 : objectOf[slotOf(id)];
    for (std::size_t k = 0; k < 3; ++k) {
      OpenEdge edge{object, placeAt(v[k]), placeAt(v[(k + 1) % 3]), id, 0};
      if (edge.from == edge.to) continue;
      if (edge.to < edge.from) std::swap(edge.from, edge.to);
      edges.push_back(edge);
    }
  }
  std::sort(edges.begin(), edges.end(), [](const OpenEdge& x, const OpenEdge& y) {
    return keyOf(x) != keyOf(y) ? keyOf(x) < keyOf(y) : x.triangle < y.triangle;
  });
  return edges;
}

}  // namespace

std::vector<OpenEdge> openEdges(const Triangle* triangles, const std::vector<std::int32_t>& ids,
                                const std::int32_t* objectOf) {
  const std::vector<OpenEdge> edges = edgesOf(triangles, ids, objectOf);
  std::vector<OpenEdge> open;
  for (std::size_t first = 0; first < edges.size();) {
    std::size_t last = first;
    while (last < edges.size() && keyOf(edges[last]) == keyOf(edges[first])) ++last;
    const bool isFirst = open.empty() || open.back().object != edges[first].object;
    if ((last - first) % 2 != 0 && isFirst) {
      open.push_back(edges[first]);
      open.back().count = last - first;
    }
    first = last;
  }
  return open;
}

std::vector<ObjectRoom> objectRooms(const Triangle* triangles, const std::vector<std::int32_t>& ids,
                                    const std::int32_t* objectOf, std::size_t count) {
  std::vector<ObjectRoom> rooms(count);
  for (const std::int32_t id : ids) {
    Aabb& box = rooms[objectOf == nullptr ? 0 : slotOf(objectOf[slotOf(id)])].box;
    for (const Eigen::Vector3d& v : triangles[slotOf(id)].vertices) box.add(v);
  }
  for (const OpenEdge& edge : openEdges(triangles, ids, objectOf)) {
    rooms[slotOf(edge.object)].isClosed = false;
  }
  return rooms;
}

}  // namespace foretouch::internal
