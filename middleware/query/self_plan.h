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

/// A frame in which pairs of links move only by the joints below it, and the links below it.
struct SelfFrame {
  LinkId link;  ///< kNoParent: W.
  /// Per link: its bounded LSS' place in the accelerations; -1 if the link is not below.
  std::vector<std::int32_t> placeOf;
  std::vector<LinkId> below;  ///< Links with LSS, parents before children.
};

class SelfPlan {
 public:
  SelfPlan() = default;
  /// Precondition: the rules belong to the avatar.
  SelfPlan(const Avatar& avatar, const LssTable& table, const PairRules& rules);

  [[nodiscard]] bool isAsked() const { return asked_.numPairs > 0; }
  [[nodiscard]] const AskedPairs& asked() const { return asked_; }
  [[nodiscard]] const std::vector<SelfFrame>& frames() const { return frames_; }
  /// Place in frames() of the one that bounds both links.
  [[nodiscard]] std::int32_t frameOf(LinkId a, LinkId b) const {
    return frameOf_[slotOf(a) * numLinks_ + slotOf(b)];
  }
  /// The sum of radii (m) of LSS i and j of the table, i < j.
  [[nodiscard]] double radiusOf(std::int32_t i, std::int32_t j) const;

 private:
  void askPairs(const Avatar& avatar, const PairRules& rules);
  void findFrames(const Avatar& avatar);
  void addRadii(const PairRules& rules);

  struct OwnRadius {
    std::int32_t i, j;
    double radius;
  };

  LssTable table_;
  AskedPairs asked_;
  std::size_t numLinks_ = 0;
  std::vector<std::int32_t> frameOf_;  // per pair of links
  std::vector<SelfFrame> frames_;
  std::vector<OwnRadius> radii_;  // by i, then by j; pairs that do not count with their radii
};

}  // namespace foretouch::internal
