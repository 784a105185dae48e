// assets/avatar/humanoid_rest.h: how a humanoid stands at rest. Not installed.
#pragma once

#include <array>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "articulated/skeleton.h"
#include "lss/index.h"

namespace foretouch {

/// A T-pose is drawn by hand: arms that slope by less are taken as level. An A-pose has 35 degrees
/// and more. Twice as much would take one for the other.
inline constexpr double kMostTPoseTiltDeg = 30.0;

/// Both ends of the bones whose direction at rest says which pose it is.
inline constexpr std::array<std::pair<std::string_view, std::string_view>, 8> kRestingLimbs{
    {{"leftUpperArm", "leftLowerArm"},
     {"leftLowerArm", "leftHand"},
     {"rightUpperArm", "rightLowerArm"},
     {"rightLowerArm", "rightHand"},
     {"leftUpperLeg", "leftLowerLeg"},
     {"leftLowerLeg", "leftFoot"},
     {"rightUpperLeg", "rightLowerLeg"},
     {"rightLowerLeg", "rightFoot"}}};

[[nodiscard]] double angleDeg(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// The place of every joint in the world.
[[nodiscard]] std::vector<RigidPose> placesIn(const Skeleton& skeleton, const Pose& pose);

/// A skeleton at rest, by its bones.
class HumanoidRest {
 public:
  using Bones = std::map<std::string_view, JointId>;
  /// `bones`: at least those of kRequiredHumanBones.
  HumanoidRest(const Skeleton& skeleton, Bones bones);

  [[nodiscard]] const Bones& bones() const { return bones_; }
  [[nodiscard]] const RigidPose& place(JointId joint) const { return places_[slotOf(joint)]; }
  [[nodiscard]] Eigen::Vector3d between(std::string_view from, std::string_view to) const;
  /// The length of the left leg (m).
  [[nodiscard]] double legLength() const;
  /// The body's left, up and front; zero if it does not stand along the axes.
  [[nodiscard]] Eigen::Matrix3d frame() const;
  /// The limb that is farthest from a T-pose, by the joint where it begins. Precondition: frame()
  /// is not zero.
  struct Tilt {
    double tiltDeg = 0.0;
    JointId joint = 0;
  };
  [[nodiscard]] Tilt farthestFromTPose() const;

 private:
  [[nodiscard]] const Eigen::Vector3d& at(std::string_view bone) const {
    return place(bones_.at(bone)).translation;
  }
  Bones bones_;
  std::vector<RigidPose> places_;
};

}  // namespace foretouch
