#pragma once

#include <Eigen/Geometry>

namespace foretouch {

/// The least turn of a direction to another one. Where they are opposite, its axis is one that is
/// across both. To the last bit Quaternion::FromTwoVectors(), which takes a compiler seven seconds
/// wherever it is called.
Eigen::Quaterniond turnBetween(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

}  // namespace foretouch
