// tools/settings/ground_rule.h: what counts as contact with the ground (docs/concepts.md,
// "Touches"): scenes do not say which of their objects is a floor.
#pragma once

#include <cstdint>

namespace foretouch::tools {

/// What becomes of touches of the ground.
enum class GroundUse : std::uint8_t {
  Keep,    ///< They are touches like any other: nothing is called ground.
  Apart,   ///< They are marked, and counted apart.
  Ignore,  ///< They are counted, and not listed. The contacts of the steps are all there.
};

struct GroundRule {
  GroundUse use = GroundUse::Apart;
  /// The most between the contact's normal and up. 45 is what character controllers take as
  /// walkable; a wall that leans so far back counts as ground.
  double angleDeg = 45.0;
  /// The most height of the contact above the body's lowest point at that instant (m). The steps of
  /// stairs are lower, seats and tables higher. Doubled, a chair that a person sits on is ground.
  double heightM = 0.25;
};

}  // namespace foretouch::tools
