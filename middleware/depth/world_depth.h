// middleware/depth/world_depth.h: how deep a body of a world is in another, or in what stands
// still, at an instant, and which way out. Metres in W, world time in microseconds. The promise:
// docs/guarantees.md 18.
#pragma once

#include <cstdint>
#include <memory>

#include "articulated/result.h"
#include "middleware/depth/depth.h"
#include "middleware/world/world.h"
#include "middleware/world/world_contacts.h"

namespace foretouch {

/// Who is moved, and out of whom: whole bodies, or a link of each.
struct DepthQuestion {
  BodyId a = 0;
  LinkId linkOfA = kEveryLink;
  BodyId b = kStillScene;
  LinkId linkOfB = kEveryLink;
};

struct WorldDepth {
  Depth depth;  ///< Of a, which `depth.wayOut` moves, in W; the bounds hold where they truly are.
  /// The deepest pair, without witness points; of no pair, the bodies that were asked.
  ContactSide a, b;
  bool isAssumed = false;  ///< As WorldContact::isAssumed.
};

/// Memory that questions reuse; one per thread.
class WorldDepthScratch {
 public:
  WorldDepthScratch();
  ~WorldDepthScratch();
  WorldDepthScratch(WorldDepthScratch&&) noexcept;
  WorldDepthScratch& operator=(WorldDepthScratch&&) noexcept;

  struct Parts;
  /// For the question's own sources.
  [[nodiscard]] Parts& parts() { return *parts_; }

 private:
  std::unique_ptr<Parts> parts_;
};

/// At an instant at which a body changes its carrier: after it. Poses of parts of the motion are
/// not rounded as worldContacts() rounds them, so a contact's own instant may be asked. Errors: an
/// unknown body or link (Error::index), two links that are one; a body that touches by its
/// triangles (BodyOptions::surface): its LSS alone would not say how deep; two meshes, or a mesh
/// and the scene (one of two must be made of LSS); a world without a scene; a body that is not
/// there then, or silent and not taken to hold still. O(joints, and what depthIn() takes).
Result<WorldDepth> depthAt(const World& world, const WorldTime& time, const DepthQuestion& question,
                           WorldDepthScratch& scratch);

}  // namespace foretouch
