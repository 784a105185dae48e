#include "tools/touches/touch.h"

#include <tuple>

namespace foretouch::tools {

bool isListedBefore(const Touch& x, const Touch& y) {
  return std::tie(x.beginS, x.link, x.object, x.other, x.firstStep) <
         std::tie(y.beginS, y.link, y.object, y.other, y.firstStep);
}

void TouchCounts::add(const Touch& touch) {
  if (touch.other >= 0) {
    ++own;
  } else if (touch.isGround) {
    ++ground;
  } else {
    ++touches;
    missed += touch.isMissed ? 1 : 0;
  }
}

}  // namespace foretouch::tools
