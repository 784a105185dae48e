#include "bench/solid/engine_hands.h"

#ifdef FORETOUCH_HAS_PEERS
#include "bench/peers/peer_solvers.h"
#endif

namespace foretouch::tools {

#ifdef FORETOUCH_HAS_PEERS
EngineHands::EngineHands(const std::vector<Triangle>& triangles)
    : bullet_(std::make_shared<const BulletHands>(triangles)) {}

HandFollowers EngineHands::of(const Lss& hand_L) const {
  return bullet_->of(hand_L);
}
#else
EngineHands::EngineHands(const std::vector<Triangle>& /*triangles*/) {}

HandFollowers EngineHands::of(const Lss& /*hand_L*/) const {
  return {};
}
#endif

EngineHands::~EngineHands() = default;

}  // namespace foretouch::tools
