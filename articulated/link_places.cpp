#include "articulated/link_places.h"

namespace foretouch {

void placesAt(const Skeleton& skeleton, const Pose& pose, std::vector<LinkState>& states) {
  const auto n = countOf(skeleton.numJoints());
  states.resize(n);
  for (std::size_t j = 0; j < n; ++j) {
    const Eigen::Matrix3d R_PL = pose.rotations[j].normalized().toRotationMatrix();
    const JointId parent = skeleton.parents()[j];
    LinkState& state = states[j];
    state.w_WL = state.v_WL = Eigen::Vector3d::Zero();
    if (parent == kNoParent) {
      state.R_WL = R_PL;
      state.p_WL = pose.translations[j];
      continue;
    }
    const LinkState& above = states[slotOf(parent)];
    state.R_WL.noalias() = above.R_WL * R_PL;
    state.p_WL = above.p_WL + above.R_WL * pose.translations[j];
  }
}

}  // namespace foretouch
