// examples/dancer_body.cpp: see the header.
#include "examples/dancer_body.h"

#include <string>
#include <utility>
#include <vector>

namespace foretouch::examples {
namespace {

using Eigen::Vector3d;

/// A joint of the trunk or of the left side: its parent, its offset there, and its link's LSS; the
/// trunk is wider than deep, so most of its links have a second LSS, mirrored.
struct Part {
  const char* name;
  std::int32_t parent;
  Vector3d offset, a, b;
  double radius;
  bool paired = false;
};

/// The right side is the mirror image in the plane x = 0.
Vector3d mirrored(const Vector3d& p) {
  return {-p.x(), p.y(), p.z()};
}

const std::vector<Part>& trunk() {
  static const std::vector<Part> kTrunk = {
      {"Hips", kNoParent, {0, 0.94, 0}, {0.075, -0.05, 0}, {0.065, 0.06, 0}, 0.10, true},
      {"Spine", kHips, {0, 0.10, 0}, {0.06, 0, 0}, {0.055, 0.12, 0}, 0.095, true},
      {"Spine1", kSpine, {0, 0.13, 0}, {0.055, 0, 0}, {0.065, 0.12, 0}, 0.10, true},
      {"Spine2", kSpine1, {0, 0.13, 0}, {0.065, 0, 0}, {0.085, 0.13, 0}, 0.095, true},
      {"Neck", kSpine2, {0, 0.22, 0}, {0, -0.01, 0}, {0, 0.08, 0.01}, 0.055},
      {"Head", kNeck, {0, 0.10, 0.01}, {0, 0.05, 0.01}, {0, 0.13, 0.02}, 0.088}};
  return kTrunk;
}

const std::vector<Part>& leftArm() {
  static const std::vector<Part> kArm = {
      {"Shoulder", kSpine2, {0.03, 0.16, 0}, {0.02, 0, 0}, {0.13, 0, 0}, 0.06},
      {"Arm", kLeftShoulder, {0.14, 0, 0}, {0, 0, 0}, {0.27, 0, 0}, 0.048},
      {"ForeArm", kLeftArm, {0.28, 0, 0}, {0, 0, 0}, {0.24, 0, 0}, 0.038},
      {"Hand", kLeftForeArm, {0.25, 0, 0}, {0.015, 0, -0.01}, {0.075, 0, 0.005}, 0.035},
      {"Fingers", kLeftHand, {0.095, 0, 0}, {0, 0, 0}, {0.075, 0, 0}, 0.018},
      {"Thumb", kLeftHand, {0.035, -0.01, 0.035}, {0, 0, 0}, {0.035, -0.01, 0.03}, 0.013}};
  return kArm;
}

const std::vector<Part>& leftLeg() {
  static const std::vector<Part> kLeg = {
      {"UpLeg", kHips, {0.09, -0.06, 0}, {0.005, -0.02, 0}, {0, -0.40, 0}, 0.075},
      {"Leg", kLeftUpLeg, {0, -0.42, 0}, {0, 0, 0}, {0, -0.38, 0}, 0.052},
      {"Foot", kLeftLeg, {0, -0.42, 0}, {0, -0.05, -0.035}, {0, -0.055, 0.115}, 0.035},
      {"ToeBase", kLeftFoot, {0, -0.06, 0.13}, {0, 0, 0}, {0, 0, 0.055}, 0.03}};
  return kLeg;
}

struct BodyLists {
  RawSkeleton skeleton;
  std::vector<std::vector<Lss>> lss;
};

void addPart(BodyLists& body, const std::string& name, const Part& part) {
  body.skeleton.joints.push_back({name, part.parent, part.offset, Quaternion::Identity()});
  body.lss.push_back({{part.a, part.b, part.radius}});
  if (part.paired) {
    body.lss.back().push_back({mirrored(part.a), mirrored(part.b), part.radius});
  }
}

void addLimb(BodyLists& body, const std::vector<Part>& left) {
  const auto first = static_cast<std::int32_t>(body.lss.size());
  for (const Part& part : left) {
    addPart(body, std::string("Left") + part.name, part);
  }
  for (Part part : left) {
    // A parent inside the limb moves with it to the other side; one of the trunk stays.
    part.parent += part.parent >= first ? static_cast<std::int32_t>(left.size()) : 0;
    part.offset = mirrored(part.offset);
    part.a = mirrored(part.a);
    part.b = mirrored(part.b);
    addPart(body, std::string("Right") + part.name, part);
  }
}

}  // namespace

Result<Avatar> dancerAvatar() {
  BodyLists body;
  for (const Part& part : trunk()) {
    addPart(body, part.name, part);
  }
  addLimb(body, leftArm());
  addLimb(body, leftLeg());
  auto skeleton = Skeleton::build(body.skeleton);
  if (!skeleton.ok()) {
    return skeleton.error();
  }
  return Avatar::build(std::move(skeleton).value(), std::move(body.lss));
}

}  // namespace foretouch::examples
