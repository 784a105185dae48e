// bindings/python/clip.cpp: foretouch.Clip.
#include "articulated/clip.h"

#include <memory>
#include <pybind11/stl.h>

#include "assets/avatar/joint_match.h"
#include "assets/bvh/bvh_reader.h"
#include "bindings/python/arguments.h"
#include "bindings/python/bindings.h"
#include "bindings/python/poses.h"

namespace foretouch::python {
namespace {

using SharedClip = std::shared_ptr<Clip>;

SharedClip loadClip(const py::object& file, const py::object& scale) {
  const std::string from = path(file, "path");
  const BvhOptions options{number(scale, "scale")};
  const py::gil_scoped_release free;
  return std::make_shared<Clip>(valueOf(readBvhFile(from, options), from));
}

JointNameMap mapFrom(const py::object& given) {
  JointNameMap names;
  if (given.is_none()) return names;
  for (const auto& [avatar, clip] : mapping(given, "joint_map")) {
    names[text(avatar, "joint_map")] = text(clip, "joint_map");
  }
  return names;
}

Placement placementFrom(const py::object& up, const py::object& origin, const py::object& yawDeg) {
  static constexpr std::array<std::pair<const char*, bool>, 2> kIsUpZ{{{"y", false}, {"z", true}}};
  Placement placement;
  placement.motionUpZ = oneOf(up, "up", kIsUpZ);
  placement.origin = point(origin, "origin");
  placement.yawDeg = number(yawDeg, "yaw_deg");
  return placement;
}

py::object poses(const Clip& clip, const Avatar& avatar, const py::object& jointMap,
                 const py::object& up, const py::object& origin, const py::object& yawDeg) {
  const Placement placement = placementFrom(up, origin, yawDeg);
  const JointNameMap names = mapFrom(jointMap);
  const Skeleton& skeleton = avatar.skeleton();
  std::vector<Pose> found;
  {
    const py::gil_scoped_release free;
    const JointMatch match = valueOf(matchJoints(skeleton, clip.skeleton, names), "Clip.poses");
    for (std::size_t frame = 0; frame < clip.frames.size(); ++frame) {
      Pose pose = placed(skeleton, poseOfAvatar(skeleton, clip, match, frame), placement);
      found.push_back(
          valueOf(validatedPose(skeleton, std::move(pose)), "frame " + std::to_string(frame)));
    }
  }
  return toPython(found, std::size_t(skeleton.numJoints()));
}

py::object match(const Clip& clip, const Avatar& avatar, const py::object& jointMap) {
  const JointMatch found =
      valueOf(matchJoints(avatar.skeleton(), clip.skeleton, mapFrom(jointMap)), "Clip.match");
  return pythonType("JointMatch")(found.clipJointOf, found.unmatchedAvatar, found.unmatchedClip);
}

std::vector<std::string> jointNames(const Clip& clip) {
  std::vector<std::string> names;
  for (JointId j = 0; j < clip.skeleton.numJoints(); ++j) names.push_back(clip.skeleton.name(j));
  return names;
}

std::string representClip(const Clip& clip) {
  return "<foretouch.Clip of " + std::to_string(clip.frames.size()) + " frames, " +
         std::to_string(clip.skeleton.numJoints()) + " joints, " +
         std::to_string(clip.durationS()) + " s>";
}

}  // namespace

void bindClip(py::module_& module) {
  const py::object origin = py::make_tuple(0.0, 0.0, 0.0);
  py::class_<Clip, SharedClip>(module, "Clip", "A mocap clip: poses at a fixed rate. Immutable.")
      .def_static("load", &loadClip, py::arg("path"), py::arg("scale") = 1.0,
                  "A BVH file. scale: metres per unit (0.01 for centimetres).")
      .def("poses", &poses, py::arg("avatar"), py::kw_only(), py::arg("joint_map") = py::none(),
           py::arg("up") = "y", py::arg("origin") = origin, py::arg("yaw_deg") = 0.0,
           "Every frame as a pose of the avatar: Poses. Joints match by name, or by joint_map\n"
           "(avatar's name: clip's name); those without data keep their rest values. up: the\n"
           "clip's axis; then a turn by yaw_deg about +Y, then the way to origin.")
      .def("match", &match, py::arg("avatar"), py::kw_only(), py::arg("joint_map") = py::none(),
           "Which joint drives which, and what is left over: JointMatch.")
      .def_property_readonly("frame_time_s", [](const Clip& clip) { return clip.frameTimeS; })
      .def_property_readonly("duration_s", &Clip::durationS)
      .def_property_readonly("joint_names", &jointNames)
      .def_property_readonly(
          "notes", [](const Clip& clip) { return clip.notes; },
          "What the reader tolerated, a sentence each.")
      .def("__len__", [](const Clip& clip) { return clip.frames.size(); })
      .def("__repr__", &representClip);
}

}  // namespace foretouch::python
