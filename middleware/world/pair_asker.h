// middleware/world/pair_asker.h: a window's question about two bodies whose boxes meet, span by
// span. Not installed.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "articulated/result.h"
#include "middleware/pair/link_query.h"
#include "middleware/pair/work_meter.h"
#include "middleware/world/body_sweeper.h"
#include "middleware/world/system_query.h"
#include "middleware/world/window_scratch.h"
#include "middleware/world/work_shares.h"
#include "middleware/world/world_parts.h"

namespace foretouch::internal {

/// For one thread.
class PairAsker {
 public:
  PairAsker(const WorldParts& world, const Window& window, const FollowedLinks* followed,
            WorldMemory& scratch, WindowWorker& worker)
      : world_(world),
        window_(window),
        followed_(followed),
        scratch_(scratch),
        worker_(worker),
        query_(world, scratch.plans, worker.system) {}

  /// `work`: what it may cost. What remains undone is left apart with the pair's number.
  Result<Done> ask(std::size_t pair, std::uint64_t work);

 private:
  [[nodiscard]] bool isMesh(BodyId id) const { return !world_.kindOf(id).avatar; }

  [[nodiscard]] SystemQuestion questionOf(BodyId a, BodyId b, std::int64_t utimeUs) const;

  [[nodiscard]] std::uint64_t workSoFar() const {
    return WorkMeter::workOf(worker_.counters.queries) + kSpanWork * worker_.counters.spans;
  }
  [[nodiscard]] std::uint64_t left() const {
    return limit_ - std::min(limit_, workSoFar() - startsAt_);
  }

  Result<bool> askSpans(BodyId a, BodyId b);

  [[nodiscard]] bool askSpan(const SystemPlan& plan, SystemQuestion question, BodyId a, BodyId b,
                             std::size_t first);

  bool leaveOpen(BodyId a, BodyId b, std::size_t first, const SpanSweep& sweep);

  [[nodiscard]] std::optional<std::int64_t> freeSinceUs(BodyId id) const;

  void leaveFollowed(BodyId a, BodyId b, std::vector<PlanePair>& open) const;

  /// What is free stays so far apart (m), as it does in the queries.
  [[nodiscard]] double floor() const {
    return kFloorShare * kAskedShare * world_.options.tolerance;
  }

  const WorldParts& world_;
  const Window& window_;
  const FollowedLinks* followed_;
  WorldMemory& scratch_;
  WindowWorker& worker_;
  SystemQuery query_;
  std::uint64_t limit_ = 0, startsAt_ = 0;
};

}  // namespace foretouch::internal
