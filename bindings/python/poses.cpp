#include "bindings/python/poses.h"

#include <utility>

namespace foretouch::python {
namespace {

/// The two arrays of a pose, or of many.
std::pair<py::object, py::object> halves(py::handle given, const std::string& what) {
  if (py::isinstance<py::tuple>(given) || py::isinstance<py::list>(given)) {
    const auto pair = py::reinterpret_borrow<py::sequence>(given);
    if (pair.size() == 2) return {pair[0], pair[1]};
  } else if (py::hasattr(given, "rotations") && py::hasattr(given, "translations")) {
    return {given.attr("rotations"), given.attr("translations")};
  }
  refuse(ErrorCode::Mismatch, what, "expected a Pose, or a pair of rotations and translations");
}

/// `rotations` and `translations` point to those of the pose's first joint.
Pose gathered(const double* rotations, const double* translations, std::size_t joints) {
  Pose pose;
  pose.rotations.reserve(joints);
  pose.translations.reserve(joints);
  for (std::size_t j = 0; j < joints; ++j) {
    const double* const q = rotations + 4 * j;
    const double* const p = translations + 3 * j;
    pose.rotations.emplace_back(q[0], q[1], q[2], q[3]);
    pose.translations.emplace_back(p[0], p[1], p[2]);
  }
  return pose;
}

void scatter(const Pose& pose, double* rotations, double* translations) {
  for (const Quaternion& q : pose.rotations) {
    for (const double part : {q.w(), q.x(), q.y(), q.z()}) *rotations++ = part;
  }
  for (const Eigen::Vector3d& p : pose.translations) {
    for (const double part : {p.x(), p.y(), p.z()}) *translations++ = part;
  }
}

}  // namespace

const Skeleton& skeletonOfProp() {
  static const Skeleton one = [] {
    RawSkeleton raw;
    raw.joints = {{"prop", kNoParent, Eigen::Vector3d::Zero(), Quaternion::Identity()}};
    return Skeleton::build(raw).value();
  }();
  return one;
}

py::object withJointAxis(const py::object& given) {
  const auto atLeast2d = py::module_::import("numpy").attr("atleast_2d");
  if (!py::isinstance<py::tuple>(given) && !py::isinstance<py::list>(given)) return given;
  const auto pair = py::reinterpret_borrow<py::sequence>(given);
  if (pair.size() != 2) return given;
  try {
    return py::make_tuple(atLeast2d(pair[0]), atLeast2d(pair[1]));
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_ValueError) && !error.matches(PyExc_TypeError)) throw;
  }
  return given;  // refused where it is read
}

Pose poseFrom(const Skeleton& skeleton, py::handle given, const std::string& what) {
  const py::ssize_t joints = skeleton.numJoints();
  const auto [rotations, translations] = halves(given, what);
  const Numbers q = numbers(rotations, what + ".rotations", {joints, 4});
  const Numbers p = numbers(translations, what + ".translations", {joints, 3});
  return valueOf(validatedPose(skeleton, gathered(q.data(), p.data(), std::size_t(joints))), what);
}

std::vector<Pose> posesFrom(const Skeleton& skeleton, py::handle given, const std::string& what) {
  const py::ssize_t joints = skeleton.numJoints();
  const auto [rotations, translations] = halves(given, what);
  const Numbers q = numbers(rotations, what + ".rotations", {kAny, joints, 4});
  const Numbers p = numbers(translations, what + ".translations", {q.shape(0), joints, 3});
  std::vector<Pose> poses;
  poses.reserve(static_cast<std::size_t>(q.shape(0)));
  for (py::ssize_t i = 0; i < q.shape(0); ++i) {
    Pose pose = gathered(q.data(i), p.data(i), std::size_t(joints));
    poses.push_back(
        valueOf(validatedPose(skeleton, std::move(pose)), what + "[" + std::to_string(i) + "]"));
  }
  return poses;
}

py::object toPython(const Pose& pose) {
  const auto joints = static_cast<py::ssize_t>(pose.rotations.size());
  Numbers rotations(Shape{joints, 4});
  Numbers translations(Shape{joints, 3});
  scatter(pose, rotations.mutable_data(), translations.mutable_data());
  return pythonType("Pose")(rotations, translations);
}

py::object toPython(const std::vector<Pose>& poses, std::size_t numJoints) {
  const auto count = static_cast<py::ssize_t>(poses.size());
  const auto joints = static_cast<py::ssize_t>(numJoints);
  Numbers rotations(Shape{count, joints, 4});
  Numbers translations(Shape{count, joints, 3});
  for (std::size_t i = 0; i < poses.size(); ++i) {
    scatter(poses[i], rotations.mutable_data() + i * numJoints * 4,
            translations.mutable_data() + i * numJoints * 3);
  }
  return pythonType("Poses")(rotations, translations);
}

py::object pythonType(const char* name) {
  return py::module_::import("foretouch._types").attr(name);
}

}  // namespace foretouch::python
