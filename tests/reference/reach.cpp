#include "tests/reference/reach.h"

#include "middleware/contact.h"
#include "middleware/pair/link_query.h"
#include "middleware/scene/scene_parts.h"
#include "tessellation/aabb.h"

namespace foretouch::internal {

bool ReachProver::isClear(const ChainMotion& motion, QueryCounters& counters) const {
  // Covers the rounding of these sums, and of the roots' paths: a box is tens of thousands of
  // roundings wider than its content.
  constexpr double kReachInflation = 1.0 + 1e-11;
  Aabb box;
  for (LinkId link = 0; link < motion.numLinks(); ++link) {
    if (motion.parent(link) != kNoParent) continue;
    const JointArc arc = motion.arc(link);
    const Eigen::Vector3d start(arc.translation);
    box.add(start);
    box.add(start + Eigen::Vector3d(arc.drift));
  }
  const double reach =
      (motion.largestSums().armReach + table_.largestRho() + table_.largestRadius() + tolerance_) *
      kReachInflation;
  box.grow(reach);
  box.grow(1e-15 * box.max.cwiseAbs().maxCoeff());
  ++counters.rungTests;
  if (scene_.parts().bvh.meetsLeaf(box, counters.nodes)) return false;
  counters.settledAbove += static_cast<std::uint64_t>(motion.numLinks());
  return true;
}

bool ReachProver::answers(const QueryPlan& /*plan*/, const ChainMotion& motion,
                          const WorkMeter& /*meter*/, QueryMemory& /*scratch*/,
                          StepContacts& step) const {
  if (!isClear(motion, step.counters)) return false;
  for (LinkContact& contact : step.links) answerClear(contact);
  return true;
}

}  // namespace foretouch::internal
