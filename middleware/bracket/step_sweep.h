// middleware/bracket/step_sweep.h: what the links that are asked sweep in a step, what may meet
// there, and which leaves and triangles of the scene are near in which piece. Proof: bracket.md 3.
// Not installed.
#pragma once

#include <cstddef>
#include <vector>

#include "middleware/bracket/bracket_plan.h"

namespace foretouch::internal {

/// What is asked: a link of the first body and the scene, or a link of either body.
struct Asked {
  LinkId link, other = kNoParent;
  std::size_t otherBody = 0;
};

/// The sweep of one question. All references outlive it.
class StepSweep {
 protected:
  StepSweep(const BracketPlan& plan, const BracketAsk& ask, BracketMemory& memory)
      : plan_(plan), ask_(ask), memory_(memory) {}

  [[nodiscard]] ModelPieces& piecesOf(std::size_t body, int level) {
    return memory_.bodies[body].levels[slotOf(level)];
  }
  [[nodiscard]] ModelPieces& base(std::size_t body) { return piecesOf(body, memory_.base); }
  [[nodiscard]] LinkId numLinks(std::size_t body) const {
    return plan_.bodies[body].avatar.numLinks();
  }
  [[nodiscard]] const Avatar& avatarOf(std::size_t body) const { return plan_.bodies[body].avatar; }
  [[nodiscard]] const std::vector<Lss>& lssOf(std::size_t body, LinkId link) const {
    return plan_.bodies[body].avatar.lss(link);
  }
  [[nodiscard]] bool isClaimed(std::size_t body, LinkId link) const {
    return memory_.bodies[body].growths[slotOf(link)].has_value();
  }
  /// Whether the LSS are what touches the scene.
  [[nodiscard]] bool areLssSurface() const { return !plan_.bodies[0].surface; }

  template <typename Visit>
  void forEachPair(const Visit& visit) {
    for (const foretouch::LinkPair& pair : plan_.pairs) visit(Asked{pair.a, pair.b, 0});
    if (plan_.bodies.size() < 2) return;
    for (LinkId link = 0; link < numLinks(0); ++link) {
      for (LinkId other = 0; other < numLinks(1); ++other) visit(Asked{link, other, 1});
    }
  }

  /// Cuts the models, and leaves open what may touch anything.
  void begin();
  /// Finds the box of what each open link of all bodies may sweep. False: some link has none that
  /// bounds anything; by the last level nothing is claimed of it then.
  bool sweep(bool isLast);
  bool sweepLink(std::size_t body, LinkId link);
  [[nodiscard]] double marginIn(const ModelPiece& piece, std::size_t body, LinkId link) const;
  void clearTubes();
  /// Sets those in a piece of the base level.
  void setTubes(int k, LinkId link);
  void setTubes(const ModelPiece& piece, LinkId link, const std::vector<LinkState>& begin,
                const std::vector<LinkState>& end, double span, double margin);
  /// Cuts what is open as finely as it takes; `isSaid`: the whole step as one piece says something.
  void refine(bool isSaid);
  /// Leaves open what may touch anything in the step.
  void openNear();
  void openNearScene();
  /// False: there is nothing.
  bool collectNear(LinkId link);
  [[nodiscard]] bool mayMeet(const Asked& asked) const;
  /// Whether there are so many leaves that another walk is faster than a look at all of them.
  [[nodiscard]] bool isCrowded(LinkId link) const;
  void walkPieces(LinkId link);
  /// The leaves in a piece of the base level; null: there are too many for a list.
  [[nodiscard]] const NearLeaves* leavesIn(int k, LinkId link);
  /// The pairs in such a piece; null: there may be many.
  [[nodiscard]] const NearPairs* pairsIn(int k, LinkId link);

  const BracketPlan& plan_;
  const BracketAsk& ask_;
  BracketMemory& memory_;
};

}  // namespace foretouch::internal
