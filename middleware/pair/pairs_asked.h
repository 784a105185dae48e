// middleware/pair/pairs_asked.h: which pairs of LSS a question about two sides is about, by what
// radii, and which frames their motion is bounded in. The two sides are an avatar's own links, two
// bodies on one chain, or two that nothing joins. Not installed.
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

/// Per link, on how many of its children something of the avatar hangs.
[[nodiscard]] std::vector<int> childrenThatCount(const Avatar& avatar);

/// The pairs of an avatar's own links that the rules ask about: both have LSS. a < b, in order.
/// O(links^2).
[[nodiscard]] std::vector<foretouch::LinkPair> askedLinks(const Avatar& avatar,
                                                          const PairRules& rules);

/// Two links, of the one side and of the other.
struct LinksOfSides {
  LinkId one, other;
};

/// The asked pairs of the LSS of two tables; of own links, twice the same.
class PairsAsked {
 public:
  PairsAsked() = default;
  /// An avatar's own links. Precondition: the rules belong to the avatar.
  PairsAsked(const Avatar& avatar, const LssTable& table, const PairRules& rules);
  /// Two bodies that nothing joins: all pairs of one's LSS and the other's.
  PairsAsked(const LssTable& one, const LssTable& other);
  /// Two bodies on one chain, and which of their links are not asked. O(links^2).
  PairsAsked(const Avatar& one, const LssTable& tableOfOne, const Avatar& other,
             const LssTable& tableOfOther, const std::vector<LinksOfSides>& leftOut);

  [[nodiscard]] bool isAsked() const { return asked_.numPairs > 0; }
  [[nodiscard]] const AskedPairs& asked() const { return asked_; }
  /// Links in whose frames asked pairs move only by the joints below; kNoParent: W.
  [[nodiscard]] const std::vector<LinkId>& frames() const { return frames_; }
  /// Place in frames() of the one that bounds an asked pair of links; a < b, if they are own ones.
  [[nodiscard]] std::int32_t frameOf(LinkId a, LinkId b) const {
    return frameOf_.empty() ? 0 : frameOf_[slotOf(a) * numLinks_ + slotOf(b)];
  }
  /// What counts of the sum of radii of LSS i and j; i < j, if they are of own links.
  [[nodiscard]] double radiusShare(std::int32_t i, std::int32_t j) const;

 private:
  void makeRoom(const LssTable& one, const LssTable& other);
  void ask(const LssTable& one, const LssTable& other, LinkId a, LinkId b);
  void placeInFrame(LinkId frame, LinkId a, LinkId b);
  void addRadii(const LssTable& table, const PairRules& rules);

  struct OwnShare {
    std::int32_t i, j;
    double share;
  };

  AskedPairs asked_;
  std::size_t numLinks_ = 0;           // of the other side
  std::vector<std::int32_t> frameOf_;  // per pair of links; empty: all are seen from the first
  std::vector<LinkId> frames_;
  std::vector<OwnShare> shares_;  // by i, then by j; of pairs that do not count with their radii
};

}  // namespace foretouch::internal
