#include "articulated/motion.h"

#include <algorithm>
#include <cmath>

#include "lss/assert.h"

namespace foretouch {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Unit roundoff of double.
constexpr double kU = 0x1p-53;

// Rounding of one joint's own evaluation, derived in articulated/motion_bounds.md section 3; the
// worst seen there is below a fifth of each (tests/articulated/motion_bounds_test.cpp). In units of
// kU.
constexpr double kJointRotation =
    128.0;  ///< R(t): R0, axis, angle, sine and cosine, sum. Spectral norm.
constexpr double kJointRate = 64.0;  ///< The rotation rate's absolute error (rad).
constexpr double kProduct = 16.0;    ///< One 3x3 product, or matrix times vector, of unit factors.

/// Covers the rounding of the bounds' own arithmetic (a few dozen operations, all of positive
/// terms).
constexpr double kInflation = 1.0 + 1e-12;

Matrix3d crossMatrix(const Vector3d& v) {
  Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

/// +1 or -1: whether the shorter arc from `from` leads to `to` or to -`to`, for the quaternions as
/// given. Rounding of a normalisation must not have a say: near a half turn it would choose the
/// arc.
double arcSign(const Quaternion& from, const Quaternion& to) {
  const double dot = from.w() * to.w() + from.x() * to.x() + from.y() * to.y() + from.z() * to.z();
  return dot < 0.0 ? -1.0 : 1.0;
}

/// Rotation vector (axis times angle, in the child's frame) from `from` to sign*`to`, both unit.
Vector3d rotationVector(const Quaternion& from, const Quaternion& to, double sign) {
  const Vector3d v0 = from.vec(), v1 = sign * to.vec();
  const double w0 = from.w(), w1 = sign * to.w();
  // conj(from) * to; the vector part is exact to a few kU of the quaternions' unit size.
  const Vector3d v = w0 * v1 - w1 * v0 - v0.cross(v1);
  const double sine = v.norm();
  if (!(sine > 0.0)) return Vector3d::Zero();
  const double angle = 2.0 * std::atan2(sine, w0 * w1 + v0.dot(v1));
  return (angle / sine) * v;
}

}  // namespace

ChainMotion::JointMotion ChainMotion::jointMotion(const Skeleton& skeleton, const Pose& from,
                                                  const Pose& to, JointId joint) {
  const auto j = static_cast<std::size_t>(joint);
  JointMotion m;
  m.parent = skeleton.parent(joint);
  m.translation = from.translations[j];
  m.translationRate = to.translations[j] - from.translations[j];
  const Quaternion q0 = from.rotations[j].normalized();
  const Vector3d turn =
      rotationVector(q0, to.rotations[j].normalized(), arcSign(from.rotations[j], to.rotations[j]));
  m.angle = turn.norm();
  m.R0 = q0.toRotationMatrix();
  const Matrix3d K = m.angle > 0.0 ? crossMatrix(turn / m.angle) : Matrix3d(Matrix3d::Zero());
  m.S = m.R0 * K;
  m.C = m.S * K;
  m.rotationRate = m.R0 * turn;
  return m;
}

ChainMotion::ChainMotion(const Skeleton& skeleton, const Pose& from, const Pose& to) {
  const auto n = static_cast<std::size_t>(skeleton.numJoints());
  FORETOUCH_ASSERT(from.rotations.size() == n && from.translations.size() == n &&
                   to.rotations.size() == n && to.translations.size() == n);
  joints_.reserve(n);
  bounds_.reserve(n);
  for (JointId j = 0; j < skeleton.numJoints(); ++j) {
    joints_.push_back(jointMotion(skeleton, from, to, j));
    bounds_.push_back(boundsOf(joints_.back()));
  }
}

// The recurrences of articulated/motion_bounds.md sections 2 (motion) and 3 (rounding).
MotionBounds ChainMotion::boundsOf(const JointMotion& joint) const {
  const MotionBounds parent =
      joint.parent == kNoParent ? MotionBounds{} : bounds_[static_cast<std::size_t>(joint.parent)];
  const double rate = joint.angle + kJointRate * kU;
  const double length =
      std::max(joint.translation.norm(), (joint.translation + joint.translationRate).norm());
  const double drift = joint.translationRate.norm();
  const double parentTurn = parent.angularAcceleration + parent.angularSpeed * parent.angularSpeed;

  MotionBounds b;
  b.angularSpeed = parent.angularSpeed + rate;
  b.angularAcceleration = parent.angularAcceleration + parent.angularSpeed * rate;
  b.speed = parent.speed + parent.angularSpeed * length + drift;
  b.acceleration = parent.acceleration + parentTurn * length + 2.0 * parent.angularSpeed * drift;
  b.reach = parent.reach + length;

  const double frame = parent.rotationRounding + kProduct * kU;  // of R_WP, and applying it
  b.rotationRounding = parent.rotationRounding + (kJointRotation + kProduct) * kU;
  b.originRounding = parent.originRounding + frame * length + 2.0 * kU * b.reach;
  b.spinRounding = parent.spinRounding + frame * rate + kJointRate * kU * (1.0 + rate) +
                   2.0 * kU * b.angularSpeed;
  b.velocityRounding = parent.velocityRounding +
                       (parent.spinRounding + 2.0 * parent.angularSpeed * frame) * length +
                       frame * drift + 4.0 * kU * b.speed;
  for (double* bound :
       {&b.angularSpeed, &b.angularAcceleration, &b.speed, &b.acceleration, &b.reach,
        &b.rotationRounding, &b.originRounding, &b.spinRounding, &b.velocityRounding}) {
    *bound *= kInflation;
  }
  return b;
}

LinkState ChainMotion::composed(const LinkState& parent, const JointMotion& joint, double t) {
  const double sine = std::sin(joint.angle * t);
  const double versine = 1.0 - std::cos(joint.angle * t);
  const Matrix3d R_PL = joint.R0 + sine * joint.S + versine * joint.C;
  const Vector3d arm_W = parent.R_WL * (joint.translation + t * joint.translationRate);
  LinkState state;
  state.R_WL.noalias() = parent.R_WL * R_PL;
  state.p_WL = parent.p_WL + arm_W;
  state.w_WL = parent.w_WL + parent.R_WL * joint.rotationRate;
  state.v_WL = parent.v_WL + parent.w_WL.cross(arm_W) + parent.R_WL * joint.translationRate;
  return state;
}

LinkState ChainMotion::stateAt(LinkId link, double t) const {
  JointId chain[kMaxChainDepth];
  int depth = 0;
  for (JointId j = link; j != kNoParent; j = joints_[static_cast<std::size_t>(j)].parent) {
    FORETOUCH_ASSERT(depth < kMaxChainDepth);
    chain[depth++] = j;
  }
  LinkState state;
  while (depth > 0) state = composed(state, joints_[static_cast<std::size_t>(chain[--depth])], t);
  return state;
}

void ChainMotion::statesAt(double t, std::vector<LinkState>& states) const {
  states.resize(joints_.size());
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const JointMotion& joint = joints_[j];
    const LinkState root;
    const LinkState& parent =
        joint.parent == kNoParent ? root : states[static_cast<std::size_t>(joint.parent)];
    states[j] = composed(parent, joint, t);
  }
}

}  // namespace foretouch
