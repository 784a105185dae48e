// articulated/robot.h: an avatar whose joints move by coordinates, as a robot's do: angles about
// fixed axes and shifts along them. A configuration q has one number per coordinate (radians or
// metres). A joint's frame in its parent's is its rest frame, then its own motion:
// T_rest * T_joint(q). So a configuration of zeros is the rest pose.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "articulated/result.h"
#include "articulated/skeleton.h"

namespace foretouch {

enum class RobotJointKind : std::uint8_t {
  Fixed,
  Revolute,    ///< One angle (rad), between limits; may turn by more than one half or one turn.
  Continuous,  ///< One angle without limits. 0 and 2 pi are one place, but two configurations.
  Prismatic,   ///< One shift along the axis (m).
  Planar,      ///< A mobile base: x, y (m) in the plane across the axis, and the angle about it.
};

/// How a joint moves against its parent, as an author or a file gives it.
struct RobotJoint {
  RobotJointKind kind = RobotJointKind::Fixed;
  std::string name;  ///< The coordinate's; empty: the name of the skeleton's joint.
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< In the joint's frame; any length but 0.
  double lower = -kUnlimited, upper = kUnlimited;   ///< For Revolute and Prismatic.
  /// The joint follows another one: its own coordinate is factor * (the other's) + offset.
  JointId mimicOf = kNoParent;
  double mimicFactor = 1.0, mimicOffset = 0.0;

  static constexpr double kUnlimited = std::numeric_limits<double>::infinity();
};

/// One number of a configuration.
struct RobotCoordinate {
  std::string name;  ///< For a planar joint: NAME/x, NAME/y, NAME/angle.
  JointId joint = 0;
  double lower = -RobotJoint::kUnlimited, upper = RobotJoint::kUnlimited;
  bool isAngle = true;      ///< Radians; else metres.
  bool isPeriodic = false;  ///< A whole turn leads to the same place.
};

/// No number of a configuration may be larger: rounding is proportional to it
/// (articulated/robot.md).
inline constexpr double kMaxJointCoordinate = 1000.0;

/// Two unit vectors across a unit axis, along which a planar joint is shifted: for z, x and y.
[[nodiscard]] std::pair<Eigen::Vector3d, Eigen::Vector3d> planeAcross(const Eigen::Vector3d& axis);

/// A number that is not within its limits.
struct LimitBreach {
  std::int32_t coordinate = -1;  ///< Its place in q; -1: none.
  JointId joint = kNoParent;     ///< The joint whose limit it is: the coordinate's, or one that
                                 ///< follows it.
  double value = 0.0, lower = 0.0, upper = 0.0;

  [[nodiscard]] bool isAny() const { return joint != kNoParent; }
};

/// A list of configurations as poses, for code that knows only poses and turns each joint on the
/// shorter arc between two of them (articulated/motion.h): this way the joint moves as q says.
struct RobotPath {
  std::vector<Pose> poses;
  std::vector<double> at;  ///< Where each lies: i + t on the edge from configuration i to i + 1.
};

/// Immutable; copies share nothing and are cheap enough for set-up only.
class Robot {
 public:
  /// One joint per joint of the avatar's skeleton. Errors (Error::index is the joint): another
  /// number of joints, an axis that is zero or not finite, a lower limit above the upper one, a
  /// limit or a factor that is NaN, and a joint that follows itself, a joint that does not move,
  /// a planar one, or one that follows another one.
  static Result<Robot> build(Avatar avatar, std::vector<RobotJoint> joints);

  [[nodiscard]] const Avatar& avatar() const { return avatar_; }
  [[nodiscard]] const std::vector<RobotJoint>& joints() const { return joints_; }
  /// In the order of the skeleton's joints.
  [[nodiscard]] const std::vector<RobotCoordinate>& coordinates() const { return coordinates_; }
  [[nodiscard]] std::size_t numCoordinates() const { return coordinates_.size(); }

