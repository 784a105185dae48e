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
constexpr double kJointRate = 64.0;   ///< The rotation rate's absolute error (rad).
constexpr double kChordRate = 128.0;  ///< The angle from the chord, and kJointRate (rad).
constexpr double kProduct = 16.0;     ///< One 3x3 product, or matrix times vector, of unit factors.

/// asin(c/2)*2 <= c*(1 + kArcExcess*c^2) for 0 <= c <= sqrt(2) and a little beyond
/// (motion_bounds.md 2).
constexpr double kArcExcess = 0.0556;

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

/// Rotation vector (axis times angle, in the child's frame) from `from` to `to`, both unit.
Vector3d rotationVector(const Quaternion& from, const Quaternion& to) {
  const Vector3d v0 = from.vec(), v1 = to.vec();
  const double w0 = from.w(), w1 = to.w();
  // conj(from) * to; the vector part is exact to a few kU of the quaternions' unit size.
  const Vector3d v = w0 * v1 - w1 * v0 - v0.cross(v1);
  const double sine = v.norm();
  if (!(sine > 0.0)) return Vector3d::Zero();
  const double angle = 2.0 * std::atan2(sine, w0 * w1 + v0.dot(v1));
  return (angle / sine) * v;
}

/// A validated pose's quaternion is unit within kUnitNormError and stays as given.
void storeUnit(const Quaternion& q, double sign, double* stored) {
  constexpr double kNormSquareError = 16.0 * kU;
  double scale = sign;
  const double normSquare = q.squaredNorm();
  if (!(std::abs(normSquare - 1.0) <= kNormSquareError)) scale = sign / std::sqrt(normSquare);
  stored[0] = scale * q.w();
  stored[1] = scale * q.x();
  stored[2] = scale * q.y();
  stored[3] = scale * q.z();
}

double squareOf(const double* v) {
  return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}

JointArc arcOf(const Quaternion& from, const Quaternion& to, const Vector3d& start,
               const Vector3d& end) {
  JointArc arc;
  storeUnit(from, 1.0, arc.from);
  storeUnit(to, arcSign(from, to), arc.to);
  double chordSquare = 0.0;
  for (int i = 0; i < 4; ++i) {
    const double difference = arc.to[i] - arc.from[i];
    chordSquare += difference * difference;
  }
  arc.versine = 0.5 * chordSquare;
  double last[3];
  for (int i = 0; i < 3; ++i) {
    arc.translation[i] = start[i];
    arc.drift[i] = end[i] - start[i];
    last[i] = start[i] + arc.drift[i];
  }
  // A norm is convex along a line: its largest value is at an end.
  arc.length = std::sqrt(std::max(squareOf(arc.translation), squareOf(last))) * kInflation;
  arc.driftLength = std::sqrt(squareOf(arc.drift)) * kInflation;
  return arc;
}

/// Bound on the joint's turn over t in [0,1], from its chord (motion_bounds.md 2).
double angleBound(const JointArc& arc) {
  const double chordSquare = 2.0 * arc.versine;
  return 2.0 * std::sqrt(chordSquare) * (1.0 + kArcExcess * chordSquare) + kChordRate * kU;
}

// The recurrences of articulated/motion_bounds.md sections 2 (motion) and 3 (rounding).
MotionBounds boundsOf(const MotionBounds& parent, const JointArc& joint) {
  const double rate = angleBound(joint), length = joint.length, drift = joint.driftLength;
  const double squareSpeed = parent.angularSpeed * parent.angularSpeed;
  const double parentTurn = parent.angularAcceleration + squareSpeed;
  const double seventhPower = squareSpeed * squareSpeed * squareSpeed * parent.angularSpeed;

  MotionBounds b;
  b.angularSpeed = parent.angularSpeed + rate;
  b.angularAcceleration = parent.angularAcceleration + parent.angularSpeed * rate;
  b.speed = parent.speed + parent.angularSpeed * length + drift;
  b.acceleration = parent.acceleration + parentTurn * length + 2.0 * parent.angularSpeed * drift;
  b.reach = parent.reach + length;
  b.eighthDerivative =
      parent.eighthDerivative + seventhPower * (parent.angularSpeed * length + 8.0 * drift);

  const double frame = parent.rotationRounding + kProduct * kU;  // of R_WP, and applying it
  b.rotationRounding = parent.rotationRounding + (kJointRotation + kProduct) * kU;
  b.originRounding = parent.originRounding + frame * length + 2.0 * kU * b.reach;
  b.spinRounding = parent.spinRounding + frame * rate + kJointRate * kU * (1.0 + rate) +
                   2.0 * kU * b.angularSpeed;
  b.velocityRounding = parent.velocityRounding +
                       (parent.spinRounding + 2.0 * parent.angularSpeed * frame) * length +
                       frame * drift + 4.0 * kU * b.speed;
  for (double* bound : {&b.angularSpeed, &b.angularAcceleration, &b.speed, &b.acceleration,
                        &b.reach, &b.eighthDerivative, &b.rotationRounding, &b.originRounding,
                        &b.spinRounding, &b.velocityRounding}) {
    *bound *= kInflation;
  }
  return b;
}

