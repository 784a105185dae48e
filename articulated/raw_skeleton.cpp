#include "articulated/raw_skeleton.h"

#include "lss/index.h"

namespace foretouch {

RawSkeleton rawSkeleton(const Skeleton& skeleton) {
  RawSkeleton raw;
  raw.joints.reserve(countOf(skeleton.numJoints()));
  for (JointId joint = 0; joint < skeleton.numJoints(); ++joint) {
    raw.joints.push_back({skeleton.name(joint), skeleton.parent(joint), skeleton.restOffset(joint),
                          skeleton.restRotation(joint)});
  }
  return raw;
}

}  // namespace foretouch
