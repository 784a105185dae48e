// tests/oracle/world_campaign.h: clips, props, tools, doors and lifts in one world, at rates of
// their own; the judge's own world looks at every answer.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tests/middleware/events/judged_events.h"
#include "tests/middleware/world/both_worlds.h"
#include "tests/oracle/sweep_inputs.h"

namespace foretouch::test {

enum class WorldPart : std::uint8_t {
  Pairs,   ///< Two clips, of which one walks through the other.
  Thrown,  ///< A ring that flies through a clip and spins.
  Held,    ///< A sword in a clip's hand, against itself and another clip.
  Doors,   ///< A door that swings through two clips.
  Lifts,   ///< Two clips on a platform that rises and turns, by poses in its frame.
  Wild,    ///< Three small bodies whose links turn by up to half a radian from pose to pose.
  Sheets,  ///< A clip through which a stack of thin sheets flies.
};
inline constexpr std::uint8_t kNumWorldParts = 7;
/// "pairs", "thrown", "held", "doors", "lifts", "wild", "sheets".
[[nodiscard]] const char* toString(WorldPart part);

struct WorldCampaign {
  WorldPart part = WorldPart::Pairs;
  double rateHz = 30.0, otherRateHz = 90.0;
  double tolerance = 1e-3;
  int windows = 4;
  std::uint64_t seed = 1;
  std::function<void(WorldContacts&)> tamper = nullptr;  ///< As BothWorlds::tamper.
  /// Not 0: what a follower tells is sampled at so many instants, and more beside each event; first
  /// contacts are not asked. Clips' own links are asked, too.
  int eventInstants = 0;
};

struct WorldCampaignTally {
  WorldTally answers;
  std::uint64_t worlds = 0, windows = 0;
  /// Two links at an instant at which the judge looks at them.
  std::uint64_t pairInstants = 0;
  std::uint64_t missed = 0, late = 0, early = 0, other = 0;  ///< Broken promises.
  std::vector<std::string> findings;                         ///< The first of them.
  EventTally events;

  [[nodiscard]] std::uint64_t violations() const {
    return missed + late + early + other + events.violations();
  }
  void add(const WorldCampaignTally& more);
  /// One line of counts: of first contacts, and of events.
  [[nodiscard]] std::string summary() const;
  [[nodiscard]] std::string summaryOfEvents() const;
};

[[nodiscard]] WorldCampaignTally judgeWorld(const SweepClip& one, const SweepClip& other,
                                            const WorldCampaign& campaign);

}  // namespace foretouch::test
