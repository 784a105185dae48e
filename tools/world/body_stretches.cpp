#include "tools/world/body_stretches.h"

#include <algorithm>
#include <iterator>

#include "articulated/motion.h"
#include "lss/assert.h"
#include "lss/index.h"

namespace foretouch::tools {

const BodyStretch* stretchAt(const BodyStretches& stretches, std::int64_t utimeUs) {
  const auto after =
      std::upper_bound(stretches.begin(), stretches.end(), utimeUs,
                       [](std::int64_t us, const BodyStretch& one) { return us < one.beginUs; });
  return after == stretches.begin() ? nullptr : &*std::prev(after);
}

Pose poseOn(const Track& track, std::int64_t utimeUs) {
  const TrackPiece piece = track.pieceAt(utimeUs);
  if (piece.isHeld || piece.beginUs == utimeUs) return *piece.from;
  const ChainMotion motion(track.skeleton(), *piece.from, *piece.to);
  Pose pose;
  motion.poseAt(piece.at(utimeUs), pose);
  return pose;
}

Pose BodyPlaces::poseAt(BodyId body, std::int64_t utimeUs) const {
  const BodyStretch* const stretch = stretchAt(*bodies_[slotOf(body)], utimeUs);
  FORETOUCH_ASSERT(stretch != nullptr);
  return poseOn(stretch->track, utimeUs);
}

RigidPose BodyPlaces::linkAt(BodyId body, LinkId link, std::int64_t utimeUs) const {
  const BodyStretch* const stretch = stretchAt(*bodies_[slotOf(body)], utimeUs);
  FORETOUCH_ASSERT(stretch != nullptr);
  const Skeleton& skeleton = stretch->track.skeleton();
  const Pose pose = poseAt(body, utimeUs);
  RigidPose frame;
  for (JointId joint = link; joint != kNoParent; joint = skeleton.parent(joint)) {
    frame = composed({pose.rotations[slotOf(joint)], pose.translations[slotOf(joint)]}, frame);
  }
  return composed(carrierAt(body, utimeUs), frame);
}

RigidPose BodyPlaces::carrierAt(BodyId body, std::int64_t utimeUs) const {
  const BodyStretch* const stretch = stretchAt(*bodies_[slotOf(body)], utimeUs);
  FORETOUCH_ASSERT(stretch != nullptr);
  if (!stretch->carrier) return {};
  return linkAt(stretch->carrier->body, stretch->carrier->link, utimeUs);
}

bool BodyPlaces::isThere(BodyId body, std::int64_t utimeUs) const {
  const BodyStretch* const stretch = stretchAt(*bodies_[slotOf(body)], utimeUs);
  if (stretch == nullptr) return false;
  return !stretch->carrier || isThere(stretch->carrier->body, utimeUs);
}

RigidPose composed(const RigidPose& outer, const RigidPose& inner) {
  return {(outer.rotation * inner.rotation).normalized(),
          outer.translation + outer.rotation * inner.translation};
}

RigidPose inverse(const RigidPose& frame) {
  const Quaternion back = frame.rotation.conjugate();
  return {back, -(back * frame.translation)};
}

Pose movedBy(const RigidPose& frame, const Skeleton& skeleton, Pose pose) {
  for (JointId joint = 0; joint < skeleton.numJoints(); ++joint) {
    if (skeleton.parent(joint) != kNoParent) continue;
    const std::size_t slot = slotOf(joint);
    const RigidPose moved = composed(frame, {pose.rotations[slot], pose.translations[slot]});
    pose.rotations[slot] = moved.rotation;
    pose.translations[slot] = moved.translation;
  }
  return pose;
}

}  // namespace foretouch::tools
