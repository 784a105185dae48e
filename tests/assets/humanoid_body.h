// tests/assets/humanoid_body.h: a humanoid of the bones that VRM requires, in a T-pose.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "articulated/skeleton.h"
#include "tests/support/random_geometry.h"

namespace foretouch::test {

struct Part {
  std::string bone, parent, mixamo, biovision;
  Eigen::Vector3d place;  ///< In a T-pose that faces +z.
};

inline std::vector<Part> parts() {
  std::vector<Part> all{{"hips", "", "mixamorig:Hips", "Hips", {0, 1, 0}},
                        {"spine", "hips", "mixamorig:Spine", "Chest", {0, 1.2, 0}},
                        {"head", "spine", "mixamorig:Head", "Head", {0, 1.6, 0}}};
  for (const std::string side : {"left", "right"}) {
    const std::string Side = side == "left" ? "Left" : "Right", rig = "mixamorig:" + Side;
    const double s = side == "left" ? 1 : -1;
    const auto add = [&](const char* bone, const std::string& parent, const char* mixamo,
                         const char* biovision, const Eigen::Vector3d& place) {
      all.push_back({side + bone, parent, rig + mixamo, Side + biovision, place});
    };
    add("UpperArm", "spine", "Arm", "Shoulder", {s * 0.2, 1.4, 0});
    add("LowerArm", side + "UpperArm", "ForeArm", "Elbow", {s * 0.5, 1.4, 0});
    add("Hand", side + "LowerArm", "Hand", "Wrist", {s * 0.75, 1.4, 0});
    add("UpperLeg", "hips", "UpLeg", "Hip", {s * 0.1, 0.9, 0});
    add("LowerLeg", side + "UpperLeg", "Leg", "Knee", {s * 0.1, 0.5, 0});
    add("Foot", side + "LowerLeg", "Foot", "Ankle", {s * 0.1, 0.1, 0});
  }
  return all;
}

/// `turned`: joints have frames of their own at rest; `world`: how the whole body stands.
inline Skeleton body(std::string Part::*name, const Eigen::Matrix3d& world, bool turned,
                     Random& random) {
  RawSkeleton raw;
  std::map<std::string, JointId> idOf;
  std::vector<Eigen::Isometry3d> frames;
  for (const Part& part : parts()) {
    Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
    frame.translation() = world * part.place;
    if (turned) frame.linear() = Quaternion(random.rotation()).toRotationMatrix();
    RawJoint joint;
    joint.name = part.*name;
    Eigen::Isometry3d local = frame;
    if (!part.parent.empty()) {
      joint.parent = idOf.at(part.parent);
      local = frames[static_cast<std::size_t>(joint.parent)].inverse() * frame;
    }
    joint.offset = local.translation();
    joint.rotation = Quaternion(Eigen::Matrix3d(local.linear())).normalized();
    idOf[part.bone] = static_cast<JointId>(raw.joints.size());
    frames.push_back(frame);
    raw.joints.push_back(joint);
  }
  return Skeleton::build(raw).value();
}

}  // namespace foretouch::test
