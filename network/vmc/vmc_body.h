// network/vmc/vmc_body.h: how VMC's bones move an avatar: joints by their part of the body, Unity's
// left-handed frame into ours, and the root's place into that of the hips. Not installed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "network/wire/messages.h"

namespace foretouch {

/// What the rotations of a sender's bones are relative to.
enum class VmcBones : std::uint8_t {
  Original,    ///< As in the sender's model, which is the avatar's: what the protocol says.
  Normalized,  ///< Bones that a T-pose does not turn, in any model (VRM 1.0's control rig).
};

/// What one sender says of one instant, in Unity's axes.
struct VmcFrame {
  RigidPose root;
  /// By VmcBody::boneOf(); relative to the parent bone. Meaningless where it `has` none.
  std::vector<RigidPose> bones;
  std::vector<bool> has;
  std::optional<double> time;  ///< The sender's clock (s).
  bool isTracked = true;       ///< The sender says that its tracking works.
  bool isRootOld = false;      ///< The root is that of an earlier frame.
  bool isWhole = false;        ///< All of it came in one datagram.
  std::int64_t receiveUtimeUs = 0;
};

class VmcBody {
 public:
  /// Errors (Mismatch): an avatar that is not a humanoid, that does not stand along the axes, or
  /// does not rest in a T-pose (only for Normalized).
  static Result<VmcBody> make(std::int32_t avatar, const Skeleton& skeleton, VmcBones bones);

  [[nodiscard]] std::int32_t avatar() const { return avatar_; }
  /// The number of a bone by Unity's name; nothing if the avatar has no such part.
  [[nodiscard]] std::optional<std::size_t> boneOf(std::string_view unityName) const;
  [[nodiscard]] std::size_t numBones() const { return joints_.size(); }

  /// The avatar's joints that are of these bones, or carry the hips, as a sender's skeleton.
  [[nodiscard]] RawSkeleton skeletonOf(const std::vector<bool>& bones) const;
  /// Replaces joints and translations of `message`: those of the bones in `of` that the frame has,
  /// by their places in skeletonOf(of). Bones that are not rotations are listed as not valid.
  void fill(const std::vector<bool>& of, const VmcFrame& frame, PoseMessage& message) const;

 private:
  VmcBody(std::int32_t avatar, const Skeleton& skeleton) : avatar_(avatar), skeleton_(skeleton) {}
  Result<Done> settle(VmcBones bones);
  [[nodiscard]] std::vector<bool> jointsOf(const std::vector<bool>& bones) const;
  [[nodiscard]] RigidPose placeOf(const RigidPose& root) const;
  /// What a message says of a joint.
  struct Said {
    RigidPose pose;
    std::uint8_t flags = 0;
    bool isPlaced = false;  ///< With a translation of its own.
  };
  [[nodiscard]] Said saidOf(JointId joint, std::optional<std::size_t> bone,
                            const VmcFrame& frame) const;

  std::int32_t avatar_ = 0;
  Skeleton skeleton_;
  std::unordered_map<std::string, std::size_t> boneOf_;  // by VRM 1.0's name
  std::vector<JointId> joints_;                          // per bone, in the avatar's order
  std::vector<JointId> carriers_;                        // of the hips, roots first; may be none
  std::size_t hips_ = 0;                                 // the bone
  // What Unity's place of the hips is relative to, if it is not their parent.
  Eigen::Vector3d hipsBase_ = Eigen::Vector3d::Zero();
  // A vector of Unity in the axes of the avatar at rest; mirrors.
  Eigen::Matrix3d fromUnity_ = Eigen::Matrix3d::Identity();
  std::vector<Quaternion> before_, after_;  // per bone: what stands around Unity's rotation
};

}  // namespace foretouch
