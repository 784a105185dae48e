// bench/solid/engine_hands.h: the hands of a physics engine, where one is built in (CMake option
// FORETOUCH_PEERS).
#pragma once

#include <memory>
#include <vector>

#include "bench/peers/hand_follower.h"
#include "lss/lss.h"

namespace foretouch::tools {

class BulletHands;

class EngineHands {
 public:
  explicit EngineHands(const std::vector<Triangle>& triangles);
  EngineHands(const EngineHands&) = delete;
  EngineHands& operator=(const EngineHands&) = delete;
  ~EngineHands();

  /// None if no engine is built in. The axis' middle is the frame's origin.
  [[nodiscard]] HandFollowers of(const Lss& hand_L) const;

 private:
  std::shared_ptr<const BulletHands> bullet_;
};

}  // namespace foretouch::tools
