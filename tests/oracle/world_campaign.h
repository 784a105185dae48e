// tests/oracle/world_campaign.h: clips, props, tools, doors and lifts in one world, at rates of
// their own; the judge's own world looks at every answer.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tests/middleware/world/both_worlds.h"
#include "tests/oracle/sweep_inputs.h"

namespace foretouch::test {

enum class WorldPart : std::uint8_t {
  Pairs,   ///< Two clips, of which one walks through the other.
  Thrown,  ///< A ring that flies through a clip and spins.
  Held,    ///< A sword in a clip's hand, against itself and another clip.
  Doors,   ///< A door that swings through two clips.
  Lifts,   ///< Two clips on a platform that rises and turns, by poses in its frame.
};
inline constexpr std::uint8_t kNumWorldParts = 5;
/// "pairs", "thrown", "held", "doors", "lifts".
[[nodiscard]] const char* toString(WorldPart part);

struct WorldCampaign {
  WorldPart part = WorldPart::Pairs;
  double rateHz = 30.0, otherRateHz = 90.0;
  double tolerance = 1e-3;
  int windows = 4;
  std::uint64_t seed = 1;
  std::function<void(WorldContacts&)> tamper = nullptr;  ///< As BothWorlds::tamper.
};

struct WorldCampaignTally {
  WorldTally answers;
  std::uint64_t worlds = 0, windows = 0;
  /// Two links at an instant at which the judge looks at them.
  std::uint64_t pairInstants = 0;
  std::uint64_t missed = 0, late = 0, early = 0, other = 0;  ///< Broken promises.
  std::vector<std::string> findings;                         ///< The first of them.

  [[nodiscard]] std::uint64_t violations() const { return missed + late + early + other; }
  void add(const WorldCampaignTally& more);
  /// One line of counts.
  [[nodiscard]] std::string summary() const;
};

[[nodiscard]] WorldCampaignTally judgeWorld(const SweepClip& one, const SweepClip& other,
                                            const WorldCampaign& campaign);

}  // namespace foretouch::test
