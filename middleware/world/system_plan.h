// middleware/world/system_plan.h: one question about the bodies of a system (body_system.h),
// checked and resolved: their chains, the LSS of those that are asked, and the query. Not
// installed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <shared_mutex>
#include <vector>

#include "articulated/relative_motion.h"
#include "articulated/result.h"
#include "middleware/pair/side_plan.h"
#include "middleware/query/query.h"
#include "middleware/world/body_system.h"
#include "middleware/world/world_parts.h"
#include "tessellation/lss_table.h"

namespace foretouch::internal {

enum class SystemQuestion : std::uint8_t {
  Boxes,  ///< Where body a is.
  Still,  ///< What a meets of the static scene, and of its own links if it asks for these.
  Self,   ///< What a's own links meet.
  Pair,   ///< What the links of a meet of those of b: LSS, or triangles that move on both sides.
  Mesh,   ///< What the links of a meet of b, a mesh.
};

/// The shares of the world's tolerance for questions and for parts of motions (world.md 2).
inline constexpr double kAskedShare = 0.9375, kPartShare = 0.0625;

struct SystemPlan {
  std::vector<std::int64_t> key;  // what it was made of
  std::vector<Skeleton> chains;   // one of all members, or two where nothing joins those of a Pair
  std::vector<JointId> first;     // the first of each member's joints, on its chain
  LssTable table;                 // a's, but for Pair and Mesh
  bool isEmpty = false;           // nothing can touch
  // For Self, a alone; for Pair, both: the one that is first among the members comes first.
  std::optional<SidePlan> one, other;
  PairsAsked asked;
  std::optional<Query> query;         // for Still and Mesh
  std::optional<RelativeChain> seen;  // for Mesh: from b

  /// Precondition: the question is Self or Pair.
  [[nodiscard]] PairPlan pair() const { return {*one, other ? *other : *one, asked}; }
  [[nodiscard]] bool isMerged() const { return chains.size() == 1; }
};

/// Plans that one thread has asked for lately: found without asking what all threads share.
class LatePlans {
 private:
  friend class SystemPlans;
  static constexpr std::size_t kKept = 32;
  std::uint64_t generation_ = 0;  // of the SystemPlans that it has them from
  std::array<const SystemPlan*, kKept> plans_{};
};

/// Plans of one world, by what they are made of: kinds of bodies, what hangs on what, and what is
/// asked. Two avatars of the same two kinds share one. Any number of threads may ask for plans at
/// once.
class SystemPlans {
 public:
  /// Precondition: the spans are at a span; `a` and, for Pair and Mesh, `b` are among the members.
  /// `key`, `late`: the thread's own memory; `late` may be null. Errors: a chain that is too deep,
  /// or of too many joints. Allocates only what it has not.
  Result<const SystemPlan*> planOf(const WorldParts& world, const SystemSpans& spans,
                                   SystemQuestion question, BodyId a, BodyId b,
                                   std::vector<std::int64_t>& key, LatePlans* late = nullptr);
  void clear();

 private:
  [[nodiscard]] static std::uint64_t newGeneration();
  [[nodiscard]] const SystemPlan* find(const std::vector<std::int64_t>& key) const;
  Result<const SystemPlan*> ofAll(const WorldParts& world, const SystemSpans& spans,
                                  SystemQuestion question, const std::vector<std::int64_t>& key);

  std::shared_mutex mutex_;
  std::uint64_t generation_ = newGeneration();      // of these plans, among all of the process
  std::vector<std::unique_ptr<SystemPlan>> plans_;  // by key
};

}  // namespace foretouch::internal
