// bench/rigid_comparison.h: the answer of the usual model of motion: each link moves alone
// between its two end poses in the world, on a straight line while it turns.
#pragma once

#include <cstdint>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "articulated/result.h"
#include "middleware/query/query.h"
#include "middleware/scene/scene.h"

namespace foretouch::tools {

/// Counts of links over one step or many. Contacts of the articulated motion on which both agree
/// are neither missed, early nor late.
struct RigidCounts {
  std::int64_t contacts = 0;       ///< First contacts of the articulated motion.
  std::int64_t missed = 0;         ///< Of these, clear by the rigid model.
  std::int64_t late = 0;           ///< Reported after more than kNoticeable of further true motion.
  std::int64_t early = 0;          ///< Reported before it by as much.
  std::int64_t falseContacts = 0;  ///< The true motion is clear, the rigid model reports contact.
  std::int64_t undecided = 0;      ///< By either model: not compared.

  void add(const RigidCounts& other);
};

/// Times of contact differ if the link's touching point travels farther than this (m) along the
/// true motion between them.
inline constexpr double kNoticeable = 1e-3;

/// Answers steps of one avatar by the rigid model. One per thread.
class RigidComparison {
 public:
  /// Builds the avatar as a forest of roots, asked the same way. Errors: those of Query::build().
  static Result<RigidComparison> build(const Avatar& avatar, const Scene& scene,
                                       const QueryOptions& options);

  /// Compares `truth`, the answer to `motion`, with the rigid model's answer to the same step.
  [[nodiscard]] Result<RigidCounts> compare(const ChainMotion& motion, const StepContacts& truth,
                                            Scratch& scratch) const;

 private:
  explicit RigidComparison(Query forest) : forest_(std::move(forest)) {}
  Query forest_;
};

}  // namespace foretouch::tools
