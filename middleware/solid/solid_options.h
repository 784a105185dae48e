// middleware/solid/solid_options.h: what a solid avatar (solid_avatar.h) follows, and how. Lengths
// in metres in W, times in seconds. Where each constant comes from: middleware/solid/solid.md.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "articulated/pair_rules.h"
#include "articulated/skeleton.h"
#include "middleware/query_options.h"

namespace foretouch {

/// What to do about tracked feet below the floor: calibration is often off by centimetres.
enum class FloorPolicy : std::uint8_t {
  Lift,  ///< The whole target is lifted, slowly, as far as the feet ask for: SolidTick::lift. So a
         ///< constant error does not bend the knees of a body that stands.
  Hold,  ///< A floor is a surface like all others.
};

/// "lift", "hold".
[[nodiscard]] const char* toString(FloorPolicy floor);

struct SolidOptions {
  /// The gap to surfaces that the avatar keeps where it can: a step of 1 cm on a lever of 30 cm is
  /// linear to 0.2 mm. 1e-5 to 0.1.
  double skin = 2e-3;
  /// Tolerance of queries that certify motions; at most half the skin. A link that begins nearer
  /// than that has half its gap for its tolerance.
  double tolerance = 5e-4;
  /// How much faster than the tracked pose the shown one may move while it catches up (m/s, of any
  /// point). An arm that comes free does not jump.
  double catchUp = 2.0;
  /// One per link, >= 0: how much an error of the link's surface counts, beyond its area. What
  /// counts much stays at its tracked place and lets the others yield. Empty: hands 4, trunk and
  /// head 100, all others 1 (visibilityByName()). So a limb in contact yields alone, and the trunk
  /// only if the limb cannot.
  std::vector<double> visibility;
  FloorPolicy floor = FloorPolicy::Lift;
  /// One per link: true for those that FloorPolicy::Lift listens to. Empty: those with a name of a
  /// foot or toe (feetByName()).
  std::vector<bool> feet;
  Eigen::Vector3d up = Eigen::Vector3d::UnitY();  ///< Unit; for the floor policy and placing.
  double mostLift = 0.1;                          ///< 0 to 1.
  /// Farther from the tracked pose than this, for longer than `patience`, counts as Held for the
  /// whole avatar (its roots) or a limb, and a snap may follow.
  double mostDeviation = 0.5, mostLimbDeviation = 0.35, patience = 0.7;
  /// Whether the avatar may then appear at the tracked pose, if that is free: the only break of the
  /// shown curve after the first place. It is announced for `snapNotice` before
  /// (SolidTick::snapInS), so that a game can fade.
  bool maySnap = false;
  double snapNotice = 0.25;
  /// Looks for a proven way around where sliding ends: motions tried per tick, and per target. 0:
  /// never.
  std::int32_t aroundPerTick = 64, aroundInAll = 2000;
  /// First places and snaps: how far from the asked pose a free place may be.
  double placingReach = 2.0;
  /// Links, or links and objects, that touch nothing: a hole in the promise that the caller wants.
  std::vector<IgnoredPair> ignored;
  /// Whether own links stop each other, too: a hand rests on the knee. The same avatar's.
  std::optional<PairRules> self;
  /// When a tick takes no further step, in evaluations of a pair in lanes (about 10 ns); the step
  /// that spends the last of it is finished. What is not reached by then waits for the next tick;
  /// nothing is shown that is not proven. At least 1.
  std::uint64_t workBudget = 60'000;
};

/// As SolidOptions::visibility by the names of the avatar's links, of any common convention.
[[nodiscard]] std::vector<double> visibilityByName(const Avatar& avatar);
/// As SolidOptions::feet.
[[nodiscard]] std::vector<bool> feetByName(const Avatar& avatar);
/// Links with a name of a head: where the camera is.
[[nodiscard]] std::vector<bool> headsByName(const Avatar& avatar);

/// Where the tracker says that the avatar is.
struct SolidTarget {
  const Pose& pose;
  double dtS;  ///< Seconds since the last target, > 0 and at most 10.
  /// One per joint: 0 if its tracker lost it, so that its place in `pose` means nothing (but must
  /// be finite). Null: all are tracked. A lost joint keeps its place on its parent; a lost root
  /// stays where it is.
  const std::vector<std::uint8_t>* isTracked = nullptr;
};

}  // namespace foretouch
