#include "middleware/solid/tree_pose.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "lss/index.h"

namespace foretouch::internal {
namespace {

Quaternion rotationBy(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  const double half = 0.5 * angle;
  // sin(x)/x, which is 1 to rounding where the angle's square is lost.
  const double share = angle > 1e-8 ? std::sin(half) / angle : 0.5;
  Quaternion q;
  q.w() = std::cos(half);
  q.vec() = share * vector;
  return q;
}

}  // namespace

void placeLinks(const Skeleton& skeleton, const Pose& pose, std::vector<LinkState>& states) {
  const std::vector<JointId>& parents = skeleton.parents();
  states.resize(parents.size());
  for (std::size_t j = 0; j < parents.size(); ++j) {
    LinkState& state = states[j];
    const Eigen::Matrix3d R = pose.rotations[j].toRotationMatrix();
    if (parents[j] == kNoParent) {
      state.R_WL = R;
      state.p_WL = pose.translations[j];
    } else {
      const LinkState& parent = states[slotOf(parents[j])];
      state.R_WL.noalias() = parent.R_WL * R;
      state.p_WL.noalias() = parent.p_WL + parent.R_WL * pose.translations[j];
    }
  }
}

void moveBy(const Skeleton& skeleton, const Pose& pose, const std::vector<LinkState>& states,
            const PoseStep& step, double share, Pose& moved) {
  const std::vector<JointId>& parents = skeleton.parents();
  moved.rotations.resize(parents.size());
  moved.translations.resize(parents.size());
  for (std::size_t j = 0; j < parents.size(); ++j) {
    Eigen::Vector3d turn = share * step.turn[j];
    if (parents[j] != kNoParent) turn = states[slotOf(parents[j])].R_WL.transpose() * turn;
    const Eigen::Quaterniond before = pose.rotations[j];
    const Eigen::Quaterniond by = rotationBy(turn);
    moved.rotations[j] = (by * before).normalized();
    moved.translations[j] = pose.translations[j] + share * step.shift[j];
  }
}

Eigen::Vector3d turnBetween(const Quaternion& from, const Quaternion& to) {
  const Eigen::Quaterniond between = Eigen::Quaterniond(to) * Eigen::Quaterniond(from).conjugate();
  const double sign = between.w() < 0.0 ? -1.0 : 1.0;
  const double sine = between.vec().norm();
  const double half = std::atan2(sine, std::abs(between.w()));
  const double share = sine > 1e-8 ? 2.0 * half / sine : 2.0;
  return sign * share * between.vec();
}

bool isSamePose(const Pose& x, const Pose& y) {
  const auto same = [](const auto& a, const auto& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0);
  };
  return same(x.rotations, y.rotations) && same(x.translations, y.translations);
}

}  // namespace foretouch::internal
