// tests/house/twins/padded.h: one half of a clash that ObjectNames.TwinsAreFound must find.
#pragma once

namespace foretouch::house::twins {

[[nodiscard]] inline float roundedUp(double x) {
  return static_cast<float>(x + 1e-6);
}

}  // namespace foretouch::house::twins
