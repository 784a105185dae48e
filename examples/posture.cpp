// examples/posture.cpp: see the header.
#include "examples/posture.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "examples/dancer_body.h"
#include "lss/index.h"
#include "lss/turn_between.h"

namespace foretouch::examples {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kRadians = 3.14159265358979323846 / 180.0;  // in a degree

Quaterniond turn(double degrees, const Vector3d& axis) {
  return Quaterniond(Eigen::AngleAxisd(degrees * kRadians, axis));
}

Quaterniond yawPitchRoll(double yaw, double pitch, double roll) {
  return turn(yaw, Vector3d::UnitY()) * turn(pitch, Vector3d::UnitX()) *
         turn(roll, Vector3d::UnitZ());
}

/// World rotations and places while the tree is being filled in, parents first.
class PoseInProgress {
 public:
  explicit PoseInProgress(const Skeleton& skeleton)
      : skeleton_(skeleton), pose_(restPose(skeleton)) {
    R_W_.resize(pose_.rotations.size());
    p_W_.resize(pose_.rotations.size());
  }

  void root(const Vector3d& p_W, const Quaterniond& R_W) {
    pose_.translations[kHips] = p_W;
    pose_.rotations[kHips] = Quaternion(R_W);
    R_W_[kHips] = R_W;
    p_W_[kHips] = p_W;
  }
  void local(JointId joint, const Quaterniond& R_P) {
    pose_.rotations[at(joint)] = Quaternion(R_P);
    p_W_[at(joint)] = place(joint);
    R_W_[at(joint)] = rotation(skeleton_.parent(joint)) * R_P;
  }
  void world(JointId joint, const Quaterniond& R_W) {
    local(joint, rotation(skeleton_.parent(joint)).conjugate() * R_W);
  }
  /// The joint's place; known as soon as the parent is.
  [[nodiscard]] Vector3d place(JointId joint) const {
    const auto parent = at(skeleton_.parent(joint));
    return p_W_[parent] + R_W_[parent] * skeleton_.restOffset(joint);
  }
  [[nodiscard]] const Quaterniond& rotation(JointId joint) const { return R_W_[at(joint)]; }
  [[nodiscard]] const Skeleton& skeleton() const { return skeleton_; }
  [[nodiscard]] const Pose& pose() const { return pose_; }

 private:
  static std::size_t at(JointId joint) { return slotOf(joint); }

