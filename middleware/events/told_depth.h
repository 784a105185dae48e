// middleware/events/told_depth.h: how deep what starts in contact is, as it is reported to others:
// in LinkContact, WorldContact and WorldEvent 0 also stands for an unknown depth.
#pragma once

#include <limits>

#include "middleware/contact.h"
#include "middleware/events/world_event.h"
#include "middleware/world/world_contacts.h"

namespace foretouch {

/// Metres. NaN: it starts in contact, and nothing says how deep. So it is for triangles, which have
/// no inside: at exact and skinned fidelity, and for meshes that meet.
inline constexpr double kUnknownDepth = std::numeric_limits<double>::quiet_NaN();

[[nodiscard]] inline double toldDepth(bool startsInside, double penetration) {
  return startsInside && !(penetration > 0.0) ? kUnknownDepth : penetration;
}
[[nodiscard]] inline double toldDepth(const LinkContact& contact) {
  return toldDepth(contact.verdict == Verdict::StartsInContact, contact.penetration);
}
[[nodiscard]] inline double toldDepth(const WorldContact& contact) {
  return toldDepth(contact.verdict == Verdict::StartsInContact, contact.penetration);
}
[[nodiscard]] inline double toldDepth(const WorldEvent& event) {
  return toldDepth(event.kind == EventKind::StartsInside, event.penetration);
}

}  // namespace foretouch
