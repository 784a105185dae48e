// middleware/world/world_options.h: what a world and its bodies are made with.
// Metres.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
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

/// About a second.
inline constexpr std::uint64_t kDefaultWorkPerPair = 100'000'000;

struct WorldOptions {
  /// eps in metres, of every contact: kMinWorldTolerance to kMaxTolerance.
  double tolerance = kDefaultTolerance;
  /// Asks, too, whether two meshes meet, and a mesh and the static scene: triangles against
  /// triangles. Otherwise one of two must be made of LSS, or bring a surface.
  bool askMeshes = false;
  /// Work that two bodies may cost in one window, and a body by itself in one span between its
  /// poses; counted as QueryOptions::workBudget, so the same worlds have the same answers. Beyond
  /// it the rest is undecided (WorkBudget), free as far as proven. What two do mostly costs a
  /// thousandth of it; a mesh of many kilometres that turns takes more than any budget.
  std::uint64_t workPerPair = kDefaultWorkPerPair;
  /// Work that all pairs of bodies of one window may cost together; without a bound unless set.
  /// Each pair has a share: one part of it per body; a body that is near many others has one part
  /// for all its pairs. So a heap of bodies leaves those beside it their answers. What some
  /// leave over goes to those that need more. What follows the world (WorldFollower) may spend as
  /// much again. With thousands of pairs and a small budget, most are undecided without a look.
  std::uint64_t workPerWindow = std::numeric_limits<std::uint64_t>::max();
  /// A body that may meet more than so many others in a window is crowded; without a bound unless
  /// set. Two that are crowded are not asked about each other: each is reported as a body of which
  /// nothing is known in that window (WorldContacts::silent, WorkBudget), and not once per pair.
  std::size_t mostNear = std::numeric_limits<std::size_t>::max();
};
/// Below it, parts of motions between knots of different bodies are not known well enough (m).
inline constexpr double kMinWorldTolerance = 1e-8;

struct BodyOptions {
  BodyGroup group = 0;
  WhenSilent whenSilent = WhenSilent::Wait;
  /// Asks whether own links touch each other. The same avatar's.
  std::optional<PairRules> self;
  /// The avatar touches by these triangles (exact fidelity), whatever it meets, and so do its own
  /// links; an LSS that holds none of its link's triangles is its own surface. Nothing: by its LSS.
  std::optional<AvatarSurface> surface;
  /// The same avatar's: what questions at an instant (askWorld()) meet of the links that have
  /// triangles of it, bent as it is then. First contacts, events and depths go by the LSS or the
  /// surface, as if there were no skin.
  std::optional<SkinnedSurface> skin;
  /// A volume that others are in, as a trigger's is: solid bodies go through it.
  bool isVolume = false;
};

/// What moves a body.
struct Carrier {
  BodyId body = 0;
  LinkId link = 0;
  /// False: it keeps the place that it is attached at, and needs no poses until it is detached.
  /// True: its poses are in the frame of that link, and are pushed like all others.
  bool movesInFrame = false;
};

}  // namespace foretouch
