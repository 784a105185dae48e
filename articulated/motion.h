// articulated/motion.h: the in-between motion: what an articulated body does between two poses.
//
// Definition (part of the promise, docs/guarantees.md): over t in [0,1] each joint's
// parent-relative rotation turns at constant rate about a fixed axis on the shorter arc (slerp),
// each joint's parent-relative translation is linear, and a link's world motion is the composition
// down the chain. "Shorter arc" is decided by the sign of the dot product of the two quaternions as
// computed in double in the order w, x, y, z; zero counts as positive. Lengths in metres, angles in
// radians, derivatives per unit of t.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "articulated/skeleton.h"
#include "lss/index.h"
#include "lss/rounding.h"

namespace foretouch {

/// Pose and velocity of one link at one t, in the world W. MotionBounds::originRounding and
/// MotionBounds::rotationRounding bound its rounding.
struct LinkState {
  Eigen::Matrix3d R_WL = Eigen::Matrix3d::Identity();  ///< Rotation L to W.
  Eigen::Vector3d p_WL = Eigen::Vector3d::Zero();      ///< Origin of L in W.
  Eigen::Vector3d w_WL = Eigen::Vector3d::Zero();      ///< Angular velocity in W.
  Eigen::Vector3d v_WL = Eigen::Vector3d::Zero();      ///< Velocity of the origin in W.

  [[nodiscard]] Eigen::Vector3d pointAt(const Eigen::Vector3d& p_L) const {
    return p_WL + R_WL * p_L;
  }
  [[nodiscard]] Eigen::Vector3d velocityAt(const Eigen::Vector3d& p_L) const {
    return v_WL + w_WL.cross(R_WL * p_L);
  }
  /// Velocity of the link's point that is at `p_W` in W.
  [[nodiscard]] Eigen::Vector3d velocityOf(const Eigen::Vector3d& p_W) const {
    return v_WL + w_WL.cross(p_W - p_WL);
  }
};

/// Bounds that hold at every t in [0,1], for one link. A point of the link at distance rho from its
/// origin has |velocity| <= speed + angularSpeed*rho and
/// |acceleration| <= acceleration + (angularAcceleration + angularSpeed^2)*rho.
/// Derived in articulated/motion_bounds.md; rounded up, so that they also hold for the computed
/// motion.
struct MotionBounds {
  double angularSpeed = 0.0;
  double angularAcceleration = 0.0;
  double speed = 0.0;         ///< The speed of the link's origin.
  double acceleration = 0.0;  ///< The acceleration of the link's origin.
  double reach = 0.0;         ///< The distance from the world's origin to the link's.
  /// |d^8/dt^8| of the link's origin: bounds the error of interpolation through eight instants
  /// (tessellation/lss_polynomials.md).
  double eighthDerivative = 0.0;
  /// Bounds on |computed - true| of LinkState's p_WL (m), R_WL (spectral norm), v_WL and w_WL.
  double originRounding = 0.0;
  double rotationRounding = 0.0;
  double velocityRounding = 0.0;
  double spinRounding = 0.0;

  [[nodiscard]] double speedAt(double rho) const { return speed + angularSpeed * rho; }
  [[nodiscard]] double accelerationAt(double rho) const {
    return acceleration + (angularAcceleration + angularSpeed * angularSpeed) * rho;
  }
  [[nodiscard]] double eighthDerivativeAt(double rho) const {
    const double square = angularSpeed * angularSpeed, fourth = square * square;
    return eighthDerivative + fourth * fourth * rho;
  }
  /// Bounds on LinkState::pointAt()'s and velocityAt()'s rounding at distance rho, sums included.
  [[nodiscard]] double positionRoundingAt(double rho) const {
    return originRounding + (rotationRounding + kPointRounding) * rho +
           kPointRounding * (reach + rho);
  }
  [[nodiscard]] double velocityRoundingAt(double rho) const {
    return velocityRounding +
           (spinRounding + angularSpeed * (rotationRounding + kPointRounding)) * rho +
           kPointRounding * speedAt(rho);
  }
  /// Sixteen unit roundoffs: a matrix times a vector, a cross product and a sum (motion_bounds.md
  /// 3).
  static constexpr double kPointRounding = 16.0 * kUnitRoundoff;
};

/// The sums along a link's chain that its bounds are made of, as computed: rounding may have
/// lowered them (motion_bounds.md 2). One cache line.
struct ChainSums {
  double angularSpeed = 0.0, angularAcceleration = 0.0, speed = 0.0, acceleration = 0.0;
  double eighthDerivative = 0.0;
  double armReach = 0.0;   ///< The distance from its root's origin to the link's (m).
  double rootReach = 0.0;  ///< The distance from the world's origin to the root's (m).
  double depth = 0.0;      ///< Joints of the chain, the root and the link's own included.

