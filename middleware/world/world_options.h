// middleware/world/world_options.h: what a world and its bodies are told when they are made.
// Metres.
#pragma once

#include <cstdint>
#include <optional>

#include "articulated/pair_rules.h"
#include "articulated/skeleton.h"
#include "articulated/track.h"
#include "middleware/query_options.h"
#include "middleware/surface/avatar_surface.h"
#include "middleware/world/world_contacts.h"

namespace foretouch {

/// Bodies are in groups 0 to 31; what is asked is said of groups.
using BodyGroup = std::int32_t;
inline constexpr BodyGroup kNumBodyGroups = 32;
/// At most this many bodies.
inline constexpr std::int32_t kMaxBodies = 100'000;

struct WorldOptions {
  /// eps in metres, of every contact: kMinWorldTolerance to kMaxTolerance.
  double tolerance = kDefaultTolerance;
  /// Asks, too, whether two meshes meet, and a mesh and the static scene: triangles against
  /// triangles. Otherwise one of two must be made of LSS, or bring a surface.
  bool askMeshes = false;
};
/// Below it, parts of motions between knots of different bodies are not known well enough (m).
inline constexpr double kMinWorldTolerance = 1e-8;

struct BodyOptions {
  BodyGroup group = 0;
  WhenSilent whenSilent = WhenSilent::Wait;
  /// Asks whether own links touch each other. Of the same avatar.
  std::optional<PairRules> self;
  /// The avatar touches by these triangles (exact fidelity), whoever it meets, and so do its own
  /// links; an LSS that holds none of its link's triangles is its own surface. Nothing: by its LSS.
  std::optional<AvatarSurface> surface;
};

/// Who moves a body.
struct Carrier {
  BodyId body = 0;
  LinkId link = 0;
  /// False: it keeps the place that it is attached at, and needs no poses until it is detached.
  /// True: its poses are in the frame of that link, and are pushed like all others.
  bool movesInFrame = false;
};

}  // namespace foretouch
