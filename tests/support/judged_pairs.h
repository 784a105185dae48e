// tests/support/judged_pairs.h: what a query says of an avatar's own links, pair by pair, before
// the judge.
#pragma once

#include <string>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/pair_rules.h"
#include "judge/judge.h"
#include "middleware/contact.h"
#include "middleware/surface/avatar_surface.h"

namespace foretouch::test {

/// One asked pair of links in one step.
struct JudgedPair {
  PairContact contact;  ///< As answered; Clear if the answer does not list the pair.
  oracle::Verdict verdict = oracle::Verdict::Clear;
  oracle::Judgement judgement;

  [[nodiscard]] bool isOk() const { return judgement.finding == oracle::Finding::Ok; }
  /// The answer and the finding, with every digit.
  [[nodiscard]] std::string text(const Skeleton& skeleton) const;
};

/// Knows which pairs are asked, and the links' surfaces: their LSS, or at exact fidelity their
/// triangles and the LSS that contain none.
class PairsJudge {
 public:
  /// `surface` is null at link fidelity.
  PairsJudge(const Avatar& avatar, const PairRules& rules, const AvatarSurface* surface = nullptr);

  [[nodiscard]] std::size_t numAsked() const { return asked_.size(); }
  /// Every asked pair, by a, then by b; after them, as inconsistent, what is listed though nobody
  /// asked, or twice, or as clear.
  [[nodiscard]] std::vector<JudgedPair> judge(const oracle::Motion& truth, const StepContacts& step,
                                              double tolerance) const;

 private:
  struct Asked {
    LinkId a = 0, b = 0;
    std::vector<oracle::RadiusSum> sums;
  };
  struct Surface {
    std::vector<oracle::Hull> hulls;
    std::vector<int> hullOfLss;  // -1 where triangles are below
  };

  void addSurface(const Avatar& avatar, LinkId link, const AvatarSurface* surface);
  void ask(LinkId a, LinkId b, const PairRules& rules);
  [[nodiscard]] oracle::Answer plainAnswer(const PairContact& contact) const;
  [[nodiscard]] int pieceOf(LinkId link, std::int32_t triangle, std::int32_t lss) const;

  std::vector<Surface> surfaces_;  // per link
  std::vector<Asked> asked_;
};

}  // namespace foretouch::test
