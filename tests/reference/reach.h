// tests/reference/reach.h: is any triangle of the scene where the avatar could be at all?
// Sweeps a ball as wide as the body is long along each root's straight path; needs no frames. An
// experiment (docs/trade.md): it pays if nothing is near, and costs otherwise.
#pragma once

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "middleware/pair/provers.h"
#include "middleware/scene/scene.h"
#include "tessellation/lss_table.h"

namespace foretouch::internal {

/// Of queries at link or exact fidelity.
class ReachProver final : public StepAnswerer {
 public:
  /// `tolerance`: the links' largest.
  ReachProver(const Avatar& avatar, const Scene& scene, double tolerance)
      : table_(avatar), scene_(scene), tolerance_(tolerance) {}

  /// True: every LSS stays farther than the tolerance from every triangle at every t, however the
  /// joints turn; so every link is clear. O(roots), and one walk of the tree that ends at the first
  /// leaf.
  [[nodiscard]] bool isClear(const ChainMotion& motion, QueryCounters& counters) const;
  /// Whether that is so; then every link is answered.
  [[nodiscard]] bool answers(const QueryPlan& plan, const ChainMotion& motion,
                             const WorkMeter& meter, QueryMemory& scratch,
                             StepContacts& step) const override;

 private:
  LssTable table_;
  Scene scene_;
  double tolerance_;
};

}  // namespace foretouch::internal
