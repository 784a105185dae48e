// middleware/world/world.h: everything that moves, on one timeline: avatars, rigid props, and what
// they carry, each known at instants of its own, beside an optional scene that stands still. World
// time in microseconds, metres in W.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>

#include "articulated/avatar.h"
#include "articulated/pair_rules.h"
#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "articulated/track.h"
#include "middleware/query_options.h"
#include "middleware/scene/scene.h"
#include "middleware/scratch.h"
#include "middleware/surface/avatar_surface.h"
#include "middleware/worker_pool.h"
#include "middleware/world/world_contacts.h"
#include "middleware/world/world_options.h"

namespace foretouch {

namespace internal {
struct WorldParts;
}
struct DepthQuestion;
struct WorldDepth;

/// The bodies, and where they are known to be. Changed by one thread; any number may ask in
/// between, each with scratch memory of its own. A body is there from its first pose on; before,
/// nothing touches it.
class World {
 public:
  /// Errors: a tolerance out of range.
  static Result<World> build(std::optional<Scene> still, const WorldOptions& options = {});
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;
  ~World();

  /// An avatar, or a prop that is made of LSS: the LSS of its links touch, or the triangles of the
  /// surface that it brings. Errors: a group out of range, pair rules or a surface of another
  /// avatar, a surface beside rules with pair radii, too many bodies.
  Result<BodyId> add(const Avatar& avatar, const BodyOptions& options = {});
  /// A rigid prop: the triangles touch, in its own frame. It meets avatars; two meshes are asked
  /// whether they meet, and a mesh and the static scene, where WorldOptions::askMeshes says so.
  /// O(n log n) for each new mesh of n triangles: 30 ms for 10,000.
  /// Errors: as above; own links, of which it has none, a surface, or a skin; a mesh that is
  /// so large that the LSS around it leaves kMaxCoordinate (OutOfRange).
  Result<BodyId> add(const Scene& mesh, const BodyOptions& options = {});
  [[nodiscard]] std::int32_t numBodies() const;

  /// The body's next pose: in W, or in the frame of what carries it and lets it move. Errors: as
  /// Track::push(), an unknown body (Error::index), and a body that is carried and held fast.
  Result<Done> push(BodyId body, std::int64_t utimeUs, const Pose& pose);
  /// The same for a body of one joint, as every mesh is.
  Result<Done> push(BodyId body, std::int64_t utimeUs, const RigidPose& pose);

  /// From `utimeUs` on, the body is carried; `pose` is its pose there in the frame of the carrier's
  /// link. The body and the link that carries it are not asked whether they meet: all of it, while
  /// it is held fast; its root links, if it moves in the frame, for its other links may hit the
  /// carrier. Errors: unknown bodies or links; a body that carries the carrier at any time from
  /// then on (BadHierarchy); a carrier that hangs on kMaxChainDepth bodies or more; a body or
  /// carrier that is not known at that instant, or a body that was attached or detached later.
  Result<Done> attach(BodyId body, const Carrier& carrier, std::int64_t utimeUs, const Pose& pose);
  Result<Done> attach(BodyId body, const Carrier& carrier, std::int64_t utimeUs,
                      const RigidPose& pose);
  /// From `utimeUs` on, no body carries this one; `pose` is its pose there, in W. Errors: as above,
  /// and a body that is not carried.
  Result<Done> detach(BodyId body, std::int64_t utimeUs, const Pose& pose);
  Result<Done> detach(BodyId body, std::int64_t utimeUs, const RigidPose& pose);

  /// Whether bodies of two groups are asked if they meet; everything is, to begin with. Errors: a
  /// group out of range.
  Result<Done> ask(BodyGroup a, BodyGroup b, bool isAsked);
  /// The same for bodies of a group and the static scene.
  Result<Done> askStill(BodyGroup group, bool isAsked);

  /// All is known, or taken to be, until here: the earliest last pose of the bodies that wait for
  /// theirs (WhenSilent::Wait); if none waits, the latest pose of all. Nothing if there is none.
  [[nodiscard]] std::optional<std::int64_t> knownUntilUs() const;
  /// The body that knownUntilUs() waits for; nothing if it waits for none.
  [[nodiscard]] std::optional<BodyId> waitsFor() const;

  /// The first contact, in the window from `fromUs` to `toUs`, of every two links of different
  /// bodies that are asked, of every link and the static scene, and of own links where a body asks
  /// for these. Depends on the poses alone, not on the order in which they came, nor on how many
  /// threads share the work. Allocates nothing once the scratch and the answer have grown, as long
  /// as no body is added or carried in another way. The promise: docs/guarantees.md 15. Errors,
  /// which name what is wrong: a window without length, that begins where it has forgotten, or
  /// ends after knownUntilUs(); carriers whose chains are too deep together; on a pool, memory ran
  /// out (DeviceFailed): the answer then means nothing. The world must not change meanwhile.
  Result<Done> contacts(std::int64_t fromUs, std::int64_t toUs, Scratch& scratch,
                        WorldContacts& answer) const;
  Result<Done> contacts(std::int64_t fromUs, std::int64_t toUs, WorkerPool& pool,
                        WorldContacts& answer) const;

  /// How deep a body is in another, or in what stands still, and which way out
  /// (depth/world_depth.h). At an instant at which a body changes its carrier: after it. Poses of
  /// parts of the motion are not rounded as contacts() rounds them, so a contact's own instant may
  /// be asked. Errors: an unknown body or link (Error::index), two links that are one; a body that
  /// touches by its triangles (BodyOptions::surface): its LSS alone would not say how deep; two
  /// meshes, or a mesh and the scene (one of two must be made of LSS); a world without a scene; a
  /// body that is not there then, or silent and not taken to hold still. O(joints, and what
  /// depthIn() takes).
  [[nodiscard]] Result<WorldDepth> depth(const WorldTime& time, const DepthQuestion& question,
                                         Scratch& scratch) const;

  /// Lets go of what no window from `utimeUs` on needs, but for where a body was that is put
  /// elsewhere there. Poses at or before it are refused from now on, and so are windows that
  /// begin before it.
  void forgetBefore(std::int64_t utimeUs);
  /// The same by memory: lets go of the oldest poses of all until poseBytes() is at most `bytes`,
  /// or nothing is left before knownUntilUs(). Returns the instant before which it has forgotten.
  std::int64_t forgetBeyond(std::size_t bytes);
  /// The bytes that the kept poses take: a pose of n joints takes 56 n + 256, an allocator's share
  /// included. O(bodies).
  [[nodiscard]] std::size_t poseBytes() const;

  /// Lets go of poses before `utimeUs` between others that say nearly the same: no point of any
  /// body, of what it carries included, is ever farther than `metres` from where all poses that
  /// were pushed have it, however often this is called (world.md 7). Answers about instants from
  /// `utimeUs` on stay the same, to the bit; those about earlier ones are, from now on, true of the
  /// motion that is left. First and last poses are kept, and those at which a carrier
  /// changes. Bodies can no longer be attached before `utimeUs`. Errors: metres that are not
  /// finite, or below 0. O(joints) per pose that is new since the last call.
  Result<Done> thinBefore(std::int64_t utimeUs, double metres);

  /// For the query's own sources.
  [[nodiscard]] const internal::WorldParts& parts() const { return *parts_; }

 private:
  explicit World(std::unique_ptr<internal::WorldParts> parts);
  std::unique_ptr<internal::WorldParts> parts_;
};

}  // namespace foretouch