  /// The bounds, rounded up, with those on rounding that follow (motion_bounds.md 3). O(1).
  [[nodiscard]] MotionBounds bounds() const;
  /// As bounds().accelerationAt(rho), for callers that need nothing else.
  [[nodiscard]] double accelerationAt(double rho) const {
    return kChainInflation *
           (acceleration + (angularAcceleration + angularSpeed * angularSpeed) * rho);
  }

  /// Covers the rounding of sums along kMaxChainDepth joints, and of the values made from them.
  static constexpr double kChainInflation = 1.0 + 2e-12;
};

/// One joint's motion in its parent's frame (roots: in W), from the poses: slerp on the arc from
/// `from` to `to`, whose dot product as stored is not negative, and from `translation` by `drift`
/// per unit of t. Quaternions w, x, y, z, unit within 12 u (motion_bounds.md 2).
struct JointArc {
  double from[4], to[4];
  double translation[3], drift[3];
  double versine =
      0.0;  ///< 1 - cos of half the joint's turn: |to - from|^2/2; in [0,1] to rounding.
  double length = 0.0;       ///< Bound on |translation + t*drift| over t in [0,1].
  double driftLength = 0.0;  ///< Bound on |drift|.
  JointId parent = kNoParent;
};

/// The in-between motion of one skeleton from one validated pose to another. Constant between calls
/// of assign(); evaluation is const, thread-safe and allocates nothing. Building costs O(joints)
/// and no trigonometry; a state O(depth of the link), trigonometry included. For many states of one
/// motion use a MotionEvaluator.
class ChainMotion {
 public:
  /// No links, until assign().
  ChainMotion() = default;
  /// As assign().
  ChainMotion(const Skeleton& skeleton, const Pose& from, const Pose& to);

  /// Becomes the motion from `from` to `to`; allocates only if there are more joints than ever
  /// before. Precondition: both poses were made for `skeleton` by validatedPose() or restPose()
  /// (asserted).
  void assign(const Skeleton& skeleton, const Pose& from, const Pose& to);

  [[nodiscard]] std::int32_t numLinks() const { return static_cast<std::int32_t>(sums_.size()); }

  /// `t` in [0,1].
  [[nodiscard]] LinkState stateAt(LinkId link, double t) const;

  /// All links at once, in order; `states` is resized. O(joints).
  void statesAt(double t, std::vector<LinkState>& states) const;

  /// The parent-relative pose at `t` in [0,1], the given ones at both ends: a motion from it, or to
  /// it, runs along the same path, to rounding. `pose` is resized. O(joints).
  void poseAt(double t, Pose& pose) const;

  [[nodiscard]] MotionBounds bounds(LinkId link) const { return sums(link).bounds(); }
  /// The same bounds on the link's motion in the frame of a link above it, where only the joints
  /// below `frame` move; in W if that is kNoParent. Never above those in W. `frame` is the link
  /// itself or above it (asserted). O(depth below the frame).
  [[nodiscard]] ChainSums sumsIn(LinkId frame, LinkId link) const;
  /// The sums that bounds() is made of.
  [[nodiscard]] const ChainSums& sums(LinkId link) const { return sums_[slotOf(link)]; }
  /// The largest angularSpeed, eighthDerivative, armReach and depth of all links' sums, each by
  /// itself; the other fields mean nothing.
  [[nodiscard]] const ChainSums& largestSums() const { return largest_; }
  /// The arc of the joint that moves the link.
  [[nodiscard]] JointArc arc(LinkId link) const;
  [[nodiscard]] JointId parent(LinkId link) const { return parents_[slotOf(link)]; }
  /// Bounds on the link's joint in its parent's frame over t in [0,1]: its turn (rad), the length
  /// of its arm and of its drift (m). The sums are made of these.
  struct JointBounds {
    double turn, length, driftLength;
  };
  [[nodiscard]] JointBounds jointBounds(LinkId link) const;
  /// The largest versine of all joints' arcs; 0 without joints.
  [[nodiscard]] double largestVersine() const { return largestVersine_; }

