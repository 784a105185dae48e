// articulated/motion_model.h: what a body is taken to do between two poses: the constant rate of
// articulated/motion.h, or a cubic that follows the poses around the step. Metres, radians,
// seconds; t is 0 at the earlier pose and 1 at the later. Rounding and what pieces leave out:
// articulated/motion_model.md.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "articulated/skeleton.h"

namespace foretouch {

enum class MotionModel : std::uint8_t {
  ConstantRate,  ///< Each joint turns at a constant rate (articulated/motion.h).
  Cubic,         ///< A cubic that needs no later pose: it ends without a bend.
  CubicLate,     ///< A cubic that needs the pose after the step.
};
/// "constant-rate", "cubic", "cubic-late".
[[nodiscard]] const char* toString(MotionModel model);

/// The poses of a step and around it: validated ones of one skeleton. Seconds > 0.
struct PosedStep {
  const Pose* before = nullptr;  ///< The pose before `from`; null: there is none.
  const Pose* from = nullptr;
  const Pose* to = nullptr;
  const Pose* after =
      nullptr;  ///< The pose after `to`; null: there is none, or it is not known yet.
  double secondsBefore = 0.0, seconds = 0.0, secondsAfter = 0.0;
};

/// How far the model may be from the constant rate between two of its instants, per joint, in its
/// parent's frame: an angle (rad) and a length (m).
struct JointStray {
  double turn = 0.0, shift = 0.0;
};

/// A step of one skeleton by a model. The cubic is Hermite's, in the logarithm of each joint's
/// rotation relative to `from` and in its translation; slopes are central differences of the poses,
/// where both neighbours are there, and else such that the curve does not bend at that end.
/// A joint that turns by more than kMostTurn in the step turns at a constant rate; one that the
/// curve would lead beyond kMaxCoordinate moves at a constant rate.
class ModelMotion {
 public:
  static constexpr double kMostTurn = 2.5;  // rad

  /// Allocates only if there are more joints than ever before. O(joints).
  void assign(const Skeleton& skeleton, const PosedStep& step, MotionModel model);
  /// True: it is the constant rate, and one piece is all of it.
  [[nodiscard]] bool isConstantRate() const { return isConstantRate_; }
  /// Goes on for `horizon` seconds as the step went, at a constant rate: in pieces of which the
  /// first is at most a 32nd of it, each other at most as long as all before it, and in which no
  /// joint turns by more than 1 rad. Fills in their ends (s after `to`, and the poses). False: it
  /// would take more than `most` pieces, or lead beyond kMaxCoordinate.
  [[nodiscard]] static bool goOn(const PosedStep& step, double horizon, std::size_t most,
                                 std::vector<double>& seconds, std::vector<Pose>& ends);
  /// The pose at t in [0,1]; the given ones, bit for bit, at both ends. `pose` is resized. At a
  /// constant rate only for the ends: ChainMotion has the others.
  void poseAt(double t, Pose& pose) const;
  /// Poses these joints (a flag per joint; none: all); in between, others stay as the step begins.
  void poseAt(double t, const std::vector<std::uint8_t>& isMoved, Pose& pose) const;
  /// For the piece [begin, end] of the step, with the joint's constant rate between poseAt(begin)
  /// and poseAt(end). Infinite: the piece is too long to say.
  [[nodiscard]] JointStray strayOf(JointId joint, double begin, double end) const;

 private:
  /// w(t) = (t^3 - 2t^2 + t) slope0 + (3t^2 - 2t^3) change + (t^3 - t^2) slope1.
  struct Curve {
    Eigen::Vector3d slope0, change, slope1;
    [[nodiscard]] Eigen::Vector3d at(double t) const;
    [[nodiscard]] double bendIn(double begin, double end) const;
  };
  struct JointCurves {
    Curve turn, shift;
  };
  [[nodiscard]] double shiftRounding(JointId joint) const;
  [[nodiscard]] static JointCurves curvesOf(const PosedStep& step, MotionModel model,
                                            std::size_t joint);

  std::vector<JointCurves> joints_;
  const Pose *from_ = nullptr, *to_ = nullptr;
  bool isConstantRate_ = true;
};

}  // namespace foretouch
