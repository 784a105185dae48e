// middleware/bracket/leaf_search.h: the first touch of a link among many leaves of the scene's
// tree: the piece is halved until few leaves are near in a part of it, and their triangles alone
// are looked at. Proof: bracket.md 3. Not installed.
#pragma once

#include <optional>
#include <vector>

#include "articulated/motion.h"
#include "lss/lss.h"
#include "middleware/bracket/link_leaves.h"
#include "middleware/bracket/side_bracket.h"
#include "middleware/events/moving_sides.h"
#include "middleware/pair/growth.h"
#include "middleware/scene/scene.h"

namespace foretouch::internal {

/// A link in a piece: the sides are set.
struct LinkInPiece {
  const Scene& scene;
  const std::vector<Lss>& lss;
  LinkId link;
  MotionEvaluator& evaluator;
  Growth growth;
  double resolution;  ///< Metres.
  MovingSides& sides;
};

/// For one thread; keeps its memory.
class LeafSearch {
 public:
  /// More are halved.
  static constexpr std::size_t kFewLeaves = 12;

  /// As SideBracketer::find(), to the piece's end. `leaves`: all that may be near in the piece.
  [[nodiscard]] std::optional<double> find(const LinkInPiece& piece, const BracketSearch& search,
                                           double from, const NearLeaves& leaves,
                                           SidesPair& witness);

 private:
  /// Of the piece, down to the part at hand; the last of them that left about as many leaves.
  struct Halvings {
    std::size_t all = 0, idle = 0;
  };
  [[nodiscard]] std::optional<double> findIn(double from, double to, const NearLeaves& leaves,
                                             Halvings done);
  void setTubes(double from, double to);

  const LinkInPiece* piece_ = nullptr;
  BracketSearch search_;
  SidesPair* witness_ = nullptr;
  MotionBounds bounds_;
  SideBracketer bracketer_;
  std::vector<NearLeaves> fewer_;  // per halving
  NearPairs pairs_;
  LinkTubes tubes_;
};

}  // namespace foretouch::internal
