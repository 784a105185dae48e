// bench/peers/hand_follower.h: a hand of one LSS that follows a tracked one: what solid avatars
// and the hands of a physics engine have in common.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/peers/rigid_sweep.h"

namespace foretouch::tools {

class HandFollower {
 public:
  explicit HandFollower(std::string name) : name_(std::move(name)) {}
  HandFollower(const HandFollower&) = delete;
  HandFollower& operator=(const HandFollower&) = delete;
  virtual ~HandFollower() = default;

  [[nodiscard]] const std::string& name() const { return name_; }
  /// Begins anew, at rest.
  virtual void begin(const RigidPose& at) = 0;
  /// Where it is `dtS` later, while the tracked hand moves to `tracked`.
  virtual RigidPose follow(const RigidPose& tracked, double dtS) = 0;
  /// Called after each follow(): judges it, if a judge is there. Not part of the cost.
  virtual void look() {}

 private:
  std::string name_;
};
using HandFollowers = std::vector<std::unique_ptr<HandFollower>>;

}  // namespace foretouch::tools
