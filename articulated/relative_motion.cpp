#include "articulated/relative_motion.h"

#include <string>
#include <utility>

#include "articulated/try.h"
#include "lss/assert.h"
#include "lss/index.h"

namespace foretouch {

RelativeChain::RelativeChain(const Skeleton& original, JointId frame)
    : skeleton_(original), linkOf_(countOf(original.numJoints()), kNoParent) {
  FORETOUCH_ASSERT(frame >= 0 && frame < original.numJoints());
  addPath(original, frame);
  addOthers(original);
}

JointId RelativeChain::add(JointId parent, const Source& source) {
  sources_.push_back(source);
  parents_.push_back(parent);
  return static_cast<JointId>(sources_.size()) - 1;
}

/// From the frame up to its root, each joint's rotation is turned back about the place where the
/// one below it was (articulated/relative_motion.md 1). The links themselves are leaves of that.
void RelativeChain::addPath(const Skeleton& original, JointId frame) {
  JointId turnedBack = kNoParent, below = kNoParent;
  for (JointId joint = frame; joint != kNoParent; joint = original.parent(joint)) {
    linkOf_[slotOf(joint)] = add(turnedBack, {kNoParent, false, kNoParent, below});
    turnedBack = add(turnedBack, {joint, true, kNoParent, below});
    below = joint;
  }
  atWorld_ = turnedBack;
  rootOfFrame_ = below;
}

void RelativeChain::addOthers(const Skeleton& original) {
  for (JointId joint = 0; joint < original.numJoints(); ++joint) {
    if (linkOf_[slotOf(joint)] != kNoParent) continue;
    const JointId parent = original.parent(joint);
    linkOf_[slotOf(joint)] = parent == kNoParent
                                 ? add(atWorld_, {joint, false, joint, rootOfFrame_})
                                 : add(linkOf_[slotOf(parent)], {joint, false, joint, kNoParent});
  }
}

void RelativeChain::pose(const Pose& original, Pose& relative) const {
  FORETOUCH_ASSERT(original.rotations.size() == linkOf_.size() &&
                   original.translations.size() == linkOf_.size() && &original != &relative);
  relative.rotations.resize(sources_.size());
  relative.translations.resize(sources_.size());
  for (std::size_t j = 0; j < sources_.size(); ++j) {
    const Source& source = sources_[j];
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    if (source.shift != kNoParent) place = original.translations[slotOf(source.shift)];
    if (source.less != kNoParent) place -= original.translations[slotOf(source.less)];
    relative.translations[j] = place;
    Quaternion turn = Quaternion::Identity();
    if (source.turn != kNoParent) turn = original.rotations[slotOf(source.turn)];
    if (source.isTurnedBack) turn = turn.conjugate();
    relative.rotations[j] = turn;
  }
}

namespace {

/// A legal name that no joint of the original has.
std::string nameOfTurn(const Skeleton& original, std::size_t joint) {
  std::string name = "back " + std::to_string(joint);
  while (original.find(name)) name += '+';
  return name;
}

}  // namespace

Result<RelativeChain> RelativeChain::build(const Skeleton& skeleton, JointId frame) {
  RelativeChain chain(skeleton, frame);
  Pose rest;
  chain.pose(restPose(skeleton), rest);
  RawSkeleton raw;
  for (std::size_t j = 0; j < chain.sources_.size(); ++j) {
    raw.joints.push_back(
        {nameOfTurn(skeleton, j), chain.parents_[j], rest.translations[j], rest.rotations[j]});
  }
  for (JointId joint = 0; joint < skeleton.numJoints(); ++joint) {
    raw.joints[slotOf(chain.linkOf_[slotOf(joint)])].name = skeleton.name(joint);
  }
  FORETOUCH_TRY(chain.skeleton_, Skeleton::build(raw));
  return chain;
}

}  // namespace foretouch
