// bindings/c/robot_handle.h: the structs behind ft_robot and ft_edges.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "articulated/robot.h"
#include "bindings/c/handles.h"
#include "bindings/c/include/foretouch/robots.h"
#include "middleware/edges/edge_query.h"
#include "middleware/worker_pool.h"

struct ft_robot {
  static constexpr auto kMark = foretouch::c::Mark::Robot;
  static constexpr const char* kName = "robot";
  foretouch::c::Mark mark = kMark;
  foretouch::Robot robot;
  std::shared_ptr<const foretouch::c::AvatarParts> avatar;  // the robot's, for ft_robot_avatar()
};

/// For one thread.
struct ft_edges {
  static constexpr auto kMark = foretouch::c::Mark::Edges;
  static constexpr const char* kName = "edges";
  foretouch::c::Mark mark = kMark;
  foretouch::Scene scene;
  std::vector<foretouch::Scene> props;  // their scenes
  foretouch::EdgeQuery question;
  foretouch::WorkerPool pool;
  std::vector<foretouch::EdgeAnswer> answers;        // of the last list; for a path, its one
  std::vector<foretouch::EdgeClearance> clearances;  // memory
  bool hasAnswers = false;
};
