#include "middleware/solid/unfolding.h"

#include <algorithm>

#include "lss/index.h"

namespace foretouch::internal {
namespace {

/// Tries on the way to the rest pose: a joint bent by a right angle turns by 6 degrees in each.
constexpr int kTries = 16;

}  // namespace

Unfolding::Unfolding(const Skeleton& skeleton) : skeleton_(skeleton), rest_(restPose(skeleton)) {}

bool Unfolding::unfold(const Pose& asked, Certifier& certifier, Pose& posture) {
  isLoose_.assign(asked.rotations.size(), 0);
  posture = asked;
  for (int tried = 0;;) {
    const OwnTouch touch = certifier.ownTouchAt(posture);
    if (!touch.isAnswered) return false;
    if (!touch.touches) return true;
    // What touches first now is loosened as far as the others are.
    const bool isNew = loosenBetween(touch.link, touch.other);
    if (tried == 0 || !isNew) ++tried;
    if (tried > kTries) return false;
    turnBack(asked, static_cast<double>(tried) / kTries, posture);
  }
}

/// The joints on the way from one link to the other; a root is none. False: all were loose.
bool Unfolding::loosenBetween(LinkId one, LinkId other) {
  bool isNew = false;
  // Parents come before their children: the later of the two is never above the other.
  while (one != other) {
    LinkId& lower = one > other ? one : other;
    const JointId parent = skeleton_.parents()[slotOf(lower)];
    if (parent == kNoParent) break;
    isNew = isNew || isLoose_[slotOf(lower)] == 0;
    isLoose_[slotOf(lower)] = 1;
    lower = parent;
  }
  return isNew;
}

void Unfolding::turnBack(const Pose& asked, double share, Pose& posture) const {
  for (std::size_t j = 0; j < isLoose_.size(); ++j) {
    if (isLoose_[j] == 0) continue;
    posture.rotations[j] = asked.rotations[j].slerp(share, rest_.rotations[j]).normalized();
  }
}

}  // namespace foretouch::internal
