// lss/triangle_separation.h: proven bounds on the distance of two triangles, rounding included: the
// same two facts as lss/separation.h, with three points on one side. Metres.
#pragma once

#include <algorithm>
#include <array>

#include <Eigen/Core>

#include "lss/triangle.h"

namespace foretouch {

/// The proof for two triangles at one instant. For every point x = sum w_i v_i of `one` and every
/// point y of `other`, nhat.(x - y) >= sum w_i clearance_i, with |nhat| <= 1; so their distance is
/// at least the least clearance, and at most `upper`.
struct TriangleSeparation {
  Eigen::Vector3d nhat = Eigen::Vector3d::Zero();  ///< From `other` towards `one`.
  std::array<double, 3> clearance{};               ///< Rounded down.
  double upper = 0.0;                              ///< Rounded up.
  Eigen::Vector3d onOne = Eigen::Vector3d::Zero(), onOther = Eigen::Vector3d::Zero();
  /// onOne - onOther before the far origin is added back, and its length; 0, up to rounding, if the
  /// triangles meet.
  Eigen::Vector3d difference = Eigen::Vector3d::Zero();
  double distance = 0.0;
  Eigen::Vector3d featureNormal = Eigen::Vector3d::Zero();  ///< As ClosestPoints::featureNormal.

  [[nodiscard]] double lower() const {
    return std::min(clearance[0], std::min(clearance[1], clearance[2]));
  }
};

/// Triangles without area are legal. All coordinates finite, below 1e100.
[[nodiscard]] TriangleSeparation triangleSeparation(const Triangle& one, const Triangle& other);

}  // namespace foretouch
