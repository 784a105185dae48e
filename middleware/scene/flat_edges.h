// middleware/scene/flat_edges.h: which edges and vertices of a scene's triangles are not corners of
// its surface: edges over which it goes on flat, vertices inside a flat piece of it or on a
// straight part of its rim. How a surface is cut into triangles then need not matter. Not
// installed.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "lss/index.h"
#include "lss/lss.h"
#include "middleware/scene/frozen_array.h"
#include "middleware/scene/raw_scene.h"

namespace foretouch::internal {

/// Two triangles go on flat over an edge, and two edges straight over a vertex, if the sine of
/// their angle is at most this: above what vertices in float leave of a flat wall, far below a
/// corner that a hand could feel. Doubled, only facets of rounder surfaces lose edges, and
/// kFlatDirection (near_places.cpp) must follow.
inline constexpr double kFlatSine = 1e-3;

/// A scene's. Triangles meet where they share the two ends of an edge, bit for bit; a vertex on
/// the middle of another triangle's edge is a corner here. Two bytes per triangle.
class FlatEdges {
 public:
  FlatEdges() = default;
  /// `ids`: the triangles that count, ascending; the vertices of each are in lexicographic order.
  /// O(n log n).
  FlatEdges(const FrozenArray<Triangle>& triangles, const std::vector<TriangleId>& ids);
  /// From bitsOf(), per triangle.
  explicit FlatEdges(FrozenArray<std::uint16_t> bits) : bits_(std::move(bits)) {}

  /// Edge k, from vertex k to vertex (k + 1) mod 3: another triangle goes on flat on its far side.
  [[nodiscard]] bool isFlatEdge(TriangleId id, int k) const { return has(id, kEdges + k); }
  /// Each edge that ends there is flat.
  [[nodiscard]] bool isFlatVertex(TriangleId id, int k) const { return has(id, kFlat + k); }
  /// The edges that end there and are not flat are in line, on both sides of it.
  [[nodiscard]] bool isStraightVertex(TriangleId id, int k) const { return has(id, kStraight + k); }
  /// Bits 0 to 2: flat edges; 3 to 5: flat vertices; 6 to 8: straight ones.
  [[nodiscard]] std::uint16_t bitsOf(TriangleId id) const { return bits_[slotOf(id)]; }
  [[nodiscard]] const FrozenArray<std::uint16_t>& bits() const { return bits_; }

 private:
  static constexpr int kEdges = 0, kFlat = 3, kStraight = 6;
  using Bits = std::vector<std::uint16_t>;

  [[nodiscard]] bool has(TriangleId id, int bit) const {
    return (bits_[slotOf(id)] >> bit & 1U) != 0;
  }
  static void findEdges(const FrozenArray<Triangle>& triangles, const std::vector<TriangleId>& ids,
                        Bits& bits);
  static void findVertices(const FrozenArray<Triangle>& triangles,
                           const std::vector<TriangleId>& ids, Bits& bits);

  FrozenArray<std::uint16_t> bits_;  // per triangle
};

}  // namespace foretouch::internal
