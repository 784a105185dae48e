// tests/planning/plan_judge.h: whether a robot on an edge between two configurations touches a
// scene, by kinematics of its own (rotation matrices from the joints' axes) and the judge's
// conservative advancement. Shares the robot's description with the query, and no code.
#pragma once

#include <array>
#include <vector>

#include "articulated/robot.h"
#include "judge/first_touch.h"
#include "lss/lss.h"

namespace foretouch::test {

/// A rotation, row by row, and a translation.
struct PlainFrame {
  std::array<double, 9> turn{1, 0, 0, 0, 1, 0, 0, 0, 1};
  oracle::Vec3d shift;
};

class PlanJudge {
 public:
  /// `left`: links that are not asked. Keeps what it needs.
  PlanJudge(const Robot& robot, const std::vector<Triangle>& scene, std::vector<LinkId> left);

  /// The first over all links. O(links * evaluations * log triangles).
  [[nodiscard]] oracle::FirstTouch firstTouch(const std::vector<double>& q0,
                                              const std::vector<double>& q1) const;
  /// The least separation (m) at one configuration; `bound` if nothing is nearer.
  [[nodiscard]] double separationAt(const std::vector<double>& q, double bound) const;
  /// A link's frame in W. O(depth).
  [[nodiscard]] PlainFrame frameOf(LinkId link, const std::vector<double>& q) const;

 private:
  struct Joint {
    int parent = -1;
    RobotJointKind kind = RobotJointKind::Fixed;
    PlainFrame rest;
    oracle::Vec3d axis;
    int coordinate = -1;
    double factor = 1.0, offset = 0.0;
  };
  struct Capsule {
    LinkId link = 0;
    oracle::Vec3d a, b;
    double radius = 0.0;
  };
  [[nodiscard]] double speedOf(const Capsule& capsule, const std::vector<double>& q0,
                               const std::vector<double>& q1) const;

  std::vector<Joint> joints_;
  std::vector<Capsule> capsules_;
  oracle::Scene scene_;
};

}  // namespace foretouch::test
