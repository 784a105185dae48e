// bindings/python/clip.cpp: foretouch.Clip.
#include "articulated/clip.h"

#include <array>
#include <cstdio>
#include <memory>
#include <pybind11/stl.h>

#include "assets/avatar/joint_match.h"
#include "assets/clip/clip_file.h"
#include "bindings/python/arguments.h"
#include "bindings/python/bindings.h"
#include "bindings/python/importer_place.h"
#include "bindings/python/poses.h"

namespace foretouch::python {
namespace {

using SharedClip = std::shared_ptr<Clip>;

/// Refuses what only another kind of file can use, which would silently have no effect.
void refuseUnused(ClipFormat format, const ClipFileOptions& options) {
  if (format != ClipFormat::Model && !options.animation.empty()) {
    refuse(ErrorCode::Mismatch, "animation", "expected none: only models hold several animations");
  }
  if (format != ClipFormat::JointTable && !options.robot.empty()) {
    refuse(ErrorCode::Mismatch, "robot",
           "expected none: it is for tables of joint positions (.csv)");
  }
  if (format == ClipFormat::JointTable && options.robot.empty()) {
    refuse(ErrorCode::Mismatch, "robot", "expected the URDF whose joints the table is about");
  }
  if (format != ClipFormat::Acclaim && !options.skeleton.empty()) {
    refuse(ErrorCode::Mismatch, "skeleton",
           "expected none: only an .amc has one in another file, its .asf");
  }
  if (format != ClipFormat::Acclaim && format != ClipFormat::WebXr && options.table.rateHz) {
    refuse(ErrorCode::Mismatch, "row_rate_hz",
           "expected none: it is for an .amc, or a session of WebXR");
  }
  if (format != ClipFormat::Model && options.import.up) {
    refuse(ErrorCode::Mismatch, "up",
           "expected none: Clip.poses(up=) turns a BVH clip, and robots stand on z");
  }
}

SharedClip loadClip(const Shown<shown::Path>& file, const Shown<shown::Number>& scale,
                    const Shown<shown::Text>& up, const Shown<shown::Text>& animation,
                    const Shown<shown::Number>& rateHz, const Shown<shown::Path>& robot,
                    const Shown<shown::Path>& skeleton, const Shown<shown::Number>& rowRateHz,
                    const Shown<shown::Path>& importer) {
  const std::string from = path(file, "path");
  ClipFileOptions options;
  if (!scale.is_none()) options.import.scale = number(scale, "scale");
  if (!up.is_none()) options.import.up = upAxis(up);
  options.import.importer = importerPlace(importer);
  options.animation = text(animation, "animation");
  options.rateHz = number(rateHz, "rate_hz");
  if (!robot.is_none()) options.robot = path(robot, "robot");
  if (!skeleton.is_none()) options.skeleton = path(skeleton, "skeleton");
  if (!rowRateHz.is_none()) options.table.rateHz = number(rowRateHz, "row_rate_hz");
  refuseUnused(clipFormatOf(from), options);
  const py::gil_scoped_release free;
  return std::make_shared<Clip>(valueOf(readClipFile(from, options), from).clip);
}

JointNameMap mapFrom(const py::object& given) {
  JointNameMap names;
  if (given.is_none()) return names;
  for (const auto& [avatar, clip] : mapping(given, "joint_map")) {
    names[text(avatar, "joint_map")] = text(clip, "joint_map");
  }
  return names;
}

Placement placementFrom(const Shown<shown::Text>& up, const Shown<shown::Array>& origin,
                        const Shown<shown::Number>& yawDeg) {
  Placement placement;
  placement.motionUpZ = upAxis(up) == UpAxis::Z;
  placement.origin = point(origin, "origin");
  placement.yawDeg = number(yawDeg, "yaw_deg");
  return placement;
}

/// A warning as Python gives them: on stderr, once for each place, and an exception for those who
/// want it so.
void warnOfUnit(const Avatar& avatar, const Clip& clip, const JointMatch& match) {
  const auto ratio = suspiciousSize(avatar.skeleton(), clip.skeleton, match);
  if (!ratio) return;
  std::array<char, 160> words{};
  std::snprintf(
      words.data(), words.size(),
      "the clip's bones are %.4g times as long as the avatar's: with a scale=%.4g times as "
      "large, Clip.load() makes them equal",
      *ratio, 1.0 / *ratio);
  warn(words.data());
}

Shown<shown::Poses> poses(const Clip& clip, const Avatar& avatar,
                          const Shown<shown::Mapping>& jointMap, const Shown<shown::Text>& up,
                          const Shown<shown::Array>& origin, const Shown<shown::Number>& yawDeg) {
  const Placement placement = placementFrom(up, origin, yawDeg);
  const JointNameMap names = mapFrom(jointMap);
  const Skeleton& skeleton = avatar.skeleton();
  const JointMatch match = valueOf(matchJoints(skeleton, clip.skeleton, names), "Clip.poses");
  warnOfUnit(avatar, clip, match);
  std::vector<Pose> found;
  {
    const py::gil_scoped_release free;
    for (std::size_t frame = 0; frame < clip.frames.size(); ++frame) {
      Pose pose = placed(skeleton, poseOfAvatar(skeleton, clip, match, frame), placement);
      found.push_back(
          valueOf(validatedPose(skeleton, std::move(pose)), "frame " + std::to_string(frame)));
    }
  }
  return toPython(found, std::size_t(skeleton.numJoints()));
}

Shown<shown::JointMatch> match(const Clip& clip, const Avatar& avatar,
                               const Shown<shown::Mapping>& jointMap) {
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
  const ClipFileOptions usual;
  py::class_<Clip, SharedClip>(module, "Clip",
                               "A clip: poses at a fixed rate, of a skeleton. Immutable.")
      .def_static(
          "load", &loadClip, py::arg("path"), py::arg("scale") = py::none(), py::kw_only(),
          py::arg("up") = py::none(), py::arg("animation") = "", py::arg("rate_hz") = usual.rateHz,
          py::arg("robot") = py::none(), py::arg("skeleton") = py::none(),
          py::arg("row_rate_hz") = py::none(), py::arg("importer") = py::none(),
          "A BVH file; an animated model (.glb, .gltf, .fbx, .dae, .x): up is its axis, animation\n"
          "its animation's name or number ('': the first), rate_hz how often that is sampled; or\n"
          "a table of the joint positions (.csv) of the URDF robot; Acclaim's .amc, about the "
          ".asf\n"
          "skeleton (None: the one beside it); Xsens' .mvnx; or a session of WebXR (.json).\n"
          "row_rate_hz: poses a second of an .amc or a session. scale: metres per unit of the "
          "file\n"
          "(0.01 for centimetres).")
      .def("poses", &poses, py::arg("avatar"), py::kw_only(), py::arg("joint_map") = py::none(),
           py::arg("up") = "y", py::arg("origin") = origin, py::arg("yaw_deg") = 0.0,
           "Every frame as a pose of the avatar: Poses. Joints match by name, or by joint_map\n"
           "(avatar's name: clip's name); those without data keep their rest values. up: the\n"
           "axis of a BVH clip (a model is turned by Clip.load()); then a turn by yaw_deg about\n"
           "+Y, then the way to origin. Warns if the clip's bones are more than twice as long as\n"
           "the avatar's, or less than half: another unit.")
      .def("match", &match, py::arg("avatar"), py::kw_only(), py::arg("joint_map") = py::none(),
           "Which joint drives which, and what is left over: JointMatch.")
      .def_property_readonly("frame_time_s", [](const Clip& clip) { return clip.frameTimeS; })
      .def_property_readonly(
          "frames_per_row", [](const Clip& clip) { return clip.framesPerRow; },
          "Of a table of joint positions: every so many frames there is one of its rows. Where a\n"
          "joint turns too far for the shorter arc, frames lie between on the line from row to "
          "row.")
      .def_property_readonly("duration_s", &Clip::durationS)
      .def_property_readonly("joint_names", &jointNames)
      .def_property_readonly(
          "notes", [](const Clip& clip) { return clip.notes; },
          "What the reader tolerated, a sentence each.")
      .def("__len__", [](const Clip& clip) { return clip.frames.size(); })
      .def("__repr__", &representClip);
}

}  // namespace foretouch::python
