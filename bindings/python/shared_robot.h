// bindings/python/shared_robot.h: what stands behind foretouch.Robot.
#pragma once

#include <memory>

#include "articulated/robot.h"

namespace foretouch::python {

/// A robot, and its avatar as Python's own.
struct SharedRobot {
  std::shared_ptr<Robot> robot;
  std::shared_ptr<Avatar> avatar;
};

}  // namespace foretouch::python
