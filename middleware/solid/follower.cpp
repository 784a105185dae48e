#include "middleware/solid/follower.h"

#include <algorithm>

#include "middleware/solid/solid_way.h"
#include "middleware/solid/tree_pose.h"

namespace foretouch::internal {

Follower::Follower(const Avatar& avatar, const SolidOptions& options)
    : body_(avatar, options.visibility) {}

void Follower::reset() {}

void Follower::follow(const Pose& target, double /*budget*/, double /*dtS*/, Certifier& certifier,
                      Pose& shown, SolidTick& tick) {
  if (isSamePose(shown, target)) return;
  const Certified answer = certifier.certify(shown, target, reached_);
  if (answer.share > 0.0) {
    appendPiece(reached_, answer.clearance, tick);
    shown = reached_;
  }
}

}  // namespace foretouch::internal
