// middleware/mechanics/tree_inertia.h: M = sum J^T w J + diag(a), the inertia of points of mass on
// a tree of joints, and its inverse, without a matrix: articulated bodies ([Featherstone08] 7,
// REFERENCES.md) about one origin. The unknowns: a rotation vector in W per joint, and a
// translation per root. Derivation: middleware/solid/solid.md 3. Not installed.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "articulated/skeleton.h"

namespace foretouch::internal {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Matrix63d = Eigen::Matrix<double, 6, 3>;

/// What a small motion does to the points of one link: x moves by v + w x (x - origin).
struct Twist {
  Eigen::Vector3d w = Eigen::Vector3d::Zero(), v = Eigen::Vector3d::Zero();
  [[nodiscard]] Eigen::Vector3d at(const Eigen::Vector3d& x) const { return v + w.cross(x); }
};

/// A force `f` at `x`, both relative to the origin: its moment, then the force itself.
[[nodiscard]] inline Vector6d wrench(const Eigen::Vector3d& x, const Eigen::Vector3d& f) {
  Vector6d all;
  all << x.cross(f), f;
  return all;
}

/// One joint's part of a force's way to the root, as the factors see it; products of two rows'
/// parts are J M^-1 J^T.
struct WayPart {
  JointId joint;  ///< Its turn; ~joint: its translation (of a root).
  Eigen::Vector3d force, weighted;
};

class TreeInertia {
 public:
  /// `leastMass` (kg) is added to what a root's translation moves: above 0 if a root may carry
  /// nothing.
  void reset(const std::vector<JointId>& parents, double leastMass = 1e-9);

  /// Begins anew: no mass. `origins`: the joints', relative to the common origin.
  void begin();
  void setOrigin(JointId joint, const Eigen::Vector3d& origin);
  /// A point of the link, relative to the common origin.
  void addPoint(JointId link, const Eigen::Vector3d& x, double weight);
  /// The same with an inertia of its own about that point, axes of W.
  void addBody(JointId link, const Eigen::Vector3d& x, double weight,
               const Eigen::Matrix3d& inertia);
  /// `stiffness[j]` is a_j, > 0. O(joints).
  void factor(const std::vector<double>& stiffness);

  /// The change of pose that forces cause: M^-1 (sum J^T forces + torques). `forces`: one wrench
  /// per link; `torques`: one per joint, in W. Gives each joint's turn, each root's translation
  /// (zero for the others), and each link's twist. O(joints).
  void solve(const std::vector<Vector6d>& forces, const std::vector<Eigen::Vector3d>& torques,
             std::vector<Eigen::Vector3d>& turns, std::vector<Eigen::Vector3d>& shifts,
             std::vector<Twist>& twists);

  /// Appends the way of a wrench on `link`, and of another on `other` (kNoParent: none), leaves
  /// first. O(depth).
  void appendWay(LinkId link, const Vector6d& force, LinkId other, const Vector6d& otherForce,
                 std::vector<WayPart>& way) const;
  /// J M^-1 J^T of two ways.
  [[nodiscard]] static double product(const WayPart* one, const WayPart* oneEnd,
                                      const WayPart* other, const WayPart* otherEnd);

 private:
  struct Node {
    Matrix6d inertia;             // articulated, of the link and all below it
    Matrix63d U;                  // inertia times the joint's motions
    Eigen::Matrix3d inverse;      // of D
    Matrix63d share;              // U D^-1
    Eigen::Matrix3d rootInverse;  // of a root's translation
    Eigen::Vector3d origin;
    JointId parent;
  };
  [[nodiscard]] static Eigen::Vector3d momentAbout(const Eigen::Vector3d& origin,
                                                   const Vector6d& force) {
    return force.head<3>() - origin.cross(force.tail<3>());
  }
  void appendPart(const Node& node, JointId joint, Vector6d& force,
                  std::vector<WayPart>& way) const;

  std::vector<Node> nodes_;
  double leastMass_ = 0.0;
  std::vector<Vector6d> forces_;  // while solving
  std::vector<Eigen::Vector3d> inner_;
};

}  // namespace foretouch::internal
