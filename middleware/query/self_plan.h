// middleware/query/self_plan.h: the question whether an avatar's own links touch each other,
// resolved: which pairs of LSS, by what radii, and which frames their motion is bounded in. Not
// installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/pair_rules.h"
#include "lss/index.h"
#include "middleware/lanes/pair_boxes.h"
#include "tessellation/lss_table.h"

namespace foretouch::internal {

/// Per link: how many of its children have LSS or a link below that has. Two or more make a
/// branching.
[[nodiscard]] std::vector<int> childrenThatCount(const Avatar& avatar);

/// Of the LSS in an avatar's table.
class SelfPlan {
 public:
  SelfPlan() = default;
  /// Precondition: the rules belong to the avatar.
  SelfPlan(const Avatar& avatar, const LssTable& table, const PairRules& rules);

  [[nodiscard]] bool isAsked() const { return asked_.numPairs > 0; }
  [[nodiscard]] const AskedPairs& asked() const { return asked_; }
  /// Links in whose frames asked pairs move only by the joints below; kNoParent: W.
  [[nodiscard]] const std::vector<LinkId>& frames() const { return frames_; }
  /// Place in frames() of the one that bounds an asked pair of links, a < b.
  [[nodiscard]] std::int32_t frameOf(LinkId a, LinkId b) const {
    return frameOf_[slotOf(a) * numLinks_ + slotOf(b)];
  }
  /// What counts of the sum of radii of LSS i and j, i < j.
  [[nodiscard]] double radiusShare(std::int32_t i, std::int32_t j) const;

 private:
  void ask(const LssTable& table, LinkId a, LinkId b);
  [[nodiscard]] std::int32_t placeOfFrame(LinkId frame);
  void addRadii(const LssTable& table, const PairRules& rules);

  struct OwnShare {
    std::int32_t i, j;
    double share;
  };

  AskedPairs asked_;
  std::size_t numLinks_ = 0;
  std::vector<std::int32_t> frameOf_;  // per pair of links
  std::vector<LinkId> frames_;
  std::vector<OwnShare> shares_;  // by i, then by j; of pairs that do not count with their radii
};

}  // namespace foretouch::internal