 private:
  friend class ChainNodes;

  std::vector<double> arcs_;  // internal::JointColumns, joint after joint
  std::vector<JointId> parents_;
  std::vector<ChainSums> sums_;
  ChainSums largest_;
  double largestVersine_ = 0.0;
};

/// States of one motion after another, bit for bit those of ChainMotion, but does the trigonometry
/// that does not depend on t once per joint and motion. For one thread; keeps its memory.
class MotionEvaluator {
 public:
  MotionEvaluator() = default;
  explicit MotionEvaluator(const ChainMotion& motion) { reset(motion); }

  /// Evaluates `motion` from now on, which must outlive the last call and must not be assigned to.
  void reset(const ChainMotion& motion);
  /// Precondition: reset() was called.
  [[nodiscard]] const ChainMotion& motion() const { return *motion_; }

  /// `t` in [0,1]. O(depth of the link).
  [[nodiscard]] LinkState stateAt(LinkId link, double t);
  /// The link's state in the frame of a link above it, as ChainMotion::sumsIn() bounds it:
  /// rotation, place and velocities as an observer on `frame` sees them. O(depth below the
  /// frame).
  [[nodiscard]] LinkState stateIn(LinkId frame, LinkId link, double t);
  /// All links at once, in order; `states` is resized. O(joints).
  void statesAt(double t, std::vector<LinkState>& states);

  /// One joint's own motion in its parent's frame: R(t) = R0 + sin(angle*t)*S + (1-cos(angle*t))*C.
  struct JointMotion {
    Eigen::Matrix3d R0, S, C;
    Eigen::Vector3d translation, translationRate;  ///< Parent frame.
    Eigen::Vector3d rotationRate;  ///< Parent frame; constant, as the axis is fixed.
    double angle = 0.0;
    JointId parent = kNoParent;
  };

 private:
  [[nodiscard]] const JointMotion& joint(JointId joint);

  const ChainMotion* motion_ = nullptr;
  std::vector<JointMotion> joints_;
  std::vector<std::uint8_t> isKnown_;
};

inline MotionBounds ChainSums::bounds() const {
  // For one joint's rotation, its rate, and one product, in units of the roundoff (motion_bounds.md
  // 3).
  constexpr double kJointRotation = 128.0 * kUnitRoundoff, kJointRate = 64.0 * kUnitRoundoff,
                   kProduct = 16.0 * kUnitRoundoff, kSum = 2.0 * kUnitRoundoff,
                   kVelocitySum = 4.0 * kUnitRoundoff;
  const double frame = (depth - 1.0) * (kJointRotation + kProduct) + kProduct;
  const double reach = rootReach + armReach;
  const double spinRounding =
      (frame + kJointRate + kSum * depth) * angularSpeed + kJointRate * depth;
  MotionBounds b;
  b.angularSpeed = angularSpeed * kChainInflation;
  b.angularAcceleration = angularAcceleration * kChainInflation;
  b.speed = speed * kChainInflation;
  b.acceleration = acceleration * kChainInflation;
  b.reach = reach * kChainInflation;
  b.eighthDerivative = eighthDerivative * kChainInflation;
  b.originRounding =
      (kProduct * rootReach + frame * armReach + kSum * depth * reach) * kChainInflation;
  b.rotationRounding = depth * (kJointRotation + kProduct) * kChainInflation;
  b.velocityRounding = ((spinRounding + 2.0 * frame * angularSpeed) * armReach +
                        (frame + kVelocitySum * depth) * speed) *
                       kChainInflation;
  b.spinRounding = spinRounding * kChainInflation;
  return b;
}

}  // namespace foretouch
