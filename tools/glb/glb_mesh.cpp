#include "tools/glb/glb_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <Eigen/Geometry>

#include "lss/vertex_order.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr double kPi = 3.14159265358979323846;
constexpr int kSectors = 16;  ///< Around an axis.
constexpr int kRings = 4;     ///< For half a ball, from pole to equator.

/// A circle of a surface of revolution: its place along the axis, its width and its slope.
struct Ring {
  double height = 0.0, radius = 0.0;
  double normalUp = 0.0, normalOut = 1.0;
};

/// An axis, and two directions across it, as columns y, x, z of a frame.
struct Frame {
  Vector3d origin = Vector3d::Zero(), up = Vector3d::UnitY(), x = Vector3d::UnitX(),
           z = Vector3d::UnitZ();
};

Frame frameAlong(const Vector3d& origin, const Vector3d& up) {
  Frame frame;
  frame.origin = origin;
  frame.up = up;
  frame.x = up.unitOrthogonal();
  frame.z = frame.x.cross(up);
  return frame;
}

/// Adds the surface through the rings, bottom to top; the inside is to their left.
void appendRings(const Frame& frame, const std::vector<Ring>& rings, GlbMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Ring& ring : rings) {
    for (int sector = 0; sector < kSectors; ++sector) {
      const double angle = 2.0 * kPi * sector / kSectors;
      const Vector3d out = std::cos(angle) * frame.x + std::sin(angle) * frame.z;
      const Vector3d place = frame.origin + ring.height * frame.up + ring.radius * out;
      const Vector3d normal = ring.normalUp * frame.up + ring.normalOut * out;
      mesh.positions.push_back(place.cast<float>());
      mesh.normals.push_back(normal.normalized().cast<float>());
    }
  }
  for (std::uint32_t ring = 0; ring + 1 < rings.size(); ++ring) {
    for (std::uint32_t sector = 0; sector < kSectors; ++sector) {
      const std::uint32_t next = (sector + 1) % kSectors;
      const std::uint32_t a = first + ring * kSectors + sector;
      const std::uint32_t b = first + ring * kSectors + next;
      const std::uint32_t c = a + kSectors, d = b + kSectors;
      mesh.indices.insert(mesh.indices.end(), {a, c, d, a, d, b});
    }
  }
}

/// The rings from one pole to the other; the equator twice, `length` apart.
std::vector<Ring> capsuleRings(double length, double radius) {
  std::vector<Ring> rings;
  for (const int half : {-1, 1}) {
    for (int i = 0; i <= kRings; ++i) {
      const double angle = 0.5 * kPi * (half < 0 ? i - kRings : i) / kRings;
      const double up = std::sin(angle), out = std::cos(angle);
      rings.push_back({(half < 0 ? 0.0 : length) + radius * up, radius * out, up, out});
    }
  }
  return rings;
}

}  // namespace

GlbMesh meshOf(const std::vector<Triangle>& triangles, const Vector3d& origin) {
  std::vector<Vector3f> corners;
  corners.reserve(3 * triangles.size());
  for (const Triangle& triangle : triangles) {
    for (const Vector3d& v : triangle.vertices) {
      corners.push_back((v - origin).cast<float>());
    }
  }
  std::vector<std::uint32_t> order(corners.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    return isBeforeByCoordinates<Vector3f>(corners[i], corners[j]);
  });
  GlbMesh mesh;
  mesh.indices.resize(corners.size());
  for (const std::uint32_t corner : order) {
    if (mesh.positions.empty() || mesh.positions.back() != corners[corner]) {
      mesh.positions.push_back(corners[corner]);
    }
    mesh.indices[corner] = static_cast<std::uint32_t>(mesh.positions.size() - 1);
  }
  return mesh;
}

void appendLss(const Lss& lss, GlbMesh& mesh) {
  const Vector3d axis = lss.b - lss.a;
  const double length = axis.norm();
  const Vector3d up = length > 0.0 ? Vector3d(axis / length) : Vector3d::UnitY();
  appendRings(frameAlong(lss.a, up), capsuleRings(length, lss.radius), mesh);
}

std::size_t trianglesOfLss() {
  return std::size_t{2} * kSectors * (2 * kRings + 1);
}

GlbMesh markerMesh(double length) {
  const double ball = 0.12 * length, shaft = 0.03 * length, head = 0.08 * length;
  const double neck = 0.75 * length;
  GlbMesh mesh;
  const Frame frame;
  appendRings(frame, capsuleRings(0.0, ball), mesh);
  appendRings(frame, {{0.0, shaft}, {neck, shaft}}, mesh);
  appendRings(frame, {{neck, 0.0, -1.0, 0.0}, {neck, head, -1.0, 0.0}}, mesh);
  appendRings(frame, {{neck, head, head, length - neck}, {length, 0.0, head, length - neck}}, mesh);
  return mesh;
}

}  // namespace foretouch::tools
