// middleware/solid_world/world_movers.h: what moves in a world by itself, tick by tick, as bodies
// that solid avatars may meet. Not installed.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "articulated/result.h"
#include "middleware/solid_world/around_body.h"
#include "middleware/world/body_system.h"
#include "middleware/world/system_plan.h"
#include "middleware/world/world_parts.h"

namespace foretouch::internal {

/// Numbers of the kinds of one world.
class KindNumbers {
 public:
  [[nodiscard]] std::int32_t next() { return count_++; }
  /// All solid avatars of one avatar (its identity), with empty hands, are of one kind.
  [[nodiscard]] std::int32_t ofAvatar(std::uint64_t identity);
  [[nodiscard]] bool isOfAvatar(std::int32_t number) const;

 private:
  std::int32_t count_ = 0;
  std::vector<std::pair<std::uint64_t, std::int32_t>> ofAvatars_;
};

/// Keeps its memory.
class WorldMovers {
 public:
  /// Finds what the bodies do from one instant to the other. `isMover`: per body. Errors: carriers
  /// whose chains are too deep together.
  Result<Done> collect(const WorldParts& world, const std::vector<std::uint8_t>& isMover,
                       std::int64_t fromUs, std::int64_t toUs, KindNumbers& numbers);
  /// By body; those that are there at no time of the tick have no legs.
  [[nodiscard]] const std::vector<AroundBody>& bodies() const { return bodies_; }

 private:
  struct Known {
    const SystemPlan* plan;
    std::unique_ptr<AroundKind> kind;
  };
  Result<Done> collectBody(const WorldParts& world, BodyId id, std::int64_t fromUs,
                           std::int64_t toUs, KindNumbers& numbers, AroundBody& body);
  [[nodiscard]] const AroundKind& kindOf(const WorldParts& world, BodyId id, const SystemPlan& plan,
                                         KindNumbers& numbers);

  SystemPlans plans_;
  std::vector<std::int64_t> planKey_;
  PieceMotions motions_;
  SystemSpans spans_;
  SystemPoses poses_;
  std::vector<Known> kinds_;
  std::vector<AroundBody> bodies_;  // by body
};

}  // namespace foretouch::internal
