// tools/reported_contact.h: a contact that is kept after its step: for a summary, a view
// document, a GLB.
#pragma once

#include <cstdint>
#include <string>

#include "middleware/contact.h"

namespace foretouch::tools {

struct ReportedContact {
  LinkContact contact;  ///< Of a link that is not clear.
  std::int64_t step = 0;
  // Of undecided links none of these is read.
  double timeS = 0.0;          ///< Seconds on the document's clock.
  std::string object;          ///< What it touches; may be left empty where a scene is at hand.
  bool missedByPoses = false;  ///< Nothing is touched at either pose.
};

/// When it is touched, in a step from `t0S` to `t1S`.
[[nodiscard]] inline double timeOf(const LinkContact& contact, double t0S, double t1S) {
  return t0S + contact.toi * (t1S - t0S);
}

}  // namespace foretouch::tools
