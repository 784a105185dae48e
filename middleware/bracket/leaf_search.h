// middleware/bracket/leaf_search.h: the first touch of a link among many triangles: the piece is
// searched window by window, of which each has few of them near. Proof: bracket.md 3. Not
// installed.
#pragma once

#include <optional>
#include <vector>

#include "articulated/motion.h"
#include "lss/lss.h"
#include "middleware/bracket/link_leaves.h"
#include "middleware/bracket/side_bracket.h"
#include "middleware/events/moving_sides.h"
#include "middleware/pair/growth.h"
#include "middleware/pair/ignored_objects.h"
#include "middleware/scene/scene.h"

namespace foretouch::internal {

/// A link in a piece: the sides are set.
struct LinkInPiece {
  const Scene& scene;
  const IgnoredObjects& ignored;
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
  /// More are looked for in windows.
  static constexpr std::size_t kFewPairs = 48;

  /// `at` is such an instant, by what is nearest then, which `witness` becomes.
  [[nodiscard]] bool isFound(const LinkInPiece& piece, const BracketSearch& search, double at,
                             const NearLeaves* leaves, SidesPair& witness);
  /// As SideBracketer::find(), to the piece's end. `leaves`: all that may be near in the piece;
  /// null: there is no list of them.
  [[nodiscard]] std::optional<double> find(const LinkInPiece& piece, const BracketSearch& search,
                                           double from, const NearLeaves* leaves,
                                           SidesPair& witness);

 private:
  void begin(const LinkInPiece& piece, const BracketSearch& search);
  void setTubes(double from, double to);
  void collectPairs(double from, double to, const NearLeaves* leaves);
  [[nodiscard]] std::optional<double> findAmongPairs(double from, double to, SidesPair& witness);

  const LinkInPiece* piece_ = nullptr;
  BracketSearch search_;
  MotionBounds bounds_;
  SideBracketer bracketer_;
  LinkLeaves near_;
  std::vector<Aabb> box_;  // one
  NearLeaves ofWindow_;
  NearPairs pairs_;
  LinkTubes tubes_;
};

}  // namespace foretouch::internal
