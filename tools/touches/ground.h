// tools/touches/ground.h: which contacts are with the ground: those whose normal points up and that
// are near the body's lowest point.
#pragma once

#include <optional>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "middleware/contact.h"
#include "middleware/scene/scene.h"
#include "tools/settings/ground_rule.h"

namespace foretouch::tools {

/// Decides for the contacts of one motion after another.
class GroundTest {
 public:
  /// `avatar` and `scene` must outlive it.
  GroundTest(const Avatar& avatar, const Scene& scene, const GroundRule& rule);

  /// `motion` must outlive the calls of isGround() after it.
  void beginStep(const ChainMotion& motion);
  /// Whether a contact with the scene in this motion's answer is with the ground. Undecided: false.
  [[nodiscard]] bool isGround(const LinkContact& contact);

 private:
  [[nodiscard]] double upOf(const LinkContact& contact) const;
  [[nodiscard]] double lowestAt(double t);

  const Avatar& avatar_;
  const Scene& scene_;
  bool isAsked_;
  double leastUp_, heightM_;
  const ChainMotion* motion_ = nullptr;
  std::optional<double> lowestAtStartM_;
  std::vector<LinkState> states_;
};

}  // namespace foretouch::tools
