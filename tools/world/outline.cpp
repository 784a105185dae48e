#include "tools/world/outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <Eigen/Geometry>

#include "lss/index.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

/// Faces that meet at less than this are one surface: 20 degrees.
constexpr double kBentCosine = 0.9396926207859084;
constexpr int kSidesOfACircle = 48;
constexpr double kFullTurn = 6.283185307179586;

void addLine(const Vector3d& from, const Vector3d& to, std::vector<Vector3d>& lines) {
  if (lines.size() < 2 * kMostOutlineLines) lines.insert(lines.end(), {from, to});
}

/// Adds an arc from `x` on, towards `y`, both as long as the radius.
void addArc(const Vector3d& center, const Vector3d& x, const Vector3d& y, int sides,
            std::vector<Vector3d>& lines) {
  const auto at = [&](int side) -> Vector3d {
    const double angle = kFullTurn * side / kSidesOfACircle;
    return center + std::cos(angle) * x + std::sin(angle) * y;
  };
  for (int side = 0; side < sides; ++side) addLine(at(side), at(side + 1), lines);
}

/// Circles around both ends of the axis, and two outlines along it that cross at right angles.
void addLss(const Lss& lss, std::vector<Vector3d>& lines) {
  const Vector3d axis = lss.b - lss.a;
  const double length = axis.norm();
  const Vector3d up = length > 0.0 ? Vector3d(axis / length) : Vector3d::UnitY();
  const Vector3d x = up.unitOrthogonal(), z = up.cross(x);
  const double r = lss.radius;
  addArc(lss.a, r * x, r * z, kSidesOfACircle, lines);
  if (length > 0.0) addArc(lss.b, r * x, r * z, kSidesOfACircle, lines);
  for (const Vector3d& side : {x, z}) {
    addArc(lss.b, r * side, r * up, kSidesOfACircle / 2, lines);
    addArc(lss.a, r * side, -r * up, kSidesOfACircle / 2, lines);
    if (length == 0.0) continue;
    addLine(lss.a + r * side, lss.b + r * side, lines);
    addLine(lss.a - r * side, lss.b - r * side, lines);
  }
}

using Corner = std::array<double, 3>;
struct Edge {
  Vector3d from, to, normal;
  int faces = 0;
  bool isBent = false;
};

void addMesh(const std::vector<Triangle>& triangles, std::vector<Vector3d>& lines) {
  std::map<std::pair<Corner, Corner>, Edge> edges;
  for (const Triangle& triangle : triangles) {
    const auto& v = triangle.vertices;
    const Vector3d normal = (v[1] - v[0]).cross(v[2] - v[0]).normalized();
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3d &p = v[i], &q = v[(i + 1) % 3];
      Corner a{p.x(), p.y(), p.z()}, b{q.x(), q.y(), q.z()};
      if (b < a) std::swap(a, b);
      Edge& edge = edges.try_emplace({a, b}, Edge{p, q, normal, 0, false}).first->second;
      edge.isBent = edge.isBent || (edge.faces > 0 && edge.normal.dot(normal) < kBentCosine);
      ++edge.faces;
    }
  }
  const auto isDrawn = [](const auto& entry) {
    return entry.second.isBent || entry.second.faces != 2;
  };
  const bool isRound = std::none_of(edges.begin(), edges.end(), isDrawn);
  for (const auto& entry : edges) {
    if (isRound || isDrawn(entry)) addLine(entry.second.from, entry.second.to, lines);
  }
}

}  // namespace

std::vector<Vector3d> outlineOf(const BodyShape& shape) {
  std::vector<Vector3d> lines;
  if (shape.avatar) {
    for (LinkId link = 0; link < shape.avatar->numLinks(); ++link) {
      for (const Lss& lss : shape.avatar->lss(link)) addLss(lss, lines);
    }
  } else {
    addMesh(*shape.triangles, lines);
  }
  return lines;
}

}  // namespace foretouch::tools
