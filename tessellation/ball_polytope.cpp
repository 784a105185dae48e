#include "tessellation/ball_polytope.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "articulated/try.h"
#include "lss/assert.h"
#include "lss/index.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;

/// Covers the few roundings of a distance.
constexpr double kOutward = 1.0 + 1e-14, kInward = 1.0 - 1e-14;
/// Rounding moves a corner by at most half the diagonal of a lattice cell, 0.8661 spacings.
constexpr double kCornerRounding = 0.8661;
constexpr double kMaxEdgeComponent = 0x1p30;

/// Corners of an icosahedron and its faces, seen from outside counter-clockwise.
struct Icosahedron {
  std::array<Vector3d, 12> corners;
  std::array<std::array<int, 3>, 20> faces{
      {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
       {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
       {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  Icosahedron() {
    const double golden = (1.0 + std::sqrt(5.0)) / 2.0;
    corners = {Vector3d(-1, golden, 0),  Vector3d(1, golden, 0),   Vector3d(-1, -golden, 0),
               Vector3d(1, -golden, 0),  Vector3d(0, -1, golden),  Vector3d(0, 1, golden),
               Vector3d(0, -1, -golden), Vector3d(0, 1, -golden),  Vector3d(golden, 0, -1),
               Vector3d(golden, 0, 1),   Vector3d(-golden, 0, -1), Vector3d(-golden, 0, 1)};
    for (Vector3d& corner : corners) corner.normalize();
  }
};

/// Unit corners and facets of the icosahedron's faces cut into frequency^2 triangles.
struct UnitMesh {
  std::vector<Vector3d> corners;
  std::vector<std::array<std::int32_t, 3>> facets;
};

/// Weights by the sine of the arc, so that the corners on an icosahedron's edge are equally far
/// apart on the sphere; cutting the flat edge evenly would make facets in the middle larger.
UnitMesh unitMesh(int frequency) {
  const Icosahedron icosahedron;
  const double arc = std::acos(1.0 / std::sqrt(5.0));
  UnitMesh mesh;
  std::map<std::array<int, 6>, std::int32_t> known;  // (icosahedron's corner, weight) by corner
  const auto cornerOf = [&](const std::array<int, 3>& face, const std::array<int, 3>& weights) {
    std::array<std::pair<int, int>, 3> terms;
    for (std::size_t i = 0; i < 3; ++i) {
      terms[i] = weights[i] == 0 ? std::pair{-1, 0} : std::pair{face[i], weights[i]};
    }
    std::sort(terms.begin(), terms.end());
    std::array<int, 6> key{};
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [corner, weight] = terms[i];
      key[2 * i] = corner;
      key[2 * i + 1] = weight;
      if (weight > 0) {
        sum += std::sin(arc * weight / frequency) * icosahedron.corners[slotOf(corner)];
      }
    }
    const auto [place, isNew] = known.emplace(key, static_cast<std::int32_t>(mesh.corners.size()));
    if (isNew) mesh.corners.push_back(sum.normalized());
    return place->second;
  };
  for (const auto& face : icosahedron.faces) {
    for (int i = 0; i < frequency; ++i) {
      for (int j = 0; j < frequency - i; ++j) {
        const auto at = [&](int p, int q) { return cornerOf(face, {frequency - p - q, p, q}); };
        mesh.facets.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
        if (j + i + 1 < frequency) {
          mesh.facets.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
        }
      }
    }
  }
  return mesh;
}

double inradiusOf(const UnitMesh& mesh) {
  double least = 1.0;
  for (const auto& facet : mesh.facets) {
    const auto corner = [&](std::size_t i) { return mesh.corners[slotOf(facet[i])]; };
    const Vector3d normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
    least = std::min(least, normal.dot(corner(0)));
  }
  return least;
}

Vector3d asVector(const LatticePoint& p) {
  return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
}

void connect(BallPolytope& polytope) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> facetLeftOf;
  for (std::size_t f = 0; f < polytope.facets.size(); ++f) {
    const auto& corners = polytope.facets[f].corners;
    for (std::size_t i = 0; i < 3; ++i) {
      facetLeftOf[{corners[i], corners[(i + 1) % 3]}] = static_cast<std::int32_t>(f);
    }
  }
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> edgeOf;
  std::vector<std::int32_t> anyEdge(polytope.corners.size(), -1);
  for (const auto& [ends, left] : facetLeftOf) {
    const auto [u, v] = ends;
    if (u > v) continue;
    const auto edge = static_cast<std::int32_t>(polytope.edges.size());
    edgeOf[{u, v}] = edge;
    edgeOf[{v, u}] = edge;
    polytope.edges.push_back({u, v, left, facetLeftOf.at({v, u})});
    anyEdge[slotOf(u)] = anyEdge[slotOf(v)] = edge;
  }
  for (std::size_t corner = 0; corner < polytope.corners.size(); ++corner) {
    polytope.firstEdgeOf.push_back(static_cast<std::int32_t>(polytope.edgesAround.size()));
    const auto self = static_cast<std::int32_t>(corner);
    const auto& start = polytope.edges[slotOf(anyEdge[corner])];
    std::int32_t other = start.u == self ? start.v : start.u;
    const std::int32_t first = other;
    do {
      polytope.edgesAround.push_back(edgeOf.at({self, other}));
      // The facet left of the edge out of the corner lies between it and the next edge.
      const auto& facet = polytope.facets[slotOf(facetLeftOf.at({self, other}))].corners;
      const auto place = std::find(facet.begin(), facet.end(), self) - facet.begin();
      other = facet[slotOf((place + 2) % 3)];
    } while (other != first);
  }
  polytope.firstEdgeOf.push_back(static_cast<std::int32_t>(polytope.edgesAround.size()));
}

/// Exact: no corner of a neighbouring facet lies above a facet.
bool isConvex(const BallPolytope& polytope) {
  for (const BallPolytope::Edge& edge : polytope.edges) {
    const auto& left = polytope.facets[slotOf(edge.left)];
    const auto& right = polytope.facets[slotOf(edge.right)].corners;
    const LatticePoint origin = polytope.corners[slotOf(edge.u)];
    for (const std::int32_t corner : right) {
      const LatticePoint apart = polytope.corners[slotOf(corner)] - origin;
      if (exactDot(left.normal, apart) > 0) return false;
    }
  }
  return true;
}

Error tooFine(const char* what) {
  return Error::of(ErrorCode::LimitExceeded, what);
}

/// The unit mesh with its corners at `radius`, rounded to the lattice.
Result<BallPolytope> scaledPolytope(const UnitMesh& mesh, double radius, int frequency) {
  BallPolytope polytope;
  polytope.frequency = frequency;
  for (const Vector3d& unit : mesh.corners) {
    polytope.corners.push_back({std::llround(radius * unit.x()), std::llround(radius * unit.y()),
                                std::llround(radius * unit.z())});
    polytope.circumradius =
        std::max(polytope.circumradius, asVector(polytope.corners.back()).norm() * kOutward);
  }
  polytope.inradius = polytope.circumradius;
  for (const auto& corners : mesh.facets) {
    const auto at = [&](std::size_t i) { return polytope.corners[slotOf(corners[i])]; };
    const LatticePoint u = at(1) - at(0), v = at(2) - at(0);
    if (std::max(asVector(u).cwiseAbs().maxCoeff(), asVector(v).cwiseAbs().maxCoeff()) >=
        kMaxEdgeComponent) {
      return tooFine("the error is too small for a radius this large");
    }
    const LatticePoint normal = exactCross(u, v);
    polytope.facets.push_back({corners, normal});
    const double height = static_cast<double>(exactDot(normal, at(0))) / asVector(normal).norm();
    if (!(height > 0.0)) return tooFine("the lattice is too coarse for the error");
    polytope.inradius = std::min(polytope.inradius, height * kInward);
  }
  connect(polytope);
  if (!isConvex(polytope)) {
    return tooFine("the lattice is too coarse for the error");
  }
  return polytope;
}

/// The coarsest mesh whose corners are at most `ratio` times as far out as its facets.
Result<std::pair<UnitMesh, int>> meshOfRatio(double ratio) {
  // Facets of a frequency f leave about 0.29 / f^2 of the radius.
  const double estimate = std::sqrt(0.2 / std::max(1e-12, ratio - 1.0));
  int frequency = std::max(1, static_cast<int>(std::min(estimate, 2.0 * kMaxPolytopeFrequency)));
  for (; frequency <= kMaxPolytopeFrequency; ++frequency) {
    UnitMesh mesh = unitMesh(frequency);
    if (1.0 <= ratio * inradiusOf(mesh)) return std::pair{std::move(mesh), frequency};
    if (frequency > 50) frequency += frequency / 50;
  }
  return tooFine("the error is too small for a radius this large");
}

}  // namespace

Result<BallPolytope> polytopeAround(double radius, double excess) {
  // Rounding moves a facet inward, and a corner outward, by at most kCornerRounding.
  const double grown = (radius + kCornerRounding) * kOutward;
  FORETOUCH_TRY(const auto mesh, meshOfRatio((radius + excess - kCornerRounding) / grown));
  auto polytope =
      scaledPolytope(mesh.first, grown / inradiusOf(mesh.first) * kOutward, mesh.second);
  if (polytope.ok()) FORETOUCH_ASSERT(polytope.value().inradius >= radius);
  return polytope;
}

Result<BallPolytope> polytopeWithin(double radius, double lack) {
  const double shrunk = (radius - kCornerRounding) * kInward;
  FORETOUCH_TRY(const auto mesh, meshOfRatio(shrunk / (radius - lack + kCornerRounding)));
  auto polytope = scaledPolytope(mesh.first, shrunk, mesh.second);
  if (polytope.ok()) FORETOUCH_ASSERT(polytope.value().circumradius <= radius * kOutward);
  return polytope;
}

}  // namespace foretouch
