#include "assets/import/solids.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <Eigen/Geometry>

#include "lss/index.h"
#include "lss/rounding.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

constexpr int kSides = 32;
constexpr double kPi = 3.14159265358979323846;
/// An octahedron's eight triangles, each cut into four so often: 512.
constexpr int kCuts = 3;

/// Corners on the unit sphere, facing out.
FlatMesh octahedron() {
  FlatMesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    mesh.vertices.push_back(Vector3d::Unit(axis));
    mesh.vertices.push_back(-Vector3d::Unit(axis));
  }
  for (std::int32_t octant = 0; octant < 8; ++octant) {
    const std::int32_t x = octant & 1, y = 2 + (octant >> 1 & 1), z = 4 + (octant >> 2 & 1);
    const bool isMirrored = ((x + y + z) & 1) != 0;
    mesh.triangles.push_back(isMirrored ? std::array{x, z, y} : std::array{x, y, z});
  }
  return mesh;
}

/// Each triangle becomes four, with the new corners on the unit sphere.
void cut(FlatMesh& mesh) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
  const auto middleOf = [&](std::int32_t a, std::int32_t b) {
    const auto [found, isNew] = middles.emplace(std::minmax(a, b), 0);
    if (isNew) {
      found->second = static_cast<std::int32_t>(mesh.vertices.size());
      const Vector3d sum = mesh.vertices[slotOf(a)] + mesh.vertices[slotOf(b)];
      mesh.vertices.push_back(sum.normalized());
    }
    return found->second;
  };
  std::vector<std::array<std::int32_t, 3>> finer;
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::int32_t ab = middleOf(a, b), bc = middleOf(b, c), ca = middleOf(c, a);
    finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  mesh.triangles = std::move(finer);
}

}  // namespace

FlatMesh boxOf(const Vector3d& size) {
  FlatMesh box;
  for (int i = 0; i < 8; ++i) {
    const Vector3d sign((i & 1) != 0 ? 0.5 : -0.5, (i & 2) != 0 ? 0.5 : -0.5,
                        (i & 4) != 0 ? 0.5 : -0.5);
    box.vertices.push_back(sign.cwiseProduct(size));
  }
  // Corners of each side in turn about it; bit k of a corner's number is its side along axis k.
  constexpr std::array<std::array<std::int32_t, 4>, 6> kSidesOfBox = {
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (const auto& side : kSidesOfBox) {
    box.triangles.push_back({side[0], side[1], side[2]});
    box.triangles.push_back({side[0], side[2], side[3]});
  }
  return box;
}

FlatMesh cylinderAround(double radius, double length) {
  FlatMesh prism;
  const double corner = radius / std::cos(kPi / kSides) * kInflation;
  const double halfLength = length / 2 * kInflation;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2 * kPi * i / kSides;
    const double x = corner * std::cos(angle), y = corner * std::sin(angle);
    prism.vertices.emplace_back(x, y, -halfLength);
    prism.vertices.emplace_back(x, y, halfLength);
  }
  for (std::int32_t i = 0; i < kSides; ++i) {
    const std::int32_t low = 2 * i, next = 2 * ((i + 1) % kSides);
    prism.triangles.push_back({low, next, next + 1});
    prism.triangles.push_back({low, next + 1, low + 1});
    if (i == 0 || i + 1 == kSides) continue;
    prism.triangles.push_back({0, next, low});
    prism.triangles.push_back({1, low + 1, next + 1});
  }
  return prism;
}

FlatMesh ellipsoidAround(const Vector3d& semiAxes) {
  FlatMesh mesh = octahedron();
  for (int i = 0; i < kCuts; ++i) cut(mesh);
  // The sides' least distance from the centre: divided by it, all of them touch the unit sphere or
  // lie outside.
  double least = 1.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vector3d& corner = mesh.vertices[slotOf(a)];
    const Vector3d normal =
        (mesh.vertices[slotOf(b)] - corner).cross(mesh.vertices[slotOf(c)] - corner).normalized();
    least = std::min(least, normal.dot(corner));
  }
  for (Vector3d& v : mesh.vertices) v = semiAxes.cwiseProduct(v * (kInflation / least));
  return mesh;
}

}  // namespace foretouch::internal
