#include "middleware/scene/flat_edges.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

/// More triangles at one edge than this are not a flat surface: they count as its corners.
constexpr std::size_t kMostAtEdge = 16;

/// Adding 0 turns -0 into 0.
std::uint64_t hashOfPoint(const Vector3d& point, std::uint64_t hash) {
  for (int axis = 0; axis < 3; ++axis) {
    const double coordinate = point[axis] + 0.0;
    std::uint64_t bits = 0;
    std::memcpy(&bits, &coordinate, sizeof bits);
    hash = (hash ^ bits) * 0x9E3779B97F4A7C15;
    hash ^= hash >> 29;
  }
  return hash;
}

/// Edge k of a triangle.
struct EdgeOf {
  std::uint64_t hash;  // of its ends
  TriangleId id;
  std::int32_t k;
};

const Vector3d& vertexOf(const Triangle& triangle, int k) {
  return triangle.vertices[slotOf(k % 3)];
}

/// Whether they have the same two ends, and the triangles lie flat on both sides of them.
bool goOnFlat(const Triangle& one, int k, const Triangle& other, int l) {
  // Vertices are sorted, so edge 2 alone runs backwards.
  const Vector3d &p = vertexOf(one, k), &q = vertexOf(one, k + 1);
  const Vector3d &from = vertexOf(other, l), &to = vertexOf(other, l + 1);
  if (!((p == from && q == to) || (p == to && q == from))) return false;
  const Vector3d edge = q - p;
  const Vector3d n = edge.cross(vertexOf(one, k + 2) - p);
  const Vector3d m = edge.cross(vertexOf(other, l + 2) - p);
  const double cosine = n.dot(m), sine = n.cross(m).norm();
  return cosine < 0.0 && sine <= kFlatSine * -cosine;
}

/// One end of an edge that is not flat.
struct CornerEnd {
  std::uint64_t hash;  // of the vertex
  TriangleId id;
  std::int8_t at, towards;  // vertices of the triangle
};

/// A vertex at which edges that are not flat end.
struct Corner {
  std::uint64_t hash;
  bool isStraight;
};

/// Whether all of them leave the vertex along one line, on both sides.
bool areInLine(const CornerEnd* first, const CornerEnd* last,
               const FrozenArray<Triangle>& triangles) {
  const auto directionOf = [&](const CornerEnd& end) -> Vector3d {
    const Triangle& triangle = triangles[slotOf(end.id)];
    return vertexOf(triangle, end.towards) - vertexOf(triangle, end.at);
  };
  const Vector3d along = directionOf(*first);
  bool isBack = false;
  for (const CornerEnd* end = first; end != last; ++end) {
    const Vector3d direction = directionOf(*end);
    const double cosine = along.dot(direction);
    if (!(along.cross(direction).norm() <= kFlatSine * std::abs(cosine)) || cosine == 0.0) {
      return false;
    }
    isBack = isBack || cosine < 0.0;
  }
  return isBack;
}

/// Calls `take` with each run of equal hashes.
template <typename Item, typename Take>
void forRuns(const std::vector<Item>& sorted, const Take& take) {
  for (std::size_t first = 0; first < sorted.size();) {
    std::size_t last = first + 1;
    while (last < sorted.size() && sorted[last].hash == sorted[first].hash) ++last;
    take(sorted.data() + first, sorted.data() + last);
    first = last;
  }
}

void set(std::vector<std::uint16_t>& bits, TriangleId id, int bit) {
  bits[slotOf(id)] = static_cast<std::uint16_t>(bits[slotOf(id)] | 1U << bit);
}

const auto byHash = [](const auto& x, const auto& y) { return x.hash < y.hash; };

}  // namespace

FlatEdges::FlatEdges(const FrozenArray<Triangle>& triangles, const std::vector<TriangleId>& ids) {
  Bits bits(triangles.size(), 0);
  findEdges(triangles, ids, bits);
  findVertices(triangles, ids, bits);
  bits_ = FrozenArray<std::uint16_t>(std::move(bits));
}

void FlatEdges::findEdges(const FrozenArray<Triangle>& triangles,
                          const std::vector<TriangleId>& ids, Bits& bits) {
  std::vector<EdgeOf> edges;
  edges.reserve(3 * ids.size());
  for (const TriangleId id : ids) {
    for (const int k : {0, 1, 2}) {
      const int from = k == 2 ? 0 : k, to = k == 2 ? 2 : k + 1;  // the lesser vertex first
      const Triangle& triangle = triangles[slotOf(id)];
      edges.push_back(
          {hashOfPoint(vertexOf(triangle, to), hashOfPoint(vertexOf(triangle, from), 0)), id, k});
    }
  }
  std::sort(edges.begin(), edges.end(), byHash);
  forRuns(edges, [&](const EdgeOf* first, const EdgeOf* last) {
    if (last - first > static_cast<std::ptrdiff_t>(kMostAtEdge)) return;
    for (const EdgeOf* one = first; one != last; ++one) {
      for (const EdgeOf* other = one + 1; other < last; ++other) {
        if (!goOnFlat(triangles[slotOf(one->id)], one->k, triangles[slotOf(other->id)], other->k)) {
          continue;
        }
        set(bits, one->id, kEdges + one->k);
        set(bits, other->id, kEdges + other->k);
      }
    }
  });
}

/// Hashes stand for vertices: two with the same one would both count as corners.
void FlatEdges::findVertices(const FrozenArray<Triangle>& triangles,
                             const std::vector<TriangleId>& ids, Bits& bits) {
  std::vector<CornerEnd> ends;
  const auto hashAt = [&](TriangleId id, int k) {
    return hashOfPoint(vertexOf(triangles[slotOf(id)], k), 0);
  };
  for (const TriangleId id : ids) {
    for (const int k : {0, 1, 2}) {
      if ((bits[slotOf(id)] >> (kEdges + k) & 1U) != 0) continue;
      const auto from = static_cast<std::int8_t>(k), to = static_cast<std::int8_t>((k + 1) % 3);
      ends.push_back({hashAt(id, from), id, from, to});
      ends.push_back({hashAt(id, to), id, to, from});
    }
  }
  std::sort(ends.begin(), ends.end(), byHash);
  std::vector<Corner> corners;
  forRuns(ends, [&](const CornerEnd* first, const CornerEnd* last) {
    corners.push_back({first->hash, areInLine(first, last, triangles)});
  });
  for (const TriangleId id : ids) {
    for (const int k : {0, 1, 2}) {
      const Corner sought{hashAt(id, k), false};
      const auto found = std::lower_bound(corners.begin(), corners.end(), sought, byHash);
      if (found == corners.end() || found->hash != sought.hash) {
        set(bits, id, kFlat + k);
      } else if (found->isStraight) {
        set(bits, id, kStraight + k);
      }
    }
  }
}

}  // namespace foretouch::internal
