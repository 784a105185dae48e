// articulated/track.h: where an articulated body is on world time: poses with the instants at which
// they were captured, and the in-between motion (articulated/motion.h) from each to the next. Every
// body has instants of its own. World time is in whole microseconds since any epoch; metres.
// Rounding of parts of a motion: articulated/track.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "articulated/motion.h"
#include "articulated/result.h"
#include "articulated/skeleton.h"

namespace foretouch {

/// What a body is taken to do after its last known pose. The user chooses, and answers say where
/// they rest on it.
enum class WhenSilent : std::uint8_t {
  Wait,       ///< Nothing: questions beyond it are refused until the next pose is there.
  HoldStill,  ///< It stays in that pose. A guess, not a proof.
  Undecided,  ///< Unknown: whatever is asked of it from then on is undecided.
};
/// "wait", "hold-still", "undecided".
[[nodiscard]] const char* toString(WhenSilent whenSilent);

/// Instants are within this of zero (us), 285 years: doubles hold them and their differences.
inline constexpr std::int64_t kMostUtimeUs = std::int64_t{1} << 53;
/// Two poses are at most this far apart (us), 11 days: a part of a motion then turns by so much
/// less than the whole that the shorter arc stays the shorter one (articulated/track.md 1).
inline constexpr std::int64_t kLongestPieceUs = 1'000'000'000'000;
/// A track keeps at most so many poses.
inline constexpr std::size_t kMaxKnots = std::size_t{1} << 20;

/// One in-between motion of a track: from a knot to the next, or the rest after the last one.
struct TrackPiece {
  std::int64_t beginUs = 0, endUs = 0;  ///< endUs > beginUs.
  const Pose* from = nullptr;           ///< Valid until the track changes.
  const Pose* to = nullptr;             ///< The same as `from` if the body holds still.
  bool isHeld = false;                  ///< After the last knot: nothing is known.

  /// The instant as the motion's t, in [0,1]. Precondition: within the piece (asserted).
  [[nodiscard]] double at(std::int64_t utimeUs) const;
};

/// The poses of one skeleton by their instants, as a ring: allocates nothing once it has grown to
/// as many as it holds at a time. One thread changes it; any number may read in between.
class Track {
 public:
  explicit Track(Skeleton skeleton) : skeleton_(std::move(skeleton)) {}

  [[nodiscard]] const Skeleton& skeleton() const { return skeleton_; }
  [[nodiscard]] std::size_t numKnots() const { return count_; }
  [[nodiscard]] bool isEmpty() const { return count_ == 0; }

  /// The body's next pose, with the instant of its capture. Errors, which leave the track as it is:
  /// not after the last knot (repeated, out of order, in the past: Error::index is the last knot's
  /// place), not after what was forgotten, an instant out of range, more than kLongestPieceUs after
  /// the last knot, more than kMaxKnots, and those of validatedPose().
  Result<Done> push(std::int64_t utimeUs, const Pose& pose);

  /// The body is known from here to there. Preconditions: not empty (asserted).
  [[nodiscard]] std::int64_t knownFromUs() const { return knot(0).utimeUs; }
  [[nodiscard]] std::int64_t knownUntilUs() const { return knot(count_ - 1).utimeUs; }

  /// Lets go of knots that no motion at or after `utimeUs` needs. Knots at or before it are refused
  /// from now on. Keeps the last knot. O(knots let go).
  void forgetBefore(std::int64_t utimeUs);
  /// Lets go of knots between others that say nearly the same: no point of any link that is at most
  /// reach[link] (m) from the link's origin is ever farther than `metres` from where it was with
  /// all knots that were pushed, however often this is called (articulated/track.md 3). Keeps the
  /// first knot, and the motion from the last knot at or before `utimeUs` on. O(joints) per knot
  /// that is looked at; those that the last call has looked at, to as many metres, are not again.
  void thinBefore(std::int64_t utimeUs, const std::vector<double>& reach, double metres);

  /// The piece that holds [utimeUs, utimeUs + 1); after the last knot the rest, which is held.
  /// Precondition: not empty, at or after knownFromUs() (asserted). O(log knots).
  [[nodiscard]] TrackPiece pieceAt(std::int64_t utimeUs) const;
  /// The first knot after `utimeUs`; INT64_MAX if there is none. O(log knots).
  [[nodiscard]] std::int64_t nextKnotUs(std::int64_t utimeUs) const;
  /// How many knots are at or before the instant. O(log knots).
  [[nodiscard]] std::size_t countUntil(std::int64_t utimeUs) const;

 private:
  struct Knot {
    std::int64_t utimeUs = 0;
    Pose pose;
    double movedBy = 0.0;  ///< How far thinning moved the motion up to the next knot (m).
  };
  [[nodiscard]] const Knot& knot(std::size_t i) const {
    FORETOUCH_ASSERT(i < count_);
    return ring_[(first_ + i) % ring_.size()];
  }
  [[nodiscard]] Result<Done> checkedInstant(std::int64_t utimeUs) const;
  [[nodiscard]] double movedWithout(std::size_t from, std::size_t to,
                                    const std::vector<double>& reach, double most) const;
  [[nodiscard]] std::size_t farthestFrom(std::size_t from, std::size_t last,
                                         const std::vector<double>& reach, double metres,
                                         double& movedBy) const;
  void grow();

  Skeleton skeleton_;
  std::vector<Knot> ring_;
  std::size_t first_ = 0, count_ = 0;
  std::int64_t forgottenUs_ = -kMostUtimeUs - 1;
  std::int64_t thinnedUs_ = -kMostUtimeUs - 1;  // to `thinnedBy_`: from here on there may be more
  double thinnedBy_ = 0.0;
};

/// Part of a piece's motion as a motion of its own: both its poses. `motion` is that of the piece.
/// At the piece's own ends the poses are those given, without rounding; elsewhere the part is off
/// by partRounding() at most. Precondition: piece.beginUs <= beginUs < endUs <= piece.endUs
/// (asserted). Allocates nothing once the poses have grown. O(joints).
void partOf(const TrackPiece& piece, const ChainMotion& motion, std::int64_t beginUs,
            std::int64_t endUs, Pose& from, Pose& to);

/// How far (m) any point at most `rho` from its link's origin, of any link, is from its true place
/// while it moves as partOf() says. 0 if the part is the whole piece. O(links).
[[nodiscard]] double partRounding(const TrackPiece& piece, const ChainMotion& motion,
                                  std::int64_t beginUs, std::int64_t endUs, double rho);

}  // namespace foretouch
