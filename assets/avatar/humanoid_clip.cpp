#include "assets/avatar/humanoid_clip.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "assets/avatar/humanoid_rest.h"
#include "assets/human_bones.h"
#include "lss/index.h"

namespace foretouch {
namespace {

using Eigen::Matrix3d;
using Bones = HumanoidRest::Bones;

constexpr double kNotedTiltDeg = 5.0;
/// Rotations this near (rad) are the same: files round them.
constexpr double kSameRest = 1e-5;
/// Legs differ from person to person by less.
constexpr double kNotedLegs = 0.1;

Error restsOtherwise(const std::string& what) {
  return Error::of(ErrorCode::Mismatch,
                   "its parts of the body are the avatar's, but it rests in another pose: " + what +
                       "; expected a T-pose at rest, or a joint map");
}

bool restAlike(const Skeleton& avatar, const Skeleton& clip) {
  bool any = false;
  for (JointId joint = 0; joint < avatar.numJoints(); ++joint) {
    const auto other = clip.find(avatar.name(joint));
    if (!other) continue;
    any = true;
    if (avatar.restRotation(joint).angularDistance(clip.restRotation(*other)) > kSameRest) {
      return false;
    }
  }
  return any && isHumanoid(clip);
}

class Retargeting {
 public:
  Retargeting(const Skeleton& avatar, const Clip& clip)
      : avatar_(avatar),
        clip_(clip),
        to_(avatar, ownBones(avatar)),
        from_(clip.skeleton, humanBonesOf(clip.skeleton)) {}

  [[nodiscard]] bool isBetweenHumanoids() const { return !from_.bones().empty(); }

  Result<Done> settle() {
    const Matrix3d own = to_.frame(), other = from_.frame();
    if (own.isZero() || other.isZero()) {
      return restsOtherwise(std::string("the ") + (own.isZero() ? "avatar" : "clip") +
                            " does not stand along the axes");
    }
    turn_ = Quaternion(Matrix3d(other * own.transpose()));
    for (const auto& [begin, end] : kRestingLimbs) {
      const double tilt = angleDeg(turn_ * to_.between(begin, end), from_.between(begin, end));
      if (!(tilt <= kMostTPoseTiltDeg)) {
        return restsOtherwise("joint " + inQuotes(clip_.skeleton.name(from_.bones().at(begin))) +
                              " is " + inDigits(tilt, 3) + " degrees off");
      }
      if (tilt > tilt_) tilt_ = tilt;
    }
    source_.assign(countOf(avatar_.numJoints()), kNoParent);
    for (const auto& [bone, joint] : to_.bones()) {
      const auto found = from_.bones().find(bone);
      if (found != from_.bones().end()) source_[slotOf(joint)] = found->second;
    }
    return Done{};
  }

  [[nodiscard]] Pose poseAt(const Pose& frame) const {
    const std::vector<RigidPose> moved = placesIn(clip_.skeleton, frame);
    Pose pose = restPose(avatar_);
    std::vector<RigidPose> placed(source_.size());
    for (std::size_t j = 0; j < source_.size(); ++j) {
      const JointId parent = avatar_.parent(static_cast<JointId>(j));
      const RigidPose above = parent == kNoParent ? RigidPose{} : placed[slotOf(parent)];
      if (source_[j] != kNoParent) {
        const auto s = slotOf(source_[j]);
        const Quaternion since = moved[s].rotation * from_.place(source_[j]).rotation.conjugate();
        const Quaternion world = since * turn_ * to_.place(static_cast<JointId>(j)).rotation;
        pose.rotations[j] = (above.rotation.conjugate() * world).normalized();
        if (isHips(j)) {
          pose.translations[j] =
              above.rotation.conjugate() * (moved[s].translation - above.translation);
        }
      }
      placed[j].rotation = above.rotation * pose.rotations[j];
      placed[j].translation = above.translation + above.rotation * pose.translations[j];
    }
    return pose;
  }

  [[nodiscard]] Clip take() const {
    Clip clip;
    clip.skeleton = avatar_;
    clip.frameTimeS = clip_.frameTimeS;
    clip.framesPerRow = clip_.framesPerRow;
    for (const Pose& frame : clip_.frames) clip.frames.push_back(poseAt(frame));
    for (std::size_t j = 0; j < source_.size(); ++j) {
      clip.hasRotation.push_back(source_[j] != kNoParent);
      clip.hasTranslation.push_back(source_[j] != kNoParent && isHips(j));
    }
    clip.endSites.resize(source_.size());
    clip.notes = clip_.notes;
    // Where the clip lacks one joint, the body may hang on it.
    for (const ClipGap& gap : clip_.gaps) clip.gaps.push_back({gap.first, gap.last});
    addNotes(clip.notes);
    return clip;
  }

 private:
  static Bones ownBones(const Skeleton& avatar) {
    Bones bones;
    for (JointId joint = 0; joint < avatar.numJoints(); ++joint) {
      if (isHumanBone(avatar.name(joint))) bones.emplace(avatar.name(joint), joint);
    }
    return bones;
  }

  [[nodiscard]] bool isHips(std::size_t joint) const {
    return avatar_.name(static_cast<JointId>(joint)) == "hips";
  }

  void addNotes(std::vector<std::string>& notes) const {
    const auto count =
        source_.size() - countOf(std::count(source_.begin(), source_.end(), kNoParent));
    const JointId arm = from_.bones().at("leftUpperArm");
    std::string note = std::to_string(count) + " of the avatar's " +
                       std::to_string(source_.size()) +
                       " joints follow it by their part of the body, such as 'leftUpperArm' " +
                       inQuotes(clip_.skeleton.name(arm)) + "; the others keep their rest values";
    if (tilt_ > kNotedTiltDeg) {
      note += "; its limbs at rest are up to " + inDigits(tilt_, 2) + " degrees off the avatar's";
    }
    notes.push_back(std::move(note));
    const double ratio = from_.legLength() / to_.legLength();
    if (std::abs(ratio - 1.0) <= kNotedLegs) return;
    notes.push_back("its legs are " + inDigits(ratio, 3) +
                    " times as long as the avatar's, whose feet do not stand where its do");
  }

  const Skeleton& avatar_;
  const Clip& clip_;
  HumanoidRest to_, from_;
  Quaternion turn_ = Quaternion::Identity();  ///< The avatar at rest, to face as the clip at rest.
  double tilt_ = 0.0;                         ///< Degrees: the most that limbs differ at rest.
  std::vector<JointId> source_;               ///< Per joint of the avatar.
};

}  // namespace

Result<std::optional<Clip>> humanoidClip(const Skeleton& avatar, const Clip& clip) {
  std::optional<Clip> none;
  if (!isHumanoid(avatar) || restAlike(avatar, clip.skeleton)) return none;
  Retargeting retargeting(avatar, clip);
  if (!retargeting.isBetweenHumanoids()) return none;
  FORETOUCH_CHECK(retargeting.settle());
  return std::optional<Clip>(retargeting.take());
}

}  // namespace foretouch
