#include "tools/replay/ray_set.h"

namespace foretouch::tools {

std::array<RaySegment, kRaysPerSet> raysAlong(const ChainMotion& motion) {
  std::array<RaySegment, kRaysPerSet> rays;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto link = static_cast<LinkId>(i) % motion.numLinks();
    rays[i] = {motion.stateAt(link, 0.0).p_WL, motion.stateAt(link, 1.0).p_WL};
  }
  return rays;
}

}  // namespace foretouch::tools
