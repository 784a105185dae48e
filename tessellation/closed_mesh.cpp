#include "tessellation/closed_mesh.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "lss/assert.h"

namespace foretouch {
namespace {

/// The side of a triangle from its corner number `slot % 3` to the next.
struct HalfEdge {
  MeshKey low = 0, high = 0;
  std::uint32_t slot = 0;  ///< 3 * triangle + corner
  bool isUpward = false;   ///< From low to high.
};

std::uint32_t nextSlot(std::uint32_t slot) {
  return slot % 3 == 2 ? slot - 2 : slot + 1;
}

/// Merging sets, each represented by its least number.
class Merging {
 public:
  explicit Merging(std::uint32_t count) {
    parent_.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i) parent_.push_back(i);
  }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }
  void merge(std::uint32_t i, std::uint32_t j) {
    i = find(i);
    j = find(j);
    parent_[std::max(i, j)] = std::min(i, j);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

std::vector<HalfEdge> sortedHalfEdges(const std::vector<std::array<MeshKey, 3>>& triangles) {
  std::vector<HalfEdge> halves;
  halves.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      const MeshKey from = triangles[t][i], to = triangles[t][(i + 1) % 3];
      FORETOUCH_ASSERT(from != to);
      halves.push_back({std::min(from, to), std::max(from, to), 3 * t + i, from < to});
    }
  }
  std::sort(halves.begin(), halves.end(), [](const HalfEdge& x, const HalfEdge& y) {
    return std::tie(x.low, x.high, x.isUpward, x.slot) <
           std::tie(y.low, y.high, y.isUpward, y.slot);
  });
  return halves;
}

/// The other triangle's side at every side: along an edge that more than two share, pairs the sides
/// of both directions in order.
std::vector<std::uint32_t> partnersOf(const std::vector<HalfEdge>& halves) {
  std::vector<std::uint32_t> partner(halves.size());
  for (std::size_t begin = 0; begin < halves.size();) {
    std::size_t middle = begin, end = begin;
    while (end < halves.size() && halves[end].low == halves[begin].low &&
           halves[end].high == halves[begin].high) {
      middle += halves[end].isUpward ? 0 : 1;
      ++end;
    }
    FORETOUCH_ASSERT(middle - begin == end - middle);
    for (std::size_t i = 0; i < middle - begin; ++i) {
      partner[halves[begin + i].slot] = halves[middle + i].slot;
      partner[halves[middle + i].slot] = halves[begin + i].slot;
    }
    begin = end;
  }
  return partner;
}

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// Sides of triangles, by slot, that need a vertex half way: all but one pair of those that run
/// between the same two vertices.
std::vector<std::uint32_t> repeatedSides(const Triangles& triangles,
                                         const std::vector<std::uint32_t>& partner) {
  std::vector<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>> upward;
  for (std::uint32_t slot = 0; slot < partner.size(); ++slot) {
    const std::uint32_t from = triangles[slot / 3][slot % 3];
    const std::uint32_t to = triangles[slot / 3][nextSlot(slot) % 3];
    if (from < to) upward.emplace_back(from, to, slot);
  }
  std::sort(upward.begin(), upward.end());
  std::vector<std::uint32_t> repeated;
  for (std::size_t i = 1; i < upward.size(); ++i) {
    const auto& [from, to, slot] = upward[i];
    if (from == std::get<0>(upward[i - 1]) && to == std::get<1>(upward[i - 1])) {
      repeated.push_back(slot);
    }
  }
  return repeated;
}

/// One triangle with vertices half way along some of its sides, cut into triangles that keep its
/// winding.
void cut(const std::array<std::uint32_t, 3>& corners, const std::array<std::uint32_t, 3>& halfWay,
         std::uint32_t none, Triangles& out) {
  std::array<std::uint32_t, 6> ring{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    ring[count++] = corners[i];
    if (halfWay[i] != none) ring[count++] = halfWay[i];
  }
  // Begin at a vertex half way: then no triangle has it and two others on one line.
  const auto end = ring.begin() + static_cast<std::ptrdiff_t>(count);
  std::rotate(ring.begin(),
              std::find_if(ring.begin(), end,
                           [&](std::uint32_t v) {
                             return std::find(corners.begin(), corners.end(), v) == corners.end();
                           }),
              end);
  if (count == 6) {  // three half way: cut off the corners
    out.push_back({ring[0], ring[1], ring[2]});
    out.push_back({ring[2], ring[3], ring[4]});
    out.push_back({ring[4], ring[5], ring[0]});
    out.push_back({ring[0], ring[2], ring[4]});
    return;
  }
  for (std::size_t i = 1; i + 1 < count; ++i) {
    out.push_back({ring[0], ring[i], ring[i + 1]});
  }
}

void splitRepeatedSides(ClosedMesh& mesh, const std::vector<std::uint32_t>& partner) {
  const std::vector<std::uint32_t> repeated = repeatedSides(mesh.triangles, partner);
  if (repeated.empty()) return;
  constexpr std::uint32_t kNone = ~0u;
  std::vector<std::uint32_t> halfWay(partner.size(), kNone);
  for (const std::uint32_t slot : repeated) {
    const auto& triangle = mesh.triangles[slot / 3];
    const MeshKey from = mesh.vertices[triangle[slot % 3]].a;
    const MeshKey to = mesh.vertices[triangle[nextSlot(slot) % 3]].a;
    halfWay[slot] = halfWay[partner[slot]] = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back({from, to});
  }
  Triangles triangles;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::array<std::uint32_t, 3> middles{halfWay[3 * t], halfWay[3 * t + 1],
                                               halfWay[3 * t + 2]};
    const bool isWhole = middles == std::array<std::uint32_t, 3>{kNone, kNone, kNone};
    if (isWhole) {
      triangles.push_back(mesh.triangles[t]);
    } else {
      cut(mesh.triangles[t], middles, kNone, triangles);
    }
  }
  mesh.triangles = std::move(triangles);
}

}  // namespace

ClosedMesh closedMesh(const std::vector<std::array<MeshKey, 3>>& triangles) {
  const std::vector<std::uint32_t> partner = partnersOf(sortedHalfEdges(triangles));
  // Corners of triangles joined across shared sides are one vertex.
  Merging corners(static_cast<std::uint32_t>(partner.size()));
  for (std::uint32_t slot = 0; slot < partner.size(); ++slot) {
    corners.merge(slot, nextSlot(partner[slot]));
  }
  ClosedMesh mesh;
  std::vector<std::uint32_t> vertexOf(partner.size());
  mesh.triangles.resize(triangles.size());
  for (std::uint32_t slot = 0; slot < partner.size(); ++slot) {
    const std::uint32_t first = corners.find(slot);
    if (first == slot) {
      vertexOf[slot] = static_cast<std::uint32_t>(mesh.vertices.size());
      const MeshKey key = triangles[slot / 3][slot % 3];
      mesh.vertices.push_back({key, key});
    }
    mesh.triangles[slot / 3][slot % 3] = vertexOf[first];
  }
  splitRepeatedSides(mesh, partner);
  return mesh;
}

}  // namespace foretouch
