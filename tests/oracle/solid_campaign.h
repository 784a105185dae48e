// tests/oracle/solid_campaign.h: a solid avatar led through furniture by clips, at random and with
// malice; the judge of ways looks at every tick.
#pragma once

#include <cstdint>
#include <string>

#include "bench/solid/stage.h"
#include "bench/solid/way_audit.h"
#include "tests/oracle/motion_audit.h"
#include "tests/oracle/obstacles.h"

namespace foretouch::test {

enum class SolidTargets : std::uint8_t {
  Clip,     ///< The clip at a busy place.
  Random,   ///< Every joint anywhere, the root in the scene about the place; a new one every third
            ///< of a second, passed through in a straight line.
  Hostile,  ///< The clip with teleports, noise, lost joints, freezes and turned signs.
};
inline constexpr std::uint8_t kNumSolidTargets = 3;
/// "clip", "random", "hostile".
[[nodiscard]] const char* toString(SolidTargets targets);

struct SolidCampaign {
  SolidTargets targets = SolidTargets::Clip;
  double rateHz = 90.0, skin = 2e-3, seconds = 4.0;
  double sunk = 0.0;  ///< How far the tracked body is below where it belongs (m).
  Obstacles beside = Obstacles::None;
  bool self = false;  ///< Whether own links stop each other, too.
  int places = 1;
  std::uint64_t seed = 1;
};

struct SolidCampaignTally {
  tools::WayTally way;
  MotionTally motion;  ///< Of clips and random targets: hostile ones are no motion of a person.
  std::uint64_t places = 0, refused = 0;  ///< Ticks that were refused as no poses.
  void add(const SolidCampaignTally& other);
  /// One line of counts.
  [[nodiscard]] std::string summary() const;
};

[[nodiscard]] SolidCampaignTally judgeSolid(const tools::SolidStage& stage,
                                            const tools::SolidActor& actor,
                                            const SolidCampaign& campaign);

}  // namespace foretouch::test
