// middleware/world/work_shares.h: how a budget of work is shared by pairs of bodies: by bodies, so
// that a heap of them has no more than those beside it. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "middleware/world/world_contacts.h"

namespace foretouch::internal {

/// Readying a question about a span costs so much, in the units of QueryOptions::workBudget,
/// whatever is found.
inline constexpr std::uint64_t kSpanWork = 500;
/// With less than this, two are not looked at.
inline constexpr std::uint64_t kLeastShare = 64;

/// For one thread; keeps its memory. Pairs are known by numbers from 0.
class WorkShares {
 public:
  static constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();

  void begin(std::size_t numBodies);
  /// Adds the next pair: two bodies, or one and what it meets by itself (`b` below 0, or `a`).
  void add(BodyId a, BodyId b);
  /// Adds the next pair, which has nothing to do.
  void addNobody() { pairs_.push_back({-1, -1}); }
  /// Each pair's weight is one over the number of pairs of that one of its two bodies that has
  /// more; its share is that part of `total`, and not above `most`.
  void share(std::uint64_t total, std::uint64_t most);
  [[nodiscard]] std::uint64_t of(std::size_t pair) const { return shares_[pair]; }

  /// Gives what the `pairs`, which are not done, may spend instead, if that is at least twice as
  /// much as they had: `total` is what all the others have left. They are in order; any that get no
  /// more are taken out.
  void shareAgain(std::uint64_t total, std::uint64_t most, std::vector<std::size_t>& pairs);

 private:
  struct Bodies {
    BodyId a, b;
  };
  [[nodiscard]] double weightOf(std::size_t pair) const;
  [[nodiscard]] std::uint64_t partOf(std::uint64_t total, std::uint64_t most, double part) const;

  std::vector<Bodies> pairs_;
  std::vector<std::uint32_t> countOf_;  // per body, how many pairs it has
  std::vector<std::uint64_t> shares_;
};

}  // namespace foretouch::internal
