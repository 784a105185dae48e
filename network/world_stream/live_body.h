// network/world_stream/live_body.h: one body of a live world: what its stream has said of it, in
// the order of time, and what of that the world has been told. Not installed.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "articulated/skeleton.h"
#include "network/wire/messages.h"
#include "network/wire/world_messages.h"
#include "network/world_stream/world_setup.h"

namespace foretouch::internal {

/// A pose of the very instant of a change, which is in the frame before it, is received at most so
/// long after that, or not waited for: it ends what is known of the body there.
inline constexpr std::int64_t kClosingUs = 30'000;

/// Where a body is at an instant.
struct LiveKnot {
  std::int64_t utimeUs = 0;
  /// Nothing: it is not known. For the world it is then where it was.
  std::optional<Pose> pose;
  // For a solid body.
  std::int64_t session = 0, sequence = 0, lost = 0;
  bool isGap = false;  ///< Something before it is not known.
  bool areRootsKnown = true;
  std::vector<std::uint8_t> isTracked{};  ///< One per joint; none: all are.
};

/// From an instant on, another one carries the body, or none does, or it is gone.
struct LiveChange {
  std::int64_t sinceUs = 0;
  bool isPresent = true;
  BodyNumber carrier = kNoBody;
  LinkId link = 0;
  bool movesInFrame = false;
  RigidPose pose;
  std::int64_t poseUs = 0;  ///< The pose is that of this instant; `sinceUs` may have to be later.

  [[nodiscard]] bool hasCarrier() const { return isPresent && carrier != kNoBody; }
  /// Where it is from `sinceUs` on is known then.
  [[nodiscard]] bool hasPlace() const { return !awaitsPoses() || poseUs == sinceUs; }
  /// Held fast, a body has no poses.
  [[nodiscard]] bool awaitsPoses() const {
    return isPresent && (carrier == kNoBody || movesInFrame);
  }
};

/// A time in which links are not known.
struct UnknownSpan {
  LinkId link = kEveryLink;
  UndecidedReason reason = UndecidedReason::Gap;
  std::int64_t fromUs = 0, toUs = 0;
};

/// What carries a body since when.
struct LiveCarrier {
  std::int64_t sinceUs = 0;
  BodyNumber carrier = kNoBody;
  LinkId link = 0;
};

struct LiveBody {
  BodyNumber number = 0;
  std::size_t shape = 0;
  bool isAvatar = false;  ///< Its poses are those of an avatar's stream.
  bool isSolid = false;   ///< They are targets, and the world knows what it shows.

  // What its stream has said.
  bool hasStream = false;  ///< A pose was accepted; the next four are of the last one.
  bool isOtherSpeaker = false;
  std::int64_t session = 0, sequence = 0, knownUntilUs = -1, heardUs = 0;
  std::int64_t stateSession = 0, stateSequence = -1;  ///< The last accepted body_t's.
  LiveChange state;                                   ///< The one accepted last.
  std::int64_t firstUs = -1;  ///< Since when its first state holds; before it no frame is known.
  RigidPose firstPose;        ///< Then.
  /// What was announced and is not due; states count from their instants on.
  std::deque<LiveChange> announced;
  bool isAwaited = true;      ///< As awaitsPoses(), of the last state that was due.
  std::int64_t stateUs = -1;  ///< Until when states that were due say where it is.
  /// A pose of it came in time, and yet too late: the watermark, which stood here, waits for one
  /// that does not; -1: no.
  std::int64_t backUs = -1;
  bool skips = false;  ///< Something between its last accepted pose and the next one is missing.
  std::deque<LiveKnot> knots;      ///< Not told to the world.
  std::deque<LiveChange> changes;  ///< Not told to the world, by time.
  std::vector<UnknownSpan> unknown;

  // What the world knows.
  std::optional<BodyId> slot;
  std::int64_t beginUs = 0, toldFromUs = -1, toldUntilUs = -1;  ///< First, last but one, last pose.
  Pose told;                                                    ///< The last one.
  std::vector<LiveCarrier> carriers;                            ///< By time.
  bool isHeldFast = false;
  bool isElsewhere = false;  ///< Until its next pose nothing says where it is.
  bool isSilent = false;     ///< The watermark has gone on without it.

  /// Until when it is known where it is; -1: it is not there yet.
  [[nodiscard]] std::int64_t saidUntilUs() const { return std::max(knownUntilUs, stateUs); }
  /// That what carries it, by what the world knows, does so from then on as well. Precondition: a
  /// body carries it.
  [[nodiscard]] LiveChange carriedSince(std::int64_t utimeUs) const;
  /// No change of it waits to take effect by then.
  [[nodiscard]] bool isUnchangedUntil(std::int64_t utimeUs) const {
    return changes.empty() || changes.front().sinceUs > utimeUs;
  }
  /// Whether a frame is known that such a pose is in.
  [[nodiscard]] bool hasFrameOf(std::int64_t utimeUs, const RigidPose& pose) const;
  /// Lets states take effect that are due at `nowUs`.
  void ripen(std::int64_t nowUs);
  /// Marks the links as unknown from `fromUs` to `toUs`; goes on with a span that ends there.
  void addUnknown(LinkId link, UndecidedReason reason, std::int64_t fromUs, std::int64_t toUs);
  /// Lets go of what is over.
  void forgetBefore(std::int64_t utimeUs);
  /// Whether the link (kEveryLink: any of them) is unknown at an instant in [fromUs, toUs].
  [[nodiscard]] bool isUnknown(LinkId link, std::int64_t fromUs, std::int64_t toUs) const;
};

using LiveBodies = std::map<BodyNumber, LiveBody>;

/// To the last bit.
[[nodiscard]] bool isSamePose(const RigidPose& x, const RigidPose& y);

/// Where a pose is in a stream of rigid_pose_t.
struct RigidPlace {
  std::int64_t session = 0, sequence = 0, utimeUs = 0;
};
/// Why a body does not accept a pose of this place; `restartUs`: a sender that said nothing for so
/// long may begin anew. None: `isGap` says whether poses before it were lost or another stream
/// begins.
[[nodiscard]] Reject rigidPlaceFault(const LiveBody& body, const RigidPlace& place,
                                     std::int64_t receiveUtimeUs, std::int64_t restartUs,
                                     bool& isGap);

}  // namespace foretouch::internal
