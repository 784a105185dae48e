#include "middleware/solid/stuck_watch.h"

#include <algorithm>

namespace foretouch::internal {
namespace {

// When a way around is looked for (solid.md 7): farther than this from the target (m), and moving
// by less than this share of it for so long (s, ticks).
constexpr double kFarEnough = 0.05, kProgress = 0.02, kStuckFor = 0.05;
constexpr int kStuckTicks = 3;
/// The target of the point that is farthest off stays within this, meanwhile (m).
constexpr double kStaysWithin = 0.02;
/// After the target was found inside something.
constexpr int kTicksToLookAgain = 8;
constexpr double kSecondsToLookAgain = 0.1;

}  // namespace

StuckWatch::StuckWatch(const SolidOptions& options)
    : most_{options.mostDeviation, options.mostLimbDeviation, options.patience, options.snapNotice,
            options.maySnap} {}

void StuckWatch::look(const Deviation& deviation, double dtS) {
  // What leads on meanwhile leads a search astray, and a hand that is pressed into a table for a
  // moment is to stay on it: but not for ever.
  const bool goesOn = deviation.moved >= kProgress * deviation.far;
  const bool isStuck = deviation.far > kFarEnough && !goesOn &&
                       (stuckTicks_ == 0 || (deviation.wanted - stuckAt_).norm() < kStaysWithin);
  if (!isStuck || stuckTicks_ == 0) stuckAt_ = deviation.wanted;
  stuckS_ = isStuck ? stuckS_ + dtS : 0.0;
  stuckTicks_ = isStuck ? stuckTicks_ + 1 : 0;
  if (!isStuck) lookAt_ = 0;
  const bool isAway = deviation.farOfRoots > most_.deviation || deviation.far > most_.limbDeviation;
  awayS_ = isAway ? awayS_ + dtS : 0.0;
  isCaught_ = !goesOn && awayS_ > most_.patience;
}

bool StuckWatch::wantsAround() const {
  return isCaught_ || (stuckS_ >= kStuckFor && stuckTicks_ >= std::max(kStuckTicks, lookAt_));
}

void StuckWatch::foundInside() {
  lookAt_ = stuckTicks_ + kTicksToLookAgain;
  if (wantsSnap()) awayS_ = most_.patience;
  if (isCaught_ && !most_.maySnap) awayS_ = most_.patience - kSecondsToLookAgain;
  isCaught_ = false;
}

double StuckWatch::snapInS() const {
  return std::max(0.0, most_.patience + most_.snapNotice - awayS_);
}

}  // namespace foretouch::internal
