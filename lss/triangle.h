// lss/triangle.h: a two-sided triangle of a scene or of a link's surface. Metres.
#pragma once

#include <algorithm>
#include <array>

#include <Eigen/Core>

namespace foretouch {

/// The closed convex hull of three points. Zero area (a segment or a point) is legal.
/// Two-sided: the order of the vertices carries no meaning.
struct Triangle {
  std::array<Eigen::Vector3d, 3> vertices;
};

/// True if it has no NaN and no infinity.
[[nodiscard]] inline bool isFinite(const Triangle& triangle) {
  return std::all_of(triangle.vertices.begin(), triangle.vertices.end(),
                     [](const Eigen::Vector3d& v) { return v.allFinite(); });
}

}  // namespace foretouch
