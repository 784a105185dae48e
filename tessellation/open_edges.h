// tessellation/open_edges.h: where a surface of triangles has a border, so that it has no inside.
// Exact. Not installed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lss/lss.h"
#include "tessellation/aabb.h"

namespace foretouch::internal {

/// An edge that belongs to an odd number of an object's triangles.
struct OpenEdge {
  std::int32_t object;
  std::array<double, 3> from, to;
  std::int32_t triangle;  ///< One of them.
  std::size_t count;
};

/// The first open edge of each object that is not closed, by object. `ids`: the triangles that
/// count; `objectOf` may be null: all are of object 0. Their winding does not matter. Edges are the
/// same if their ends are, bit for bit; an edge without length is not a border. O(n log n).
[[nodiscard]] std::vector<OpenEdge> openEdges(const Triangle* triangles,
                                              const std::vector<std::int32_t>& ids,
                                              const std::int32_t* objectOf);

/// What an object may have inside it.
struct ObjectRoom {
  Aabb box;  ///< Around its triangles; empty without any.
  bool isClosed = true;
};
/// The rooms of the same input, one per object, `count` of them.
[[nodiscard]] std::vector<ObjectRoom> objectRooms(const Triangle* triangles,
                                                  const std::vector<std::int32_t>& ids,
                                                  const std::int32_t* objectOf, std::size_t count);

}  // namespace foretouch::internal
