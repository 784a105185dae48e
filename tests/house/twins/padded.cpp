#include "tests/house/twins/padded.h"

namespace foretouch::house::twins {

// By its address, so that the header's function is in the object whatever is inlined.
float (*const volatile kPaddedRoundedUp)(double) = &roundedUp;
float padded(double x) {
  return kPaddedRoundedUp(x);
}

}  // namespace foretouch::house::twins
