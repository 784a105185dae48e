// middleware/bracket/bracket_plan.h: a question about brackets, checked and resolved, and what it
// keeps. Not installed.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "lss/index.h"
#include "middleware/bracket/bracket.h"
#include "middleware/bracket/known_places.h"
#include "middleware/bracket/leaf_search.h"
#include "middleware/bracket/link_leaves.h"
#include "middleware/bracket/model_pieces.h"
#include "middleware/bracket/person_growth.h"
#include "middleware/bracket/side_bracket.h"
#include "middleware/bracket/surface_passage.h"
#include "middleware/pair/ignored_objects.h"
#include "middleware/pair/pairs_asked.h"
#include "middleware/scratch.h"
#include "middleware/surface/link_surface.h"
#include "tessellation/aabb.h"
#include "tessellation/lss_table.h"

namespace foretouch::internal {

/// A level in the step at hand: not cut; nothing is said of some link; something of all.
enum class LevelCut : std::uint8_t { None, Unknown, Known };

/// What questions about brackets keep of one body.
struct BodyBrackets {
  static constexpr int kLevels = 6;  ///< 1, 2, 4 ... ModelPieces::kMost pieces.

  AskedPart part;
  ModelMotion model;
  std::array<ModelPieces, kLevels> levels;
  std::array<LevelCut, kLevels> cuts{};
  KnownPlaces places;
  std::vector<std::optional<StepGrowth>> growths;  ///< Per link, of the step.
  std::vector<double> most;                        ///< Per link: the largest, as reported.
  std::vector<Aabb> boxes;                         ///< Per link: what it may sweep in the step.
  std::vector<std::uint8_t> isOpen;                ///< Per link: it may touch what is asked.
  std::vector<std::uint8_t> isMoved;               ///< Per joint: an open link hangs on it.

  void begin(std::size_t numLinks);
  /// Fills `isMoved` from `isOpen`: finer levels move only these joints.
  void moveOpen(const Skeleton& skeleton);
};

/// The same, for one body or two.
struct BracketMemory : ScratchPart {
  static constexpr ScratchKind kKind = ScratchKind::Bracket;

  std::array<BodyBrackets, 2> bodies;
  int base = 0;                    ///< The coarsest level that says something of every open link.
  LinkLeaves triangles, ofPieces;  ///< For all links in the step; for one in its pieces.
  std::vector<Aabb> pieceBoxes;
  std::vector<std::uint8_t> isNear;  ///< Per link that is asked: something of the scene is near.
  std::vector<NearLeaves> ofStep;    ///< Per link that is asked: what may be near in the step.
  /// For the link at hand, in each piece of the base level: the leaves and pairs that may be near.
  /// Nothing else can touch the person, whatever finer pieces do (bracket.md 3).
  std::vector<NearLeaves> leaves;
  std::vector<NearPairs> near;
  NearPairs ofWhole;             ///< For a link in the whole step, or at an instant.
  bool arePiecesWalked = false;  ///< `ofPieces` is of the link at hand.
  std::vector<std::uint8_t> areLeavesKnown, arePairsKnown;  ///< Per piece.
  LeafSearch search;
  LinkTubes tubes;
  std::pair<LinkId, int> tubesOf{kNoParent, -1};  ///< The link, and the piece of the base level.
  bool isLimited = false;
  MovingSides sides;
  SideBracketer bracketer;
  SurfacePassage passage;
  std::vector<PassagePart> way;
  IgnoredObjects ignored;
};

/// A body that is asked.
struct BodyPlan {
  Avatar avatar;
  std::optional<AvatarSurface> surface;  ///< At exact fidelity.
  LssTable table;
  std::vector<double> rho;  ///< Per link: no point of it is farther from its origin (m).

  [[nodiscard]] static BodyPlan of(const Avatar& avatar,
                                   const std::optional<AvatarSurface>& surface);
  [[nodiscard]] LinkShape shapeOf(LinkId link) const {
    return {avatar.lss(link), surface ? surface->parts().links[slotOf(link)].get() : nullptr};
  }
};

/// A question, checked and resolved: about one body, the scene and itself; or about two.
struct BracketPlan {
  std::vector<BodyPlan> bodies;
  std::optional<Scene> scene;  // for one body
  double resolution = 0.0;
  std::vector<IgnoredPair> ignored;
  PairsAsked asked;
  std::vector<foretouch::LinkPair> pairs;  // own links that are asked
  std::uint64_t workBudget = std::numeric_limits<std::uint64_t>::max();
};

/// How the growths of pieces follow from what is known of a link.
class PieceGrowths {
 public:
  [[nodiscard]] virtual Growth of(const ModelPiece& piece, std::size_t body, LinkId link) const = 0;

 protected:
  ~PieceGrowths() = default;
};

/// What a run is to find.
struct BracketAsk {
  const PieceGrowths& growths;
  bool isCut = false;        ///< The pieces are there, and are all there is.
  bool isRefined = false;    ///< There are finer levels of the models.
  bool isContinuous = true;  ///< Each piece begins where the one before it ends.
  bool isAhead = false;      ///< Only from when a touch is possible.
};

}  // namespace foretouch::internal
