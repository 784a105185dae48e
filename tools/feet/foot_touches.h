// tools/feet/foot_touches.h: the touches of whole feet and hands, which consist of their parts'
// stances. Metres and seconds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tools/feet/feet_answer.h"
#include "tools/feet/feet_inputs.h"

namespace foretouch::tools {

/// Lasts from when the first part touches until no part does. What lies under the ground counts on.
struct FootTouch {
  std::size_t limb = 0;
  double fromS = 0.0, toS = 0.0;
  std::int64_t fromFrame = 0, toFrame = 0;
  bool beganBefore = false, goesOn = false;  ///< As in PartContact.
  double slide = 0.0;                        ///< The slide of the part that slides farthest.
  double depth = 0.0;                        ///< The depth of the part that is deepest.
  /// The stances that have these; they live in the answer.
  const FootStance *worstSlide = nullptr, *deepest = nullptr;

  [[nodiscard]] double durationS() const { return toS - fromS; }
  /// The greater of slide and depth, by which the touch is judged.
  [[nodiscard]] double badness() const { return slide > depth ? slide : depth; }
};

/// The touches by limb, then by time. `answer` outlives them.
[[nodiscard]] std::vector<FootTouch> footTouchesOf(const FeetInputs& inputs,
                                                   const FeetAnswer& answer);

}  // namespace foretouch::tools
