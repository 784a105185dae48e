// bindings/python/motion.h: a motion and its avatar.
#pragma once

#include <memory>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "articulated/pose.h"

namespace foretouch::python {

struct Motion {
  std::shared_ptr<Avatar> avatar;
  Pose start, end;
  ChainMotion chain;
};

}  // namespace foretouch::python
