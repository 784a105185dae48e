// bench/solid/feel.h: how a shown body follows a tracked one, tick by tick: where it deviates, when
// it is back, how it moves and what it costs. All of it from the poses themselves, by the judge's
// kinematics; what is shown may come from anywhere.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/solid/stage.h"
#include "bench/solid/way_audit.h"
#include "middleware/solid/solid_tick.h"

namespace foretouch::tools {

/// What follows tracked poses: the solid avatar, or one that it is compared with.
class Follower {
 public:
  Follower() = default;
  Follower(const Follower&) = delete;
  Follower& operator=(const Follower&) = delete;
  virtual ~Follower() = default;
  virtual Result<Done> follow(const Pose& tracked, double dtS, SolidTick& tick) = 0;
};

/// Deviations and lengths in metres, times in microseconds of the thread's processor time.
struct FeelTally {
  // Per tick and link: from the tracked place, lifted by SolidTick::lift.
  std::vector<double> deviation, hands, head;
  std::vector<double> headAlone;   ///< For ticks in which the tracked trunk is free.
  std::vector<double> handsAlone;  ///< For ticks in which the tracked trunk and hands are free.
  std::vector<double> acceleration, trackedAcceleration;  ///< Per tick and end of an LSS (m/s^2).
  // Per tick.
  std::vector<double> lift;
  std::vector<double> us, freeUs, contactUs, queries;
  std::vector<double> iterations, aroundQueries;
  std::vector<double> overBareUs;  ///< Ticks of one query: beyond the same query alone.
  std::vector<double> bareUs;      ///< The query from each tracked pose to the next.
  std::vector<double> back;  ///< Per time that the tracked pose comes free: ticks until equal.
  std::uint64_t ticks = 0, inside = 0, free = 0, equal = 0, away = 0;
  std::uint64_t late = 0;       ///< Free directly (by more than the tolerance), within the catch-up
                                ///< speed, and yet not equal.
  std::uint64_t neverBack = 0;  ///< Of those in `back`: inside again, or at the end, before equal.
  double fastest = 0.0;         ///< The speed of any end of an LSS (m/s).
  WayTally way;
  void add(const FeelTally& other);
};

/// True if it asked only the direct motion, and that was clear.
[[nodiscard]] inline bool isFreeTick(const SolidTick& tick) {
  return tick.state == SolidState::Equal && tick.counters.queries == 1;
}

/// Farther than this (m) from a free tracked pose is away.
inline constexpr double kAway = 0.05;

struct FeelRun {
  std::string name;
  double rateHz = 90.0;
  double tolerance = 5e-4;  ///< The tolerance of the follower's queries.
  double catchUp = 2.0;     ///< The follower's catch-up (m/s); for `late`.
};

/// Follows all of `tracked`. The judge says whether a tracked pose is free.
[[nodiscard]] Result<FeelTally> feel(const SolidStage& stage, const SolidActor& actor,
                                     const std::vector<Pose>& tracked, const FeelRun& run,
                                     Follower& follower);

}  // namespace foretouch::tools
