// lss/hull.h: the convex hull of two or three points: an LSS's axis, or a triangle. Metres.
#pragma once

#include <array>

#include <Eigen/Core>

#include "lss/triangle.h"

namespace foretouch {

/// Points that coincide are legal: a segment without length is a point.
struct Hull {
  std::array<Eigen::Vector3d, 3> points;  ///< The first `count` mean something.
  int count = 2;                          ///< 2 or 3.

  [[nodiscard]] static Hull segment(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return {{a, b, b}, 2};
  }
  [[nodiscard]] static Hull of(const Triangle& triangle) { return {triangle.vertices, 3}; }
  [[nodiscard]] Triangle triangle() const { return {points}; }
};

}  // namespace foretouch
