// middleware/solid/pace.h: how far a solid avatar may move in a tick: as far as the tracked one,
// and so much farther as the catch-up speed allows. Metres, seconds, radians. Not installed.
#pragma once

#include <cstdint>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "articulated/skeleton.h"
#include "middleware/solid/solid_options.h"
#include "middleware/solid/target_pose.h"
#include "middleware/solid/visual_body.h"

namespace foretouch::internal {

/// How far a motion takes the body: the longest path of any point, of the head's points, and the
/// largest turn of a joint.
struct Moved {
  double all = 0.0, head = 0.0, turn = 0.0;
};

/// For one thread; keeps its memory.
class Pace {
 public:
  using Places = std::vector<Eigen::Vector3d>;

  Pace(const Avatar& avatar, const VisualBody& body, const SolidOptions& options);

  /// The avatar stands, or goes with the tracked one.
  void rest() { speed_ = headSpeed_ = 0.0; }
  /// The places of the body's points, as a tick begins.
  struct Begin {
    const Places &shown, &wanted;
    const Places& lastWanted;  ///< At the last target; empty: there is none.
    bool goesAlong;            ///< What is shown is the last target.
  };
  /// A tick begins. `lift`: how much of what the target has moved is the lift's.
  void begin(const TargetPose& target, const Begin& places, double lift, double dtS);
  /// It has ended: what was moved says how fast the next one may be.
  void end();

  /// How far the farthest point of the target moved since the last tick.
  [[nodiscard]] double trackedStep() const { return tracked_.all; }
  /// Whether nothing worth a motion is left.
  [[nodiscard]] bool isSpent() const;
  /// How much of a step may be taken that moves the body so far: more than 1 where that is more.
  [[nodiscard]] double shareOf(const Moved& step) const;
  /// Whether all of a motion may be taken, as far as the chord of its path says: false is certain.
  [[nodiscard]] bool mayGo(const Places& here, const Places& there) const;
  /// How much of the motion may be shown, in [0, 1]. `part`: becomes the pose there, if it is less
  /// than the whole and more than nothing.
  [[nodiscard]] double shareOf(const Pose& from, const Pose& to, Pose& part);
  /// What is shown. `there`: the points' places at `to`; `here`: at `from`.
  void spend(const Pose& from, const Pose& to, const Places& here, const Places& there);
  /// The same, for a caller that has not placed them.
  void spend(const Pose& from, const Pose& to);
  /// How far a motion takes the body.
  [[nodiscard]] Moved measure(const Pose& from, const Pose& to, const Places& here,
                              const Places& there);

  /// Whether the point is on a link that is a head.
  [[nodiscard]] bool isOfHead(std::size_t point) const { return isHead_[point] != 0; }

 private:
  [[nodiscard]] Moved chords(const Places& one, const Places& other) const;
  [[nodiscard]] int piecesOf(const Pose& from, const Pose& to);
  void placeAt(double t, Places& places);
  void findUncounted(const TargetPose& target);

  Skeleton skeleton_;
  VisualBody body_;
  double catchUp_;
  std::vector<std::uint8_t> isHead_;       // per point
  std::vector<std::uint8_t> isUncounted_;  // per joint: what the tracker had lost, and all below
  double speed_ = 0.0, headSpeed_ = 0.0;   // beyond the tracked one, in the last tick
  double dtS_ = 0.0;
  bool goesAlong_ = false;  // the whole motion of the target may be shown, whatever its path
  Moved tracked_, left_, spent_;
  ChainMotion motion_;
  std::vector<LinkState> states_;
  Places before_, after_, here_, there_;
};

}  // namespace foretouch::internal
