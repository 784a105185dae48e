// tools/reported_contact.h: a contact kept after its step, for a summary, a view document or a GLB.
#pragma once

#include <cstdint>
#include <string>

#include "middleware/contact.h"

namespace foretouch::tools {

struct ReportedContact {
  LinkContact contact;  ///< The contact of a link that is not clear.
  std::int64_t step = 0;
  // Not read for undecided links.
  double timeS = 0.0;           ///< Seconds on the document's clock.
  std::string object;           ///< The object touched; may be empty if a scene is available. For
                                ///< own links, the other link's name.
  bool missedByPoses = false;   ///< No touch at either pose.
  LinkId other = -1;            ///< The link that takes the place of the scene; -1: none. An own
                                ///< link, if the next field is negative.
  std::int32_t otherBody = -1;  ///< That link's body: the number of another avatar of the document.
};

/// The time of contact, in a step from `t0S` to `t1S`.
[[nodiscard]] inline double timeOf(const LinkContact& contact, double t0S, double t1S) {
  return t0S + contact.toi * (t1S - t0S);
}

}  // namespace foretouch::tools