  const Skeleton& skeleton_;
  Pose pose_;
  std::vector<Quaterniond> R_W_;
  std::vector<Vector3d> p_W_;
};

Matrix3d axes(const Vector3d& bone, const Vector3d& hinge) {
  Matrix3d m;
  m << bone, hinge, bone.cross(hinge);
  return m;
}

/// Upper bone and lower bone so that the end of the lower one is at `target`. `bone` and `bulge`
/// are where the straight limb and its elbow or knee point in the frame `R_WF`. The bulge is
/// carried along by the smallest turn of the bone, which has its only jump where no limb gets:
/// straight backwards.
void reach(PoseInProgress& pose, JointId upper, const Quaterniond& R_WF, const Vector3d& bone,
           const Vector3d& bulge, const Vector3d& target) {
  const double l1 = pose.skeleton().restOffset(upper + 1).norm();
  const double l2 = pose.skeleton().restOffset(upper + 2).norm();
  const Vector3d away = target - pose.place(upper);
  const double d = std::clamp(away.norm(), 1.05 * std::abs(l1 - l2) + 0.1, 0.998 * (l1 + l2));
  const Vector3d along = away.normalized();
  const Quaterniond swing = turnBetween(R_WF * bone, along);
  const Vector3d side = swing * (R_WF * bulge);
  const double cosine = (l1 * l1 + d * d - l2 * l2) / (2.0 * l1 * d);
  const Vector3d upperBone = cosine * along + std::sqrt(1.0 - cosine * cosine) * side;
  const Vector3d lowerBone = (d * along - l1 * upperBone) / l2;
  const Vector3d hinge = along.cross(side);
  const Matrix3d rest = axes(bone, bone.cross(bulge));
  pose.world(upper, Quaterniond(Matrix3d(axes(upperBone, hinge) * rest.transpose())));
  pose.world(upper + 1,
             Quaterniond(Matrix3d(axes(lowerBone.normalized(), hinge) * rest.transpose())));
}

/// `side`: 1 left, -1 right.
void placeArm(PoseInProgress& pose, JointId shoulder, double side, const Posture::Hand& hand) {
  const Quaterniond& chest = pose.rotation(kSpine2);
  const Vector3d bone(side, 0.0, 0.0), bulge = Vector3d(0.0, 0.2, -1.0).normalized();
  const Vector3d target =
      pose.place(kNeck) +
      chest * (Vector3d(side * hand.wrist.x(), hand.wrist.y() - 0.06, hand.wrist.z()));
  // The collar bone gives way a little towards where the hand goes.
  const Vector3d goal = chest.conjugate() * (target - pose.place(shoulder));
  pose.local(shoulder,
             Quaterniond::Identity().slerp(0.12, turnBetween(bone, goal)));
  reach(pose, shoulder + 1, chest, bone, bulge, target);
  const Vector3d curl = -side * Vector3d::UnitZ();
  pose.local(shoulder + 3, turn(8.0 - 6.0 * hand.grip, curl));
  pose.local(shoulder + 4, turn(12.0 + 75.0 * hand.grip, curl));
  pose.local(shoulder + 5, turn(35.0 * hand.grip, curl));
}

void placeLeg(PoseInProgress& pose, JointId upLeg, const Posture::Foot& foot) {
  const Quaterniond R_WFoot = yawPitchRoll(foot.yaw, foot.pitch, 0.0);
  constexpr double kToeRadius = 0.03;  // the joint of the toes lies this much above the sole
  const Vector3d ball = foot.ball + kToeRadius * Vector3d::UnitY();
  const Vector3d ankle = ball - R_WFoot * pose.skeleton().restOffset(upLeg + 3);
  reach(pose, upLeg, pose.rotation(kHips), -Vector3d::UnitY(), Vector3d::UnitZ(), ankle);
  // An ankle gives 50 degrees; a foot in the air follows its shin beyond that.
  const Quaterniond bent = pose.rotation(upLeg + 1).conjugate() * R_WFoot;
  const double angle = bent.angularDistance(Quaterniond::Identity());
  constexpr double kMostBent = 50.0 * kRadians;
  const double share = angle > kMostBent ? kMostBent / angle : 1.0;
  pose.local(upLeg + 2, Quaterniond::Identity().slerp(share, bent));
  // Toes stay flat while the heel lifts, and stretch once the foot is in the air.
  const double grounded = 1.0 - std::clamp(foot.ball.y() / 0.12, 0.0, 1.0);
  pose.local(upLeg + 3, turn(-grounded * std::clamp(foot.pitch, 0.0, 50.0), Vector3d::UnitX()));
}

}  // namespace

Pose poseOf(const Skeleton& dancer, const Posture& p) {
  PoseInProgress pose(dancer);
  pose.root(p.hips, yawPitchRoll(p.yaw, p.pitch, p.roll));
  for (const JointId joint : {kSpine, kSpine1, kSpine2}) {
    pose.local(joint, yawPitchRoll(p.twist / 3.0, p.bend / 3.0, p.lean / 3.0));
  }
  pose.local(kNeck, yawPitchRoll(0.4 * p.gaze, 0.4 * p.nod, 0.0));
  pose.local(kHead, yawPitchRoll(0.6 * p.gaze, 0.6 * p.nod, 0.0));
  placeArm(pose, kLeftShoulder, 1.0, p.leftHand);
  placeArm(pose, kRightShoulder, -1.0, p.rightHand);
  placeLeg(pose, kLeftUpLeg, p.leftFoot);
  placeLeg(pose, kRightUpLeg, p.rightFoot);
  return pose.pose();
}

}  // namespace foretouch::examples
