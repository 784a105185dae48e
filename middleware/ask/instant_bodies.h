// middleware/ask/instant_bodies.h: where all bodies of a world are at the instants of a question: a
// box around each, which needs no pose at that instant, and the links' places of those that are
// asked. Kept for the next question at the same instants, while the world does not change. Metres,
// W. Not installed.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "articulated/chain_nodes.h"
#include "articulated/motion.h"
#include "middleware/ask/ask.h"
#include "middleware/ask/rough_boxes.h"
#include "middleware/depth/body_places.h"
#include "middleware/world/world_parts.h"
#include "tessellation/aabb.h"
#include "tessellation/lss_table.h"
#include "tessellation/swept_boxes.h"

namespace foretouch::internal {

/// What a body's LSS sweep from one pose to the next: floats relative to an origin near it.
struct PieceBoxes {
  std::int64_t episodeUs = 0, beginUs = 0, endUs = 0;
  bool isHeld = false;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  std::array<std::vector<float>, 3> lower, upper;  // per LSS of the kind
  Aabb box;                                        // around all of them, in W
};

/// So many pieces are kept of each body, of those that questions came near; a second at 60 Hz. With
/// more in use, their boxes are found anew. At 22 LSS a piece takes some 800 bytes.
inline constexpr std::size_t kPiecesKept = 64;

/// For one thread; keeps its memory.
class InstantBodies {
 public:
  /// Forgets what is kept of another world.
  void useWorld(const WorldParts& world);
  /// Brings all bodies to the question's instants. O(bodies); for a piece of a body's motion that
  /// is new, O(joints).
  void bring(const WorldParts& world, const WorldQuestion& question);

  [[nodiscard]] int count() const { return static_cast<int>(state_.size()); }
  /// A box around each body, [axis][body]; empty if the body is not known, or has nothing.
  [[nodiscard]] const double* lower(int axis) const { return lower_[slotOf(axis)].data(); }
  [[nodiscard]] const double* upper(int axis) const { return upper_[slotOf(axis)].data(); }
  [[nodiscard]] Aabb box(BodyId body) const;
  /// A bound on the size of their coordinates.
  [[nodiscard]] double extent() const { return extent_; }

  [[nodiscard]] PlaceKnown known(BodyId body) const { return state_[slotOf(body)].known; }
  /// The boxes of its LSS, from which its box here is made from now on; null for a body that is
  /// carried. Precondition: it is known. O(joints) for a piece of its motion that is new.
  [[nodiscard]] const PieceBoxes* pieces(BodyId body);
  /// The same for any piece of the motion of a body that is not carried. Valid until the next call.
  /// The world is in use.
  [[nodiscard]] const PieceBoxes& piecesOf(BodyId body, const BodyPiece& known);
  /// The places of its links, which are posed when they are first asked for.
  [[nodiscard]] const std::vector<LinkPlace>& places(BodyId body);
  /// Those that are not Known, by number.
  [[nodiscard]] const std::vector<BodyId>& others() const { return others_; }

 private:
  struct State {
    PlaceKnown known = PlaceKnown::NotThere;
    int piece = -1;  ///< Place in its body's pieces; below 0: not looked for.
    bool isPosed = false, isCarried = false;
  };
  struct Kept {
    RoughBoxes rough;
    std::vector<std::int64_t> begins;  // of the pieces
    std::vector<PieceBoxes> pieces;
    std::size_t oldest = 0;
    std::vector<LinkPlace> places;
  };

  [[nodiscard]] bool isBrought(const WorldParts& world, const WorldQuestion& question) const;
  void bringBody(BodyId body);
  [[nodiscard]] Aabb roughBox(BodyId body);
  void setBox(BodyId body, const Aabb& box);
  [[nodiscard]] int pieceOf(BodyId body, const BodyPiece& known);
  void fill(BodyId body, const BodyPiece& known, PieceBoxes& piece);
  [[nodiscard]] Aabb boxOfPlaces(BodyId body);

  const WorldParts* world_ = nullptr;
  std::uint64_t owner_ = 0;                   // identity of the world that things are kept of
  std::uint64_t identity_ = 0, changes_ = 0;  // of the world that was brought; 0: none
  WorldTime time_;
  std::vector<AskInstant> instants_;
  std::vector<WorldTime> times_;  // per body
  std::vector<State> state_;
  std::vector<Kept> kept_;
  std::vector<BodyId> others_;
  std::array<std::vector<double>, 3> lower_, upper_;
  double extent_ = 0.0;

  std::vector<LssTable> tables_;  // per kind
  ChainMotion motion_;
  ChainNodes nodes_;
  SweptBoxes swept_;
  PosesReach reach_;
  BodyPlaces bodyPlaces_;
};

}  // namespace foretouch::internal
