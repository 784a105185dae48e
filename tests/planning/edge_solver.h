// tests/planning/edge_solver.h: whether an arm meets a scene on an edge, by Foretouch and by those
// that planners have used so far. All see the same links, the same scene and the same kinematics.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/planning/plan_stage.h"

namespace foretouch::test {

/// One way with one setting. What a planner would prepare once, the constructor prepares.
class EdgeSolver {
 public:
  explicit EdgeSolver(std::string name) : name_(std::move(name)) {}
  EdgeSolver(const EdgeSolver&) = delete;
  EdgeSolver& operator=(const EdgeSolver&) = delete;
  virtual ~EdgeSolver() = default;
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] virtual bool touches(const std::vector<double>& q0,
                                     const std::vector<double>& q1) = 0;

 private:
  std::string name_;
};
using EdgeSolvers = std::vector<std::unique_ptr<EdgeSolver>>;

/// Sampled as OMPL samples a space of real numbers, at shares of its extent (the norm of all
/// ranges): fcl::collide() of each link's capsules and the scene, by the two ways that FCL has to
/// tell whether a capsule meets a triangle (libccd, its default, and its own). And
/// fcl::continuousCollide() by its default method, at a number of samples: it knows two poses of
/// each link and what FCL has between them, which is not the arm's motion.
[[nodiscard]] EdgeSolvers fclEdgeSolvers(const PlanStage& stage,
                                         const std::vector<double>& resolutions,
                                         const std::vector<int>& continuousSamples);

}  // namespace foretouch::test
