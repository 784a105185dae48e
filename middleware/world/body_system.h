// middleware/world/body_system.h: the bodies that a question depends on (one or two that are asked,
// and all that carry them) as one chain, or as two that nothing joins, span by span: inside a span
// no body has a knot, and none changes its carrier. Proof of what a span's motion is:
// middleware/world/world.md 1. Not installed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "articulated/motion.h"
#include "articulated/track.h"
#include "middleware/world/world_parts.h"

namespace foretouch::internal {

struct SystemMember {
  BodyId body = 0;
  std::int32_t kind = 0;
  std::int32_t carrier = -1;  ///< Place among the members, before this one; -1: W.
  LinkId link = kNoParent;    ///< The carrier's link that this one hangs on.
  std::int32_t chain = 0;     ///< The first chain of the system, or the second.
  const Episode* episode = nullptr;
  TrackPiece piece;  ///< The piece of the episode's track that holds the span.
};

/// The motions of the pieces that were cut last: several questions cut the same.
class PieceMotions {
 public:
  /// O(1) if it is among the last few, else O(joints). Valid until the next call.
  [[nodiscard]] const ChainMotion& of(const SystemMember& member);
  /// Another world is asked from now on.
  void clear();

 private:
  /// Two bodies and their carriers, and a few that meet one of them.
  static constexpr std::size_t kKept = 8;
  struct Known {
    BodyId body = -1;
    // Pieces of two episodes may have the same ends.
    std::int64_t episodeUs = 0, beginUs = 0, endUs = 0;
    std::uint64_t lastUse = 0;
    ChainMotion motion;
  };
  std::array<Known, kKept> known_;
  std::uint64_t uses_ = 0;
};

/// Both poses of a chain in a span, its members one after the other.
struct ChainPoses {
  Pose from, to;
};

/// The poses of one chain that has all members, or of two.
struct SystemPoses {
  std::array<ChainPoses, 2> chains;
  double rounding = 0.0;  ///< No point of what touches is farther from its true place (m).
  Pose partFrom, partTo;  // of one member
};

/// How much of a piece of a body's track serves several windows.
struct PieceShare {
  std::int64_t wholeUs = 0;  ///< A piece that is not longer is looked at as a whole.
  std::int64_t partUs = 0;   ///< A longer one in parts of this length. 0: not at all.
};

/// Goes from span to span of a window. Keeps its memory; for one thread.
class SystemSpans {
 public:
  /// About body `a` and, unless it is kStillScene, body `b`. The world outlives the last next().
  void begin(const WorldParts& world, BodyId a, BodyId b, std::int64_t fromUs, std::int64_t toUs);
  /// Goes to the next span in which all are there; false if there is none.
  [[nodiscard]] bool next();
  /// Goes from the span to the whole piece of a's motion that it is part of, or to the part of that
  /// piece that holds it, if a is asked alone, is not carried and goes on moving: what is found of
  /// it serves other windows too. False: stays. next() goes on behind the span.
  bool widen(const PieceShare& share);
  /// Goes from the span to the whole motion that it is part of: as long as all members are in the
  /// pieces of their tracks that they are in; of one that is longer than `mostUs`, to the part of
  /// that length that holds the span. False: stays, as no part does, or as the motion of a member
  /// is assumed.
  bool widenToPieces(std::int64_t mostUs);
  /// Back to the span that next() went to.
  void narrow();

  [[nodiscard]] std::int64_t beginUs() const { return beginUs_; }
  [[nodiscard]] std::int64_t endUs() const { return endUs_; }
  /// Carriers come before those they carry.
  [[nodiscard]] const std::vector<SystemMember>& members() const { return members_; }
  [[nodiscard]] std::int32_t placeOf(BodyId body) const;
  /// A member is silent and taken to hold still.
  [[nodiscard]] bool isAssumed() const { return isAssumed_; }

  /// The roots in W are relative to `origin`. `isMerged`: all are on one chain. O(joints).
  void poses(const Eigen::Vector3d& origin, bool isMerged, PieceMotions& motions,
             SystemPoses& poses) const;

 private:
  [[nodiscard]] bool addMember(BodyId body);
  [[nodiscard]] bool findEnd();
  bool widenTo(std::int64_t begin, std::int64_t end, std::int64_t partUs);
  [[nodiscard]] double reachOfCarried() const;
  void appendPart(const SystemMember& member, PieceMotions& motions, ChainPoses& chain,
                  SystemPoses& poses) const;

  const WorldParts* world_ = nullptr;
  BodyId a_ = 0, b_ = kStillScene;
  std::int64_t beginUs_ = 0, endUs_ = 0, toUs_ = 0;
  std::int64_t spanUs_ = 0, nextUs_ = 0;  // the span that next() went to, and where it goes on
  bool isAssumed_ = false;
  std::vector<SystemMember> members_;
  std::vector<BodyId> chain_;  // memory of addMember()
};

}  // namespace foretouch::internal
