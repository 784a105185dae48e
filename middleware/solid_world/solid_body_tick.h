// middleware/solid_world/solid_body_tick.h: what a solid avatar among bodies that move
// (solid_world.h) gets, and what it shows. Lengths in metres in the world W, world time in
// microseconds.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "articulated/skeleton.h"
#include "middleware/solid/solid_tick.h"
#include "middleware/world/world_contacts.h"

namespace foretouch {

/// Where the tracker says that a solid avatar is at the end of a tick.
struct SolidBodyTarget {
  BodyId body = 0;
  const Pose* pose = nullptr;  ///< Not null.
  /// As SolidTarget::isTracked.
  const std::vector<std::uint8_t>* isTracked = nullptr;
};

/// A moving body that holds or pushes the avatar.
struct SolidBodyContact {
  BodyId body = 0;
  LinkId link = 0;        ///< The avatar's.
  std::int32_t lss = -1;  ///< Among the link's LSS; those of tools in its hand come after its own.
  TriangleId triangle = -1;                          ///< In a mesh; else -1.
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();     ///< On the body's surface.
  Eigen::Vector3d nhat_W = Eigen::Vector3d::Zero();  ///< Unit, from it to the avatar.
  double gap = 0.0;
  double push = 0.0;       ///< As SolidContact::push; what the body's own motion adds is in it.
  double slipSpeed = 0.0;  ///< How fast the link's point goes along that moving surface (m/s).
};

/// A body that nothing holds back has left the avatar no proven way: between the two nothing is
/// claimed from `sinceUs` on. Everything else stays proven.
struct SolidCrush {
  BodyId body = 0;
  LinkId link = 0;  ///< Where it was met; while they overlap, the link that is deepest.
  std::int64_t sinceUs = 0;
  /// It ended at the tick's begin, where the two are proven apart, or where the body is no longer
  /// asked about (silent: isAssumed); reported once. False: it lasts.
  bool isOver = false;
  /// At the tick's end: the largest depth of a link's axis below the body's surface, its radius at
  /// most. To part them takes at least as much. 0: they do not overlap there.
  double depth = 0.0;
};

struct SolidBodyTick {
  BodyId body = 0;
  /// As for an avatar in a still scene. Its `contacts` are those with the scene and with own links;
  /// `times` are those of the world's poses: whole microseconds. `isCertified` and `clearance` are
  /// about moving bodies, too: false and 0 while something crushes it.
  SolidTick tick;
  std::vector<SolidBodyContact> contacts;
  std::vector<SolidCrush> crushes;
  /// What its hands hold and is solid with it.
  std::vector<BodyId> tools;
  /// What they hold, and what touches something where it was taken: nothing is claimed of it until
  /// it is apart from everything at a tick's begin. Then it is one of `tools`.
  std::vector<BodyId> looseTools;
  /// What they let go of and still touch: the two are not asked until they are apart.
  std::vector<BodyId> letGo;
  /// A body around it was silent, and was taken to hold still or to be nowhere (WhenSilent).
  bool isAssumed = false;
};

}  // namespace foretouch
