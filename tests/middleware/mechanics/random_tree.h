// tests/middleware/mechanics/random_tree.h: random forests of joints with points of mass, and the same
// inertia as a matrix.
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "lss/index.h"
#include "middleware/mechanics/tree_inertia.h"
#include "tests/support/random_geometry.h"

namespace foretouch::test {

struct MassPoint {
  JointId link;
  Eigen::Vector3d x;
  double weight;
};

/// Parents before children; one in eight joints is another root.
struct RandomTree {
  std::vector<JointId> parents;
  std::vector<Eigen::Vector3d> origins;
  std::vector<MassPoint> points;
  std::vector<double> stiffness;

  RandomTree(Random& random, int joints) {
    for (int j = 0; j < joints; ++j) {
      const bool isRoot = j == 0 || random.chance(0.125);
      parents.push_back(isRoot ? kNoParent : random.below(j));
      origins.push_back(random.inBox(1.0));
      stiffness.push_back(random.magnitude(1e-6, 1e-2));
      for (int k = random.below(4); k > 0; --k) {
        points.push_back({j, origins.back() + random.inBox(0.3), random.uniform(0.01, 1.0)});
      }
    }
    points.push_back({0, origins[0] + random.inBox(0.3), 0.5});
  }

  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(parents.size()); }
  [[nodiscard]] bool isAbove(JointId joint, JointId link) const {
    for (; link != kNoParent; link = parents[slotOf(link)]) {
      if (link == joint) return true;
    }
    return false;
  }
  /// d x / d (all turns, then all joints' translations, of which only roots' move anything).
  [[nodiscard]] Eigen::MatrixXd jacobian(JointId link, const Eigen::Vector3d& x) const {
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3, 6 * size());
    for (JointId j = 0; j < size(); ++j) {
      if (!isAbove(j, link)) continue;
      for (int axis = 0; axis < 3; ++axis) {
        J.col(3 * j + axis) = Eigen::Vector3d::Unit(axis).cross(x - origins[slotOf(j)]);
      }
      if (parents[slotOf(j)] == kNoParent) {
        J.block<3, 3>(0, 3 * size() + 3 * j) = Eigen::Matrix3d::Identity();
      }
    }
    return J;
  }
  /// Translations of joints that are no roots stay where they are.
  [[nodiscard]] Eigen::MatrixXd matrix() const {
    Eigen::MatrixXd M = Eigen::MatrixXd::Zero(6 * size(), 6 * size());
    for (const MassPoint& point : points) {
      const Eigen::MatrixXd J = jacobian(point.link, point.x);
      M += point.weight * J.transpose() * J;
    }
    for (Eigen::Index j = 0; j < size(); ++j) {
      M.diagonal().segment(3 * j, 3).array() += stiffness[static_cast<std::size_t>(j)];
      const bool isRoot = parents[static_cast<std::size_t>(j)] == kNoParent;
      M.diagonal().segment(3 * size() + 3 * j, 3).array() += isRoot ? 1e-9 : 1.0;
    }
    return M;
  }
  [[nodiscard]] internal::TreeInertia inertia() const {
    internal::TreeInertia inertia;
    inertia.reset(parents);
    for (std::size_t j = 0; j < parents.size(); ++j) {
      inertia.setOrigin(static_cast<JointId>(j), origins[j]);
    }
    for (const MassPoint& point : points) inertia.addPoint(point.link, point.x, point.weight);
    inertia.factor(stiffness);
    return inertia;
  }
};

}  // namespace foretouch::test
