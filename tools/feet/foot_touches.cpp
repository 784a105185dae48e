#include "tools/feet/foot_touches.h"

#include <algorithm>
#include <tuple>

namespace foretouch::tools {
namespace {

void join(const FootStance& stance, FootTouch& touch) {
  if (stance.toS > touch.toS) {
    touch.toS = stance.toS;
    touch.toFrame = stance.toFrame;
  }
  touch.beganBefore = touch.beganBefore || stance.beganBefore;
  touch.goesOn = touch.goesOn || stance.goesOn;
  if (touch.worstSlide == nullptr || stance.slide > touch.slide) {
    touch.slide = stance.slide;
    touch.worstSlide = &stance;
  }
  if (touch.deepest == nullptr || stance.depth > touch.depth) {
    touch.depth = stance.depth;
    touch.deepest = &stance;
  }
}

}  // namespace

std::vector<FootTouch> footTouchesOf(const FeetInputs& inputs, const FeetAnswer& answer) {
  const auto limbOf = [&](const FootStance& stance) { return inputs.body.parts[stance.part].limb; };
  std::vector<const FootStance*> stances;
  for (const FootStance& stance : answer.stances) {
    if (stance.kind != StanceKind::Hovers) stances.push_back(&stance);
  }
  std::stable_sort(stances.begin(), stances.end(), [&](const FootStance* x, const FootStance* y) {
    return std::make_tuple(limbOf(*x), x->fromS) < std::make_tuple(limbOf(*y), y->fromS);
  });
  std::vector<FootTouch> touches;
  for (const FootStance* const stance : stances) {
    const std::size_t limb = limbOf(*stance);
    if (touches.empty() || touches.back().limb != limb || touches.back().toS < stance->fromS) {
      FootTouch touch;
      touch.limb = limb;
      touch.fromS = touch.toS = stance->fromS;
      touch.fromFrame = touch.toFrame = stance->fromFrame;
      touches.push_back(touch);
    }
    join(*stance, touches.back());
  }
  return touches;
}

}  // namespace foretouch::tools
