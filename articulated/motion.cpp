#include "articulated/motion.h"

#include <algorithm>
#include <cmath>

#include "articulated/joint_arcs.h"
#include "lss/assert.h"
#include "lss/index.h"

namespace foretouch {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using internal::JointColumns;

Matrix3d crossMatrix(const Vector3d& v) {
  Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
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

/// The recurrences of articulated/motion_bounds.md 2 for joint `j`, from its parent's sums.
ChainSums sumsOf(const ChainSums& parent, const JointColumns& arcs, std::size_t j) {
  const auto at = [&](JointColumns::Column column) {
    return arcs.numbers[static_cast<std::size_t>(column * arcs.stride) + j];
  };
  const double turn = at(JointColumns::kTurn), length = at(JointColumns::kLength);
  const double drift = at(JointColumns::kDriftLength);
  const double square = parent.angularSpeed * parent.angularSpeed;
  const double swing = parent.angularSpeed * length;
  ChainSums sums;
  sums.angularSpeed = parent.angularSpeed + turn;
  sums.angularAcceleration = parent.angularAcceleration + parent.angularSpeed * turn;
  sums.speed = parent.speed + (swing + drift);
  sums.acceleration = parent.acceleration + ((parent.angularAcceleration + square) * length +
                                             2.0 * (parent.angularSpeed * drift));
  sums.eighthDerivative = parent.eighthDerivative + (square * square) *
                                                        (square * parent.angularSpeed) *
                                                        (swing + 8.0 * drift);
  sums.armReach = parent.armReach + length;
  sums.rootReach = parent.rootReach;
  sums.depth = parent.depth + 1.0;
  return sums;
}

/// A root's arm is from the world's origin to the root.
ChainSums rootSums(const JointColumns& arcs, std::size_t j) {
  ChainSums sums = sumsOf(ChainSums(), arcs, j);
  std::swap(sums.armReach, sums.rootReach);
  return sums;
}

/// The fields of ChainMotion::largestSums().
ChainSums larger(const ChainSums& a, const ChainSums& b) {
  ChainSums sums;
  sums.angularSpeed = std::max(a.angularSpeed, b.angularSpeed);
  sums.eighthDerivative = std::max(a.eighthDerivative, b.eighthDerivative);
  sums.armReach = std::max(a.armReach, b.armReach);
  sums.depth = std::max(a.depth, b.depth);
  return sums;
}

/// The rotation at `t` on the arc between two unit quaternions.
Quaternion turnedBy(const Quaternion& from, const Quaternion& to, double t) {
  const Vector3d turn = rotationVector(from.normalized(), to.normalized());
  const double angle = turn.norm();
  if (!(angle > 0.0)) return from;
  const Vector3d part = (std::sin(0.5 * angle * t) / angle) * turn;
  return (from * Quaternion(std::cos(0.5 * angle * t), part.x(), part.y(), part.z())).normalized();
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

/// The joints that move a link in the frame of a link above it, or in W.
struct ChainBelow {
  JointId joints[kMaxChainDepth];  // the link's own first
  int depth = 0;

  ChainBelow(const ChainMotion& motion, LinkId frame, LinkId link) {
    for (JointId j = link; j != frame; j = motion.parent(j)) {
      FORETOUCH_ASSERT(j != kNoParent && depth < kMaxChainDepth);
      joints[depth++] = j;
    }
  }
};

/// The link's state, with `jointOf(id)` giving one joint's motion.
template <typename JointOf>
LinkState chainState(const ChainMotion& motion, LinkId frame, LinkId link, double t,
                     const JointOf& jointOf) {
  const ChainBelow chain(motion, frame, link);
  LinkState state;
  for (int i = chain.depth; i > 0; --i) state = composed(state, jointOf(chain.joints[i - 1]), t);
  return state;
}

template <typename JointOf>
void chainStates(const ChainMotion& motion, double t, std::vector<LinkState>& states,
                 const JointOf& jointOf) {
  states.resize(countOf(motion.numLinks()));
  const LinkState world;
  for (LinkId j = 0; j < motion.numLinks(); ++j) {
    const JointId parent = motion.parent(j);
    states[slotOf(j)] =
        composed(parent == kNoParent ? world : states[slotOf(parent)], jointOf(j), t);
  }
}

}  // namespace

ChainMotion::ChainMotion(const Skeleton& skeleton, const Pose& from, const Pose& to) {
  assign(skeleton, from, to);
}

void ChainMotion::assign(const Skeleton& skeleton, const Pose& from, const Pose& to) {
  const auto n = countOf(skeleton.numJoints());
  FORETOUCH_ASSERT(from.rotations.size() == n && from.translations.size() == n &&
                   to.rotations.size() == n && to.translations.size() == n);
  parents_ = skeleton.parents();
  arcs_.resize(n * JointColumns::kCount);
  sums_.resize(n);
  largest_ = ChainSums();
  largestVersine_ = 0.0;
  if (n == 0) return;
  const JointColumns arcs = {arcs_.data(), static_cast<int>(n)};
  computeArcs({{from.rotations[0].coeffs().data(), to.rotations[0].coeffs().data()},
               {from.translations[0].data(), to.translations[0].data()}},
              arcs.stride, arcs);
  // Local: members would be stored and reloaded for every joint.
  const JointId* const parents = parents_.data();
  ChainSums* const sums = sums_.data();
  const double* const versines = arcs_.data() + n * JointColumns::kVersine;
  ChainSums largest;
  double largestVersine = 0.0;
  for (std::size_t j = 0; j < n; ++j) {
    sums[j] =
        parents[j] == kNoParent ? rootSums(arcs, j) : sumsOf(sums[slotOf(parents[j])], arcs, j);
    largest = larger(largest, sums[j]);
    largestVersine = std::max(largestVersine, versines[j]);
  }
  largest_ = largest;
  largestVersine_ = largestVersine;
}

JointArc ChainMotion::arc(LinkId link) const {
  const auto j = slotOf(link), stride = sums_.size();
  const auto copy = [&](std::size_t column, std::size_t count, double* to) {
    for (std::size_t i = 0; i < count; ++i) to[i] = arcs_[(column + i) * stride + j];
  };
  JointArc arc;
  copy(JointColumns::kFrom, 4, arc.from);
  copy(JointColumns::kTo, 4, arc.to);
  copy(JointColumns::kTranslation, 3, arc.translation);
  copy(JointColumns::kDrift, 3, arc.drift);
  copy(JointColumns::kVersine, 1, &arc.versine);
  copy(JointColumns::kLength, 1, &arc.length);
  copy(JointColumns::kDriftLength, 1, &arc.driftLength);
  arc.parent = parents_[j];
  return arc;
}

LinkState ChainMotion::stateAt(LinkId link, double t) const {
  return chainState(*this, kNoParent, link, t, [this](JointId j) { return jointMotion(arc(j)); });
}

void ChainMotion::poseAt(double t, Pose& pose) const {
  const auto n = countOf(numLinks());
  pose.rotations.resize(n);
  pose.translations.resize(n);
  for (LinkId link = 0; link < numLinks(); ++link) {
    const JointArc joint = arc(link);
    const Quaternion from(joint.from[0], joint.from[1], joint.from[2], joint.from[3]);
    const Quaternion to(joint.to[0], joint.to[1], joint.to[2], joint.to[3]);
    const Vector3d translation(joint.translation), drift(joint.drift);
    pose.translations[slotOf(link)] = translation + t * drift;
    pose.rotations[slotOf(link)] = t == 0.0 ? from : t == 1.0 ? to : turnedBy(from, to, t);
  }
}

ChainSums ChainMotion::sumsIn(LinkId frame, LinkId link) const {
  if (frame == kNoParent) return sums(link);
  const internal::JointColumns arcs = {const_cast<double*>(arcs_.data()), numLinks()};
  const ChainBelow chain(*this, frame, link);
  if (chain.depth == 0) return {};
  ChainSums sums = rootSums(arcs, slotOf(chain.joints[chain.depth - 1]));
  for (int i = chain.depth - 1; i > 0; --i) sums = sumsOf(sums, arcs, slotOf(chain.joints[i - 1]));
  return sums;
}

void ChainMotion::statesAt(double t, std::vector<LinkState>& states) const {
  chainStates(*this, t, states, [this](JointId j) { return jointMotion(arc(j)); });
}

ChainMotion::JointBounds ChainMotion::jointBounds(LinkId link) const {
  const auto j = slotOf(link), stride = sums_.size();
  return {arcs_[JointColumns::kTurn * stride + j], arcs_[JointColumns::kLength * stride + j],
          arcs_[JointColumns::kDriftLength * stride + j]};
}

void MotionEvaluator::reset(const ChainMotion& motion) {
  motion_ = &motion;
  const auto n = countOf(motion.numLinks());
  if (joints_.size() < n) joints_.resize(n);
  isKnown_.assign(n, 0);
}

const MotionEvaluator::JointMotion& MotionEvaluator::joint(JointId joint) {
  const auto j = slotOf(joint);
  if (isKnown_[j] == 0) {
    joints_[j] = jointMotion(motion_->arc(joint));
    isKnown_[j] = 1;
  }
  return joints_[j];
}

LinkState MotionEvaluator::stateAt(LinkId link, double t) {
  return stateIn(kNoParent, link, t);
}

LinkState MotionEvaluator::stateIn(LinkId frame, LinkId link, double t) {
  const auto jointOf = [this](JointId j) -> const JointMotion& { return joint(j); };
  return chainState(*motion_, frame, link, t, jointOf);
}

void MotionEvaluator::statesAt(double t, std::vector<LinkState>& states) {
  const auto jointOf = [this](JointId j) -> const JointMotion& { return joint(j); };
  chainStates(*motion_, t, states, jointOf);
}

}  // namespace foretouch
