#include "tools/report/indexed_mesh.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <meshoptimizer.h>
#include <utility>

namespace foretouch::tools {
namespace {

/// An error of 1 is the size of the mesh: the target alone decides.
constexpr float kAnyError = 1.0f;
constexpr std::size_t kVertexBytes = 3 * sizeof(float);

using Indices = std::vector<std::uint32_t>;

/// One side of a triangle.
struct Side {
  std::uint32_t low = 0, high = 0;  ///< Its vertices.
  std::uint32_t triangle = 0;
  bool isUpward = false;  ///< The triangle runs through it from low to high.

  [[nodiscard]] auto edge() const { return std::make_pair(low, high); }
};

std::vector<Side> sidesOf(const Indices& indices) {
  std::vector<Side> sides;
  sides.reserve(indices.size());
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const std::uint32_t from = indices[i], to = indices[i % 3 == 2 ? i - 2 : i + 1];
    if (from == to) continue;
    sides.push_back(
        {std::min(from, to), std::max(from, to), static_cast<std::uint32_t>(i / 3), from < to});
  }
  std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
    return std::make_pair(x.edge(), x.triangle) < std::make_pair(y.edge(), y.triangle);
  });
  return sides;
}

struct Neighbour {
  std::uint32_t triangle = 0;
  bool isOpposed = false;  ///< Both run through the edge in the same direction.
};

/// The neighbours of one triangle, across edges that exactly two triangles share.
struct Neighbours {
  std::array<Neighbour, 3> across;
  std::uint32_t count = 0;

  void add(const Neighbour& neighbour) { across[count++] = neighbour; }
  [[nodiscard]] const Neighbour* begin() const { return across.data(); }
  [[nodiscard]] const Neighbour* end() const { return across.data() + count; }
};

std::vector<Neighbours> neighboursOf(const Indices& indices) {
  const std::vector<Side> sides = sidesOf(indices);
  std::vector<Neighbours> neighbours(indices.size() / 3);
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i + 1;
    while (end < sides.size() && sides[end].edge() == sides[i].edge()) ++end;
    if (end == i + 2) {
      const Side &one = sides[i], &other = sides[i + 1];
      const bool isOpposed = one.isUpward == other.isUpward;
      neighbours[one.triangle].add({other.triangle, isOpposed});
      neighbours[other.triangle].add({one.triangle, isOpposed});
    }
    i = end;
  }
  return neighbours;
}

/// Flips triangles so that neighbours agree, as far as possible: scenes do not say which side is
/// out, and the simplifier treats an edge whose triangles disagree as a border.
void orient(Indices& indices) {
  const std::vector<Neighbours> neighbours = neighboursOf(indices);
  std::vector<std::uint8_t> isReached(neighbours.size(), 0), isTurned(neighbours.size(), 0);
  std::vector<std::uint32_t> open;
  for (std::uint32_t first = 0; first < neighbours.size(); ++first) {
    if (isReached[first] != 0) continue;
    isReached[first] = 1;
    open.assign(1, first);
    while (!open.empty()) {
      const std::uint32_t triangle = open.back();
      open.pop_back();
      for (const Neighbour& next : neighbours[triangle]) {
        if (isReached[next.triangle] != 0) continue;
        isReached[next.triangle] = 1;
        isTurned[next.triangle] = isTurned[triangle] ^ (next.isOpposed ? 1 : 0);
        open.push_back(next.triangle);
      }
    }
  }
  for (std::size_t i = 0; i < isTurned.size(); ++i) {
    if (isTurned[i] != 0) std::swap(indices[3 * i + 1], indices[3 * i + 2]);
  }
}

/// Clusters larger meshes right away: edges would take gigabytes.
constexpr std::size_t kMostByEdges = 5'000'000;

}  // namespace

ViewMesh indexed(Corners corners) {
  ViewMesh mesh;
  const std::size_t count = corners.size() / 3;
  if (count == 0) return mesh;
  for (float& number : corners) number += 0.0f;  // the bytes are compared
  mesh.indices.resize(count);
  const std::size_t vertices = meshopt_generateVertexRemap(mesh.indices.data(), nullptr, count,
                                                           corners.data(), count, kVertexBytes);
  mesh.positions.resize(3 * vertices);
  meshopt_remapVertexBuffer(mesh.positions.data(), corners.data(), count, kVertexBytes,
                            mesh.indices.data());
  return mesh;
}

Simplifier::Simplifier(const Corners& corners, std::size_t most) : mesh_(indexed(corners)) {
  trianglesGiven_ = mesh_.triangles();
  if (trianglesGiven_ == 0) return;
  scaleM_ = static_cast<double>(
      meshopt_simplifyScale(mesh_.positions.data(), mesh_.vertices(), kVertexBytes));
  if (trianglesGiven_ > most) {
    Simplified made = merged(most, {mesh_.indices, 0.0});
    mesh_.indices = std::move(made.indices);
    mergedM_ = made.errorM;
  }
  if (hasEdges()) orient(mesh_.indices);
}

/// Vertices in one cell of a grid become one.
Simplified Simplifier::merged(std::size_t target, const Simplified& made) const {
  float error = 0.0f;
  Indices kept(made.indices.size());
  kept.resize(meshopt_simplifySloppy(kept.data(), made.indices.data(), made.indices.size(),
                                     mesh_.positions.data(), mesh_.vertices(), kVertexBytes,
                                     3 * target, kAnyError, &error));
  return {std::move(kept), made.errorM + scaleM_ * static_cast<double>(error)};
}

bool Simplifier::hasEdges() const {
  return mesh_.triangles() <= kMostByEdges;
}

Simplified Simplifier::within(double errorM) const {
  if (!hasEdges() || !(scaleM_ > 0.0) || errorM <= mergedM_) return {mesh_.indices, mergedM_};
  return collapsed(0, static_cast<float>((errorM - mergedM_) / scaleM_));
}

Simplified Simplifier::downTo(std::size_t target) const {
  Simplified made = hasEdges() ? collapsed(target, kAnyError) : Simplified{mesh_.indices, mergedM_};
  // Edges collapse in bunches: a little more than the target is good enough.
  if (made.triangles() <= target + target / 20) return made;
  return merged(target, made);
}

Simplified Simplifier::collapsed(std::size_t target, float error) const {
  float found = 0.0f;
  std::vector<std::uint32_t> kept(mesh_.indices.size());
  if (!kept.empty()) {
    kept.resize(meshopt_simplify(kept.data(), mesh_.indices.data(), mesh_.indices.size(),
                                 mesh_.positions.data(), mesh_.vertices(), kVertexBytes, 3 * target,
                                 error, 0, &found));
  }
  return {std::move(kept), mergedM_ + scaleM_ * static_cast<double>(found)};
}

void Simplifier::append(const Simplified& made, Corners& corners) const {
  for (const std::uint32_t vertex : made.indices) {
    const float* const place = mesh_.positions.data() + std::size_t{3} * vertex;
    corners.insert(corners.end(), place, place + 3);
  }
}

}  // namespace foretouch::tools
