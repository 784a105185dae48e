// tests/middleware/solid_world/together_campaign.h: solid avatars among doors, lifts, balls, rods,
// tools and each other, at random and with malice, every tick judged.
#pragma once

#include <cstdint>
#include <string>

#include "tests/middleware/solid_world/together_runner.h"

namespace foretouch::test {

struct TogetherCampaign {
  std::uint64_t seed = 0;
  int ticks = 300;
  double rateHz = 90.0;
  int instants = 50;  ///< At which each tick is looked at.
  /// As TogetherRunner::tamper.
  std::function<void(std::vector<SolidBodyTick>&)> tamper = nullptr;
};

/// What the seed says: the room, who is in it, and what they do.
[[nodiscard]] TogetherTally judgeTogether(const TogetherCampaign& campaign);
/// One line of counts.
[[nodiscard]] std::string summaryOf(const TogetherTally& tally);

}  // namespace foretouch::test
