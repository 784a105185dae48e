// assets/human_bones.h: the bones of a humanoid by the names that VRM has for them (vrm-c,
// "VRMC_vrm-1.0": "humanoid"), and the names of the same bones in other schemes. Not installed.
#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "articulated/skeleton.h"

namespace foretouch {

/// Is it one of VRM 1.0's 55: "leftUpperArm" and so on?
[[nodiscard]] bool isHumanBone(std::string_view name);

/// VRM 1.0 moved the names of the thumb's bones down by one: what VRM 0.x and Unity call proximal
/// ("leftThumbProximal") is its metacarpal. Other names stay.
[[nodiscard]] std::string thumbOf(const std::string& bone);

/// VRM 1.0's name of a bone of Unity's HumanBodyBones, which VMC uses: "LeftThumbProximal" is
/// "leftThumbMetacarpal". For another text, something that is not a bone.
[[nodiscard]] std::string humanBoneOfUnity(std::string_view name);

/// What VRM 1.0 requires of every avatar.
inline constexpr std::array<std::string_view, 15> kRequiredHumanBones{
    "hips",          "spine",         "head",          "leftUpperArm", "rightUpperArm",
    "leftLowerArm",  "rightLowerArm", "leftHand",      "rightHand",    "leftUpperLeg",
    "rightUpperLeg", "leftLowerLeg",  "rightLowerLeg", "leftFoot",     "rightFoot"};

/// Does it have a joint of every name in kRequiredHumanBones? Such a skeleton is made of a VRM
/// avatar: its joints are called by their part of the body, and other names say nothing about it.
[[nodiscard]] bool isHumanoid(const Skeleton& skeleton);

/// The joints that are human bones, by VRM's names: by these names themselves, or those of
/// Unity and VMC, MotionBuilder and Mixamo ("LeftForeArm"), Bandai ("LowerArm_L") or Biovision
/// ("LeftElbow"), Xsens ("RightForeArm" with "Pelvis"), CMU in ASF ("lhumerus") or SMPL
/// ("left_elbow"), in any case and behind any namespace ("mixamorig:"). Only one scheme counts: the
/// first by which hips, head, arms, hands, legs and feet are all there; empty if there is none.
[[nodiscard]] std::map<std::string_view, JointId> humanBonesOf(const Skeleton& skeleton);

}  // namespace foretouch
