// middleware/exact/feature.h: which feature of a triangle a witness point lies on.
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "lss/lss.h"

namespace foretouch {

enum class FeatureKind : std::uint8_t { Vertex, Edge, Face };

/// A feature of a triangle: vertex `index`, or edge `index` from there to the next vertex; 0 for
/// the face.
struct FeaturePlace {
  FeatureKind kind;
  int index;
};

/// The vertex, else the edge, within 1e-9 of the triangle's size of `point`; else the face. Metres.
[[nodiscard]] FeaturePlace featurePlaceAt(const Triangle& triangle, const Eigen::Vector3d& point);
[[nodiscard]] FeatureKind featureAt(const Triangle& triangle, const Eigen::Vector3d& point);

/// "vertex", "edge", "face".
[[nodiscard]] const char* toString(FeatureKind kind);

}  // namespace foretouch
