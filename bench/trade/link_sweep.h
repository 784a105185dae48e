// bench/trade/link_sweep.h: one LSS moving between two poses, for the strategies that use a
// NearestTree.
#pragma once

#include <algorithm>

#include "articulated/motion.h"
#include "bench/trade/nearest_tree.h"
#include "lss/lss.h"

namespace foretouch::tools {

class LinkSweep {
 public:
  LinkSweep(LinkId link, const Lss& lss, MotionEvaluator& evaluator, const NearestTree& tree,
            TradeWork& work)
      : link_(link),
        lss_(lss),
        evaluator_(evaluator),
        tree_(tree),
        work_(work),
        speed_(evaluator.motion().bounds(link).speedAt(std::max(lss.a.norm(), lss.b.norm()))) {}

  /// No point of the axis moves faster (m per unit of t): within h of t the separation changes by
  /// at most h times this.
  [[nodiscard]] double speed() const { return speed_; }

  /// Separation (m) of the LSS' surface and the scene at `t`, or `cap` if it is more; below zero if
  /// they overlap. Stops early, once one not above `enough` is found.
  [[nodiscard]] double separation(double t, double cap, double enough) {
    ++work_.states;
    const LinkState state = evaluator_.stateAt(link_, t);
    return tree_.distance(state.pointAt(lss_.a), state.pointAt(lss_.b), cap + lss_.radius,
                          enough + lss_.radius, work_) -
           lss_.radius;
  }

 private:
  LinkId link_;
  const Lss& lss_;
  MotionEvaluator& evaluator_;
  const NearestTree& tree_;
  TradeWork& work_;
  double speed_;
};

}  // namespace foretouch::tools
