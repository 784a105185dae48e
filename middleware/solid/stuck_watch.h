// middleware/solid/stuck_watch.h: for how long an avatar has been held away from its target: when
// to look for a way around, and when to snap (solid.md 7). Metres in W, seconds. Not installed.
#pragma once

#include <Eigen/Core>

#include "middleware/solid/solid_options.h"

namespace foretouch::internal {

/// How far an avatar is from its target at the end of a tick.
struct Deviation {
  double far = 0.0;                                  ///< How far the point is that is farthest off.
  Eigen::Vector3d wanted = Eigen::Vector3d::Zero();  ///< Where the target has that point.
  double farOfRoots = 0.0;                           ///< How far the root is that is.
  double moved = 0.0;  ///< The farthest that any point went in the tick.
};

class StuckWatch {
 public:
  explicit StuckWatch(const SolidOptions& options);

  void reset() { *this = StuckWatch(most_); }
  /// A tick that did not reach the target.
  void look(const Deviation& deviation, double dtS);
  /// Whether it has been stuck, or far away, for so long that a way around is worth a search.
  [[nodiscard]] bool wantsAround() const;
  /// Whether it is far away, so that a search is worth it though the target goes on.
  [[nodiscard]] bool isCaught() const { return isCaught_; }
  [[nodiscard]] bool wantsSnap() const { return wantsSnapIn(0.0); }
  /// Whether it may want to snap, if it stays away for so long.
  [[nodiscard]] bool wantsSnapIn(double dtS) const {
    return most_.maySnap && awayS_ + dtS > most_.patience;
  }
  /// The target is inside something: a search has to wait, and a snap that was announced is
  /// withdrawn, and announced anew in full.
  void foundInside();
  /// Seconds until it snaps.
  [[nodiscard]] double snapInS() const;

 private:
  struct Limits {
    double deviation, limbDeviation, patience, snapNotice;
    bool maySnap;
  };
  explicit StuckWatch(const Limits& most) : most_(most) {}

  Limits most_;
  double stuckS_ = 0.0, awayS_ = 0.0;
  Eigen::Vector3d stuckAt_ = Eigen::Vector3d::Zero();  // where that point's target was at first
  int stuckTicks_ = 0, lookAt_ = 0;
  bool isCaught_ = false;  // far away for longer than the patience, and no nearer
};

}  // namespace foretouch::internal
