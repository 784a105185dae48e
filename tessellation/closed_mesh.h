// tessellation/closed_mesh.h: turns triangles that bound a volume into closed 2-manifolds. Not
// installed.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace foretouch {

/// A corner of the input: any number that identifies its place.
using MeshKey = std::uint64_t;

struct ClosedMesh {
  /// A vertex: at the place of `a`, or half way between `a` and `b` if they differ.
  struct Vertex {
    MeshKey a = 0, b = 0;
  };
  std::vector<Vertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< Winding as in the input.
};

/// The same triangles with every edge shared by exactly two of them, in opposite directions, and
/// the triangles around every vertex in one ring. If more meet at an edge or a vertex, it splits
/// into several at the same place; if that leaves two edges between the same two vertices, one of
/// them gets a vertex half way. Preconditions: triangles pass every edge as often one way as the
/// other; no triangle has a corner twice; fewer than 2^30 triangles. Time O(n log n).
[[nodiscard]] ClosedMesh closedMesh(const std::vector<std::array<MeshKey, 3>>& triangles);

}  // namespace foretouch
