#pragma once

#include <Eigen/Geometry>

namespace foretouch {

/// The least turn of a direction to another one. Where they are opposite, its axis is one that is
/// across both. Equal to Quaternion::FromTwoVectors() to the last bit, but each call of that one
/// takes a compiler seven seconds.
Eigen::Quaterniond turnBetween(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

}  // namespace foretouch
