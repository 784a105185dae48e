// tools/setup/offer.h: a value that files suggest for a setting, and why. Never taken in silence.
#pragma once

#include <string>

namespace foretouch::tools {

template <typename Value>
struct Offer {
  Value value{};
  bool isSure = false;  ///< False: a person should look; `reason` says what speaks for it.
  std::string reason;   ///< Half a sentence: "a person of 1.74 m, by the length of the legs".
};

}  // namespace foretouch::tools
