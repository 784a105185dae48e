// middleware/triggers/triggers.h: volumes that report what is in them. A trigger is a body of a
// world: it may stand, move, and be carried. What a WorldFollower reports of contacts becomes what
// enters, leaves and is inside: also of bodies that pass between two poses, and of those that are
// inside altogether, and touch nothing. World time in microseconds. The promise: docs/guarantees.md
// 19; how it is kept: triggers.md.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "articulated/track.h"
#include "lss/lss.h"
#include "middleware/events/world_event.h"
#include "middleware/scene/scene.h"
#include "middleware/triggers/trigger_event.h"
#include "middleware/world/world.h"

namespace foretouch {

namespace internal {
struct VolumeParts;
}

/// Immutable; cheap to copy (shared).
class TriggerVolume {
 public:
  /// A box around the origin of its frame, along its axes. Errors: an extent that is not above 0
  /// and at most kMaxCoordinate.
  static Result<TriggerVolume> box(const Eigen::Vector3d& halfExtents);
  /// A sphere around the origin. Errors: as above.
  static Result<TriggerVolume> sphere(double radius);
  /// Solid LSS, all of which are one volume. Errors: no LSS, or as Avatar::build().
  static Result<TriggerVolume> lss(std::vector<Lss> lss);
  /// What is inside some object of the scene. The triangles may be turned any way, and in any
  /// order, but each object must be closed: every edge, by its exact coordinates, belongs to two of
  /// its triangles, or to another even number. Errors (Mismatch): an open edge; the message names
  /// the object and the edge, Error::index is a triangle of it. O(n log n).
  static Result<TriggerVolume> mesh(const Scene& closed);

  /// For the triggers' own sources.
  [[nodiscard]] const internal::VolumeParts& parts() const { return *parts_; }

 private:
  explicit TriggerVolume(std::shared_ptr<const internal::VolumeParts> parts)
      : parts_(std::move(parts)) {}
  std::shared_ptr<const internal::VolumeParts> parts_;
};

/// The group of triggers, unless they are given another: they meet all others.
inline constexpr BodyGroup kTriggerGroup = kNumBodyGroups - 1;

/// What a trigger looks at: a body, or a link of it.
struct Watched {
  BodyId body = 0;
  LinkId link = kEveryLink;
};

struct TriggerOptions {
  BodyGroup group = kTriggerGroup;
  /// By default a trigger without a new pose stays where it was, and nothing waits for it.
  WhenSilent whenSilent = WhenSilent::HoldStill;
  /// Empty: every body but other triggers.
  std::vector<Watched> watched;
  /// False: a body is inside as long as any of its links is, and enters and leaves as one. True:
  /// each link by itself.
  bool byLink = false;
};

/// For one thread. Keeps what is inside from window to window.
class Triggers {
 public:
  Triggers();
  ~Triggers();
  Triggers(Triggers&&) noexcept;
  Triggers& operator=(Triggers&&) noexcept;

  /// Makes it a body of the world, which it is for ever: push its poses, attach and detach it as
  /// any other's (body()). It is there from its first pose on. Triggers of one group do not meet
  /// each other, nor any the static scene. A mesh watches what is made of LSS, as two meshes are
  /// not asked. Errors: as World::add(), and a watched one that is not a body or link yet
  /// (UnknownName).
  Result<TriggerId> add(World& world, const TriggerVolume& volume,
                        const TriggerOptions& options = {});
  [[nodiscard]] std::int32_t numTriggers() const;
  /// Precondition: a trigger of this object (asserted).
  [[nodiscard]] BodyId body(TriggerId trigger) const;
  /// The trigger that the body is; -1 if it is none. O(1).
  [[nodiscard]] TriggerId triggerOf(BodyId body) const;

  /// Adds one to those that the trigger looks at. Errors: an unknown trigger, body or link; a
  /// trigger that was updated already (OutOfRange).
  Result<Done> watch(const World& world, TriggerId trigger, const Watched& watched);

  /// Puts one that was never placed where it stays, from an instant on: for eleven days
  /// (kLongestPieceUs) known, and then as its `whenSilent` says. Errors: as World::push().
  Result<Done> stand(World& world, TriggerId trigger, std::int64_t fromUs, const RigidPose& pose);

  /// What the events of the next stretch of time mean for the triggers. Call it for every answer of
  /// one WorldFollower of that world, in turn, before the world changes or forgets. Errors
  /// (Mismatch): another world; a stretch that does not begin where the last one ended; then
  /// nothing has changed. O(parts + what is inside + bodies that appear or change their carrier,
  /// times triggers).
  Result<Done> update(const World& world, const WorldEvents& events, TriggerEvents& answer);

  /// Forgets what is inside: the next update may begin anywhere, with another follower, and what is
  /// inside there starts inside.
  void beginAnew();

  /// By trigger, body and link.
  [[nodiscard]] const std::vector<Occupant>& occupants() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace foretouch
