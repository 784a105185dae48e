// middleware/solid_world/solid_world.h: solid avatars (middleware/solid/solid_avatar.h) in a world
// in which other things move (middleware/world/world.h): doors push them, what they hold is solid
// with them, two of them meet and neither passes. What each gets, and what it shows. Metres in
// W, world time in microseconds. The algorithm, the promise and its proof:
// middleware/solid_world/solid_world.md.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "middleware/events/world_follower.h"
#include "middleware/scene/scene.h"
#include "middleware/solid/solid_options.h"
#include "middleware/solid_world/solid_body_tick.h"
#include "middleware/world/world.h"
#include "middleware/world/world_contacts.h"

namespace foretouch {

/// How far solid avatars reach in SolidWorld::world().
enum class SolidReach : std::uint8_t {
  /// To the gap at which they stop (SolidOptions::skin): a question to the world, or a follower,
  /// finds them in contact with what they press against.
  Skin,
  /// To their surface: they are found to touch nothing but what crushes them.
  Surface,
};

/// A world, its solid avatars, and their memory. For one thread. What it answers depends on the
/// poses and the options alone.
class SolidWorld {
 public:
  /// `still`: what never moves. The first tick begins at `beginUs`. Errors: as World::build(), an
  /// instant out of range.
  static Result<SolidWorld> build(const Scene& still, std::int64_t beginUs,
                                  const WorldOptions& options = {},
                                  SolidReach reach = SolidReach::Skin);
  SolidWorld(SolidWorld&&) noexcept;
  SolidWorld& operator=(SolidWorld&&) noexcept;
  ~SolidWorld();

  /// The world: add what moves by itself (doors, lifts, balls), push its poses, attach what hands
  /// hold. A solid avatar's own poses are pushed by tick() alone. It reaches to its
  /// skin there, unless build() said otherwise, or it has own links or a surface (BodyOptions).
  [[nodiscard]] World& world();
  [[nodiscard]] const World& world() const;

  /// A solid avatar. It is there from its first target on. Errors: as SolidAvatar::build() and
  /// World::add(); SolidOptions::maySnap, since on a timeline no body jumps.
  Result<BodyId> add(const Avatar& avatar, const SolidOptions& options = {},
                     const BodyOptions& body = {});

  /// Where the last tick ended.
  [[nodiscard]] std::int64_t utimeUs() const;

  /// One tick, to `utimeUs`. An avatar without a target in it keeps its last one. Moves what is not
  /// a solid avatar as the world knows it; then each solid avatar, by body: it certifies its motion
  /// against everything that moves before it, and against those after it as they stand. Its way is
  /// pushed into the world. `ticks`: one per solid avatar that has had a target, by body.
  /// Errors, of which each names its body, and which change nothing: an instant that is not 1 us to
  /// 10 s after the last one; a bad target (as SolidAvatar::follow()), one for no solid avatar, or
  /// two for one; a body that waits for its poses (WhenSilent::Wait) and is not known until
  /// then; a solid avatar that is carried; what moves in its hand (Carrier::movesInFrame), or
  /// changes hands within the tick; a tick that begins before what the world has forgotten.
  /// Allocates nothing once memory has grown, as long as no hand takes or lets go.
  Result<Done> tick(std::int64_t utimeUs, const std::vector<SolidBodyTarget>& targets,
                    std::vector<SolidBodyTick>& ticks);

  /// What has happened from where the last call ended until the last tick's end: which body meets
  /// which, from enter to leave, at the instants at which the shown motions do (world_follower.h).
  /// A solid avatar enters what it comes as near to as its skin and the world's tolerance; its
  /// points are those of its skin. What presses on it meanwhile, and how hard, is in the ticks.
  /// To be called before World::forgetBefore(). Errors: as WorldFollower::follow().
  Result<Done> follow(WorldEvents& events);
  /// For what bodies weigh, and what is open now.
  [[nodiscard]] WorldFollower& follower();

  class Parts;

 private:
  explicit SolidWorld(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace foretouch
