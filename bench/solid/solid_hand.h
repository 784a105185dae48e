// bench/solid/solid_hand.h: a solid avatar of one hand, to stand beside the hands of a physics
// engine.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/peers/hand_follower.h"
#include "bench/solid/way_audit.h"
#include "middleware/solid/solid_avatar.h"

namespace foretouch::tools {

/// Follows with the avatar handAlone(); the judge looks.
class SolidHand final : public HandFollower {
 public:
  /// Errors: those of SolidAvatar::build().
  static Result<std::unique_ptr<SolidHand>> build(std::string name, const RawScene& raw,
                                                  const SolidOptions& options);

  void begin(const RigidPose& at) override;
  RigidPose follow(const RigidPose& tracked, double dtS) override;
  void look() override { audit_.look(tick_); }

  [[nodiscard]] const WayTally& way() const { return audit_.tally(); }
  [[nodiscard]] const SolidTick& tick() const { return tick_; }

 private:
  SolidHand(std::string name, SolidAvatar solid, const std::vector<Triangle>& triangles);

  SolidAvatar solid_;
  oracle::Scene judged_;
  WayAudit audit_;
  Pose target_;
  SolidTick tick_;
};

}  // namespace foretouch::tools
