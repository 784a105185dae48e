// middleware/scene/box_triangles.h: a box as triangles: one way for world files, triggers and every
// language, so that all of them answer alike to the last bit.
#pragma once

#include <string>

#include <Eigen/Core>

#include "middleware/scene/raw_scene.h"

namespace foretouch::internal {

/// The twelve triangles between two corners (m), one object of this name; seen from outside they
/// are counterclockwise.
[[nodiscard]] RawScene boxTriangles(const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                                    std::string name);

}  // namespace foretouch::internal
