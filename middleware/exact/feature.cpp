#include "middleware/exact/feature.h"

#include <algorithm>

#include "lss/fit.h"

namespace foretouch {
namespace {

/// A witness point on an edge is off it by a few roundings; a share of the triangle's size.
constexpr double kOnFeature = 1e-9;

}  // namespace

FeaturePlace featurePlaceAt(const Triangle& triangle, const Eigen::Vector3d& point) {
  const auto& v = triangle.vertices;
  const double size = std::max({(v[1] - v[0]).norm(), (v[2] - v[1]).norm(), (v[0] - v[2]).norm()});
  const auto near = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return axisDistance(Lss{a, b, 0.0}, point) <= kOnFeature * size;
  };
  for (std::size_t i = 0; i < 3; ++i) {
    if (near(v[i], v[i])) return {FeatureKind::Vertex, static_cast<int>(i)};
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (near(v[i], v[(i + 1) % 3])) return {FeatureKind::Edge, static_cast<int>(i)};
  }
  return {FeatureKind::Face, 0};
}

FeatureKind featureAt(const Triangle& triangle, const Eigen::Vector3d& point) {
  return featurePlaceAt(triangle, point).kind;
}

const char* toString(FeatureKind kind) {
  switch (kind) {
    case FeatureKind::Vertex: return "vertex";
    case FeatureKind::Edge: return "edge";
    case FeatureKind::Face: return "face";
  }
  return "face";
}

}  // namespace foretouch
