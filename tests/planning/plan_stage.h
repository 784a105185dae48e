// tests/planning/plan_stage.h: robots among obstacles, for campaigns of plans.
#pragma once

#include <optional>
#include <random>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "articulated/robot.h"
#include "lss/lss.h"
#include "middleware/edges/edge_query.h"

namespace foretouch::test {

/// "panda" or "iiwa", by the one helper to shared data; nothing if it is absent.
std::optional<Result<Robot>> sharedRobot(const std::string& name);

/// A robot at the origin (+Z up) and what stands around it. The link that stands on the floor is
/// not asked.
struct PlanStage {
  std::string name;
  std::vector<Triangle> triangles;
  std::optional<EdgeQuery> edges;  ///< Own links are not asked.
  std::vector<LinkId> left;        ///< Links that are not asked.

  /// Within limits, the coordinates without any within a turn.
  [[nodiscard]] std::vector<double> draw(std::mt19937_64& random) const;
  [[nodiscard]] std::vector<double> drawFree(std::mt19937_64& random, Scratch& scratch) const;
};

/// "wires-20", "wires-10", "wires-4" (mm thick), "shelf", and of shared data "office", "kitchen",
/// placed so that a quarter to three quarters of all configurations are free. Nothing: absent.
std::optional<PlanStage> planStage(const std::string& name, const Robot& robot, unsigned seed);

}  // namespace foretouch::test
