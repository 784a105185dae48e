// bench/peers/motion_sets.h: generated motions of one LSS in a scene, half of them colliding.
// Metres.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "bench/peers/rigid_sweep.h"
#include "judge/first_touch.h"

namespace foretouch::tools {

/// The parameters of a set's motions.
struct MotionSetKind {
  const char* name;
  const char* description;
  double radius;      ///< The LSS's radius (m); its axis is kAxisLength long.
  double mostTurn;    ///< Radians.
  double mostTravel;  ///< The pivot's (m).
};

inline constexpr double kQuarterTurn = 1.57079632679489662;
inline constexpr double kAxisLength = 0.3;
/// The pivot lies before the axis's end and beside it, as an elbow does to a forearm.
inline constexpr double kPivotBefore = 0.1, kPivotBeside = 0.05;
/// Motions start at least this far from the scene, so that no solver's tolerance decides them.
inline constexpr double kStartClearance = 1e-3;
/// Threshold of deep, near and late (m).
inline constexpr double kJudgedDistance = 1e-3;

/// A forearm between two samples at 30 Hz; the same without turning; the same of a finger's width.
inline constexpr std::array<MotionSetKind, 3> kMotionSets = {
    {{"S1", "a forearm, moved and turned about an offset pivot", 0.06, kQuarterTurn, 0.5},
     {"S2", "the same, moved without turning", 0.06, 0.0, 0.5},
     {"S5", "a finger, moved and turned as in S1", 0.01, kQuarterTurn, 0.5}}};

/// The truth about a motion.
struct SweepTruth {
  bool touches = false;
  double toi = 1.0;       ///< First contact, to within oracle::kTouchSeparation of separation.
  bool isDeep = false;    ///< Touches also with a radius less by kJudgedDistance.
  bool comesNear = true;  ///< Comes within kJudgedDistance of the scene.
};

struct MotionSet {
  std::string name, description;
  Lss lss_L;  ///< The LSS of every sweep.
  std::vector<RigidSweep> sweeps;
  std::vector<SweepTruth> truths;  ///< One per sweep.
  std::size_t uncertain = 0;  ///< Motions drawn and discarded, because their truth stayed unknown.
};

/// The first touch of the sweep's LSS with `radius` (m) instead of its own.
[[nodiscard]] oracle::FirstTouch firstTouch(const oracle::Scene& scene, const RigidSweep& sweep,
                                            double radius);

/// `count` motions: floor(count / 2) colliding and the rest free, in the order drawn. The pivot's
/// travel has a uniform direction and length, the turn a uniform axis and angle, the LSS starts
/// anywhere in the scene's box and turned in any way, at least kStartClearance from the scene.
/// Errors: a scene without enough motions of either kind. The same on every machine with the same
/// sines.
[[nodiscard]] Result<MotionSet> drawnSet(const MotionSetKind& kind, const oracle::Scene& scene,
                                         std::size_t count, std::uint64_t seed);

/// The truth of one motion; nothing if it stays uncertain.
[[nodiscard]] std::optional<SweepTruth> truthOf(const oracle::Scene& scene,
                                                const RigidSweep& sweep);

}  // namespace foretouch::tools