  /// The robot with a rigid tool: a link of its own, fixed to `link`, with these LSS in the frame
  /// of `link` (m). Its pairs with other links than `link` are asked like those of any link.
  /// Errors: an unknown link, a name that is taken, no LSS or bad ones.
  [[nodiscard]] Result<Robot> withTool(LinkId link, const std::string& name,
                                       std::vector<Lss> lss) const;

  /// Error unless q has numCoordinates() finite numbers within kMaxJointCoordinate
  /// (Error::index is the place in q).
  [[nodiscard]] Result<Done> checked(const double* q, std::size_t count) const;
  /// The first coordinate of q outside its limits, those of joints that follow it included. A
  /// straight line between two configurations within limits stays within them.
  [[nodiscard]] LimitBreach breachOf(const double* q) const;
  /// O(joints); allocates nothing once `pose` has its size. Precondition: checked().
  void poseAt(const double* q, Pose& pose) const;
  /// The most that any joint turns from q0 to q1 (rad).
  [[nodiscard]] double largestTurn(const double* q0, const double* q1) const;
  /// Into how many equal parts the edge from q0 to q1 has to be cut so that no joint turns by more
  /// than kMostTurn in one: a power of two, at most `most`; 0: that is not enough.
  [[nodiscard]] int partsBetween(const double* q0, const double* q1, int most) const;
  /// q0 + t*(q1 - q0), the ends themselves at t = 0 and 1.
  void between(const double* q0, const double* q1, double t, double* q) const;
  /// The poses at `count` configurations, one after the other in `q`, and between two of them as
  /// many as partsBetween() asks for. Errors: those of checked(), no configuration, and an edge
  /// of more than kMostParts parts (Error::index is its place).
  [[nodiscard]] Result<RobotPath> pathAlong(const double* q, std::size_t count) const;
  /// Poses at `count` configurations drawn evenly within the limits, those of mimics included;
  /// unlimited angles are within a half turn, unlimited shifts within a metre. A mobile base stays.
  /// The same on every machine. Errors: a count below 1, and limits of mimics that leave hardly
  /// any.
  [[nodiscard]] Result<std::vector<Pose>> sampledPoses(std::int32_t count,
                                                       std::uint64_t seed) const;
  /// The number that a joint moves by: its own, or what it gets from the joint that it follows.
  [[nodiscard]] double valueOf(JointId joint, const double* q) const;

  /// By how much a point of a link at p_W moves along `along_W` per unit of each coordinate, at
  /// configuration q (m per rad or m, times the length of `along_W`). `states`: of all links there.
  /// O(depth of the link). Precondition: checked(); `slope` has numCoordinates() numbers.
  void slopeAt(const double* q, const std::vector<LinkState>& states, LinkId link,
               const Eigen::Vector3d& p_W, const Eigen::Vector3d& along_W, double* slope) const;

  /// No point of a link's LSS is farther from where exact arithmetic puts it (m), in poseAt() and
  /// on the shorter arc between two of them that lie at most kMostTurn apart, whatever the
  /// configuration. Proof: articulated/robot.md.
  [[nodiscard]] double poseRounding() const { return poseRounding_; }
  /// No point of an axis of its LSS is ever farther from the origin of W (m).
  [[nodiscard]] double reach() const { return reach_; }
  /// Radians. Below a half turn by enough that the shorter arc is the joint's own.
  static constexpr double kMostTurn = 3.0;
  /// Parts of an edge: 12,288 rad, which only a mimic's factor reaches (kMaxJointCoordinate).
  static constexpr int kMostParts = 4096;

 private:
  Robot(Avatar avatar, std::vector<RobotJoint> joints)
      : avatar_(std::move(avatar)), joints_(std::move(joints)) {}
  void listCoordinates();
  void boundRounding();

  Avatar avatar_;
  std::vector<RobotJoint> joints_;  // axes are unit
  std::vector<RobotCoordinate> coordinates_;
  std::vector<std::int32_t> firstCoordinate_;  // per joint: its own, or of the one it follows
  double poseRounding_ = 0.0, reach_ = 0.0;
};

}  // namespace foretouch