using JointMotion = MotionEvaluator::JointMotion;

JointMotion jointMotion(const JointArc& arc) {
  JointMotion m;
  m.parent = arc.parent;
  m.translation = Vector3d(arc.translation);
  m.translationRate = Vector3d(arc.drift);
  const Quaternion q0 = Quaternion(arc.from[0], arc.from[1], arc.from[2], arc.from[3]).normalized();
  const Quaternion q1 = Quaternion(arc.to[0], arc.to[1], arc.to[2], arc.to[3]).normalized();
  const Vector3d turn = rotationVector(q0, q1);
  m.angle = turn.norm();
  m.R0 = q0.toRotationMatrix();
  const Matrix3d K = m.angle > 0.0 ? crossMatrix(turn / m.angle) : Matrix3d(Matrix3d::Zero());
  m.S = m.R0 * K;
  m.C = m.S * K;
  m.rotationRate = m.R0 * turn;
  return m;
}

LinkState composed(const LinkState& parent, const JointMotion& joint, double t) {
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

/// The link's state, with `jointOf(id)` giving one joint's motion.
template <typename JointOf>
LinkState chainState(const ChainMotion& motion, LinkId link, double t, const JointOf& jointOf) {
  JointId chain[kMaxChainDepth];
  int depth = 0;
  for (JointId j = link; j != kNoParent; j = motion.arc(j).parent) {
    FORETOUCH_ASSERT(depth < kMaxChainDepth);
    chain[depth++] = j;
  }
  LinkState state;
  while (depth > 0) state = composed(state, jointOf(chain[--depth]), t);
  return state;
}

template <typename JointOf>
void chainStates(const ChainMotion& motion, double t, std::vector<LinkState>& states,
                 const JointOf& jointOf) {
  states.resize(static_cast<std::size_t>(motion.numLinks()));
  const LinkState world;
  for (LinkId j = 0; j < motion.numLinks(); ++j) {
    const JointId parent = motion.arc(j).parent;
    states[static_cast<std::size_t>(j)] = composed(
        parent == kNoParent ? world : states[static_cast<std::size_t>(parent)], jointOf(j), t);
  }
}

}  // namespace

ChainMotion::ChainMotion(const Skeleton& skeleton, const Pose& from, const Pose& to) {
  assign(skeleton, from, to);
}

void ChainMotion::assign(const Skeleton& skeleton, const Pose& from, const Pose& to) {
  const auto n = static_cast<std::size_t>(skeleton.numJoints());
  FORETOUCH_ASSERT(from.rotations.size() == n && from.translations.size() == n &&
                   to.rotations.size() == n && to.translations.size() == n);
  arcs_.resize(n);
  bounds_.resize(n);
  largestVersine_ = 0.0;
  const MotionBounds world;
  for (std::size_t j = 0; j < n; ++j) {
    JointArc& arc = arcs_[j];
    arc = arcOf(from.rotations[j], to.rotations[j], from.translations[j], to.translations[j]);
    arc.parent = skeleton.parent(static_cast<JointId>(j));
    largestVersine_ = std::max(largestVersine_, arc.versine);
    bounds_[j] = boundsOf(
        arc.parent == kNoParent ? world : bounds_[static_cast<std::size_t>(arc.parent)], arc);
  }
}

LinkState ChainMotion::stateAt(LinkId link, double t) const {
  return chainState(*this, link, t, [this](JointId j) { return jointMotion(arc(j)); });
}

void ChainMotion::statesAt(double t, std::vector<LinkState>& states) const {
  chainStates(*this, t, states, [this](JointId j) { return jointMotion(arc(j)); });
}

void MotionEvaluator::reset(const ChainMotion& motion) {
  motion_ = &motion;
  const auto n = static_cast<std::size_t>(motion.numLinks());
  if (joints_.size() < n) joints_.resize(n);
  isKnown_.assign(n, 0);
}

const MotionEvaluator::JointMotion& MotionEvaluator::joint(JointId joint) {
  const auto j = static_cast<std::size_t>(joint);
  if (isKnown_[j] == 0) {
    joints_[j] = jointMotion(motion_->arc(joint));
    isKnown_[j] = 1;
  }
  return joints_[j];
}

LinkState MotionEvaluator::stateAt(LinkId link, double t) {
  const auto jointOf = [this](JointId j) -> const JointMotion& { return joint(j); };
  return chainState(*motion_, link, t, jointOf);
}

void MotionEvaluator::statesAt(double t, std::vector<LinkState>& states) {
  const auto jointOf = [this](JointId j) -> const JointMotion& { return joint(j); };
  chainStates(*motion_, t, states, jointOf);
}

}  // namespace foretouch
