// articulated/skeleton.h: the tree of joints, in its authoring form and in its validated form, and
// a pose of it: the place of every joint at one instant. Lengths in metres, rotations as unit
// quaternions (w, x, y, z). A joint's frame J sits at its articulation; its parent-relative pose
// places J in the parent's frame (the root's: in the world W). The two-form idea follows
// ozz-animation's raw and runtime skeletons (REFERENCES.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "articulated/result.h"
#include "lss/assert.h"
#include "lss/index.h"

namespace foretouch {

/// Unaligned, so that the layout of public structs does not depend on the caller's -m flags.
using Quaternion = Eigen::Quaternion<double, Eigen::DontAlign>;

/// Index of a joint in its Skeleton; of the link that moves with it; of the LSS that bound that
/// link.
using JointId = std::int32_t;
using LinkId = JointId;
inline constexpr JointId kNoParent = -1;

/// Upper limits of a skeleton; larger ones are errors, from any source.
inline constexpr std::int32_t kMaxJoints = 4096;
inline constexpr std::int32_t kMaxChainDepth = 256;
/// Largest magnitude (m) of an offset, a translation or a scene coordinate. Doubles resolve 2 nm
/// there.
inline constexpr double kMaxCoordinate = 1e7;
/// A quaternion's norm may be off by this much (files round to six digits); we renormalise it.
inline constexpr double kMaxQuaternionNormError = 1e-3;
/// Longest name of a joint, in bytes.
inline constexpr std::size_t kMaxNameBytes = 1024;

/// A joint as an author or a file gives it, unchecked.
struct RawJoint {
  std::string name;
  JointId parent =
      kNoParent;  ///< Index into RawSkeleton::joints, before this joint; kNoParent: a root.
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< Rest translation in the parent's frame.
  Quaternion rotation = Quaternion::Identity();      ///< Rest rotation in the parent's frame.
};

struct RawSkeleton {
  std::vector<RawJoint> joints;
};

/// `q` normalised; nothing if its norm is off by more than kMaxQuaternionNormError or not finite.
/// Idempotent: returns a quaternion that is already unit up to rounding bit for bit, so that files
/// survive rewriting.
[[nodiscard]] std::optional<Quaternion> unitQuaternion(const Quaternion& q);

/// Why `name` cannot be the name of a joint, as the end of a sentence ("is empty"); nothing if it
/// is legal: 1 to kMaxNameBytes bytes of UTF-8 without control characters.
[[nodiscard]] std::optional<std::string> nameProblem(std::string_view name);

/// A validated, immutable skeleton: at least one joint, parents before children, unique legal names
/// (nameProblem), finite offsets within kMaxCoordinate, unit rotations. Several roots are legal.
class Skeleton {
 public:
  /// Checks every rule above and renormalises rotations. Error::index is the offending joint.
  static Result<Skeleton> build(const RawSkeleton& raw);

  [[nodiscard]] std::int32_t numJoints() const { return static_cast<std::int32_t>(joints_.size()); }
  [[nodiscard]] const std::string& name(JointId joint) const { return at(joint).name; }
  [[nodiscard]] JointId parent(JointId joint) const { return at(joint).parent; }
  /// All joints' parents, in order: contiguous, because every step reads them.
  [[nodiscard]] const std::vector<JointId>& parents() const { return parents_; }
  [[nodiscard]] const Eigen::Vector3d& restOffset(JointId joint) const { return at(joint).offset; }
  [[nodiscard]] const Quaternion& restRotation(JointId joint) const { return at(joint).rotation; }
  /// Linear in the number of joints; meant for set-up.
  [[nodiscard]] std::optional<JointId> find(std::string_view name) const;

 private:
  [[nodiscard]] const RawJoint& at(JointId joint) const {
    FORETOUCH_ASSERT(joint >= 0 && joint < numJoints());
    return joints_[slotOf(joint)];
  }
  std::vector<RawJoint> joints_;
  std::vector<JointId> parents_;
};

/// Appends a chain to `raw`; each new joint's name is its number there. The chain's roots hang on
/// `carrier`, a joint of `raw`, or on nothing. Returns the number of its first joint.
JointId appendChain(const Skeleton& chain, JointId carrier, RawSkeleton& raw);

/// A frame in another one.
struct RigidPose {
  Quaternion rotation = Quaternion::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< Metres.
};

/// Parent-relative pose of every joint of one Skeleton, in its order (roots: in the world W).
/// `rotations[j]` replaces the rest rotation, `translations[j]` (metres) replaces the rest offset.
struct Pose {
  std::vector<Quaternion> rotations;
  std::vector<Eigen::Vector3d> translations;
};

/// The pose in which every joint has its rest values.
[[nodiscard]] Pose restPose(const Skeleton& skeleton);

/// Checks a pose against its skeleton (joint count, finite values, |translation| <= kMaxCoordinate,
/// quaternion norms within kMaxQuaternionNormError) and renormalises its rotations.
/// Error::index is the offending joint.
[[nodiscard]] Result<Pose> validatedPose(const Skeleton& skeleton, Pose pose);
/// The same check and renormalisation in place, without a copy; `pose` is unchanged on error.
Result<Done> validate(const Skeleton& skeleton, Pose& pose);

}  // namespace foretouch
