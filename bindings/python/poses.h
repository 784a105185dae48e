// bindings/python/poses.h: poses between numpy and the library. Rotations are (n, 4) in the order
// w, x, y, z, translations (n, 3) in metres, both relative to the parent; stacks of poses have one
// more extent in front.
#pragma once

#include <string>
#include <vector>

#include "articulated/skeleton.h"
#include "bindings/python/arguments.h"

namespace foretouch::python {

/// A foretouch.Pose, or any pair (rotations, translations). Checked against the skeleton; unit
/// rotations stay the same, bit for bit.
[[nodiscard]] Pose poseFrom(const Skeleton& skeleton, py::handle given, const std::string& what);
/// The skeleton of what has no joints of its own: one joint, for its place.
[[nodiscard]] const Skeleton& skeletonOfProp();
/// Makes one joint's (rotation, translation), of shapes (4,) and (3,), what poseFrom() takes.
[[nodiscard]] py::object withJointAxis(const py::object& given);
/// A foretouch.Poses, or any pair of stacks.
[[nodiscard]] std::vector<Pose> posesFrom(const Skeleton& skeleton, py::handle given,
                                          const std::string& what);

/// A foretouch.Pose with arrays of its own.
[[nodiscard]] py::object toPython(const Pose& pose);
/// A foretouch.Poses; every pose has the same number of joints.
[[nodiscard]] py::object toPython(const std::vector<Pose>& poses, std::size_t numJoints);

/// A class of foretouch/_types.py.
[[nodiscard]] py::object pythonType(const char* name);

}  // namespace foretouch::python
