// middleware/solid/follower.h: one tick of a solid avatar that has its place: from the pose shown
// before towards the target, by certified motions. The algorithm: middleware/solid/solid.md 5. Not
// installed.
#pragma once

#include <vector>

#include "middleware/solid/certifier.h"
#include "middleware/solid/solid_options.h"
#include "middleware/solid/solid_tick.h"
#include "middleware/solid/visual_body.h"

namespace foretouch::internal {

/// For one thread; keeps its memory.
class Follower {
 public:
  Follower(const Avatar& avatar, const SolidOptions& options);

  /// Moves `shown` as near to `target` as it gets in this tick. `budget`: how far any point may
  /// move (m). Appends the way to the tick, and says its contacts.
  void follow(const Pose& target, double budget, double dtS, Certifier& certifier, Pose& shown,
              SolidTick& tick);
  /// Forgets contacts.
  void reset();
  [[nodiscard]] const VisualBody& body() const { return body_; }

 private:
  VisualBody body_;
  Pose reached_;
};

}  // namespace foretouch::internal
