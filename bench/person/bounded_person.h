// bench/person/bounded_person.h: a person whose poses are held back, as the library is asked about
// them: the given poses, and bounds on how far the person is from the model that hold on the clip.
#pragma once

#include <cstddef>
#include <vector>

#include "articulated/motion_model.h"
#include "bench/person/held_back.h"
#include "bench/solid/stage.h"
#include "middleware/bracket/bracket.h"

namespace foretouch::tools {

struct PersonTrial {
  double rateHz = 30.0;  ///< Of the given poses: every n-th frame, the nearest n >= 1.
  MotionModel model = MotionModel::CubicLate;
  bool isFollowed = true;  ///< Bounds follow how the poses bend, too.
  bool asksOwnLinks = false;
  double boundShare = 1.0;             ///< Of the bounds that hold: below 1 for planted faults.
  int instants = 4;                    ///< Instants to look at per frame of the clip.
  std::vector<LinkBound> bounds = {};  ///< One per link; empty: those that hold on the clip.
  double poseErrorM = 0.0;             ///< Given poses are off by so much, each another way.
  bool claimsPoseError = true;         ///< False is a planted fault, and so is the next.
  bool hasWrongSlopes = false;  ///< Poses around the step have each joint's turn at the next.
};

/// For one thread.
class BoundedPerson {
 public:
  /// All must outlive it.
  BoundedPerson(const SolidStage& stage, const SolidActor& actor, const Placement& place,
                const PersonTrial& trial);

  [[nodiscard]] HeldBack& held() { return held_; }
  [[nodiscard]] const std::vector<Pose>& frames() const { return frames_; }
  [[nodiscard]] std::vector<HeldBackStep> steps() const { return held_.steps(every_); }
  [[nodiscard]] double stepS() const { return seconds_; }
  /// When a step begins (s).
  [[nodiscard]] double beginOf(const HeldBackStep& step) const {
    return static_cast<double>(step.from) * seconds_ / static_cast<double>(every_);
  }
  [[nodiscard]] const std::vector<LinkBound>& bounds() const { return bounds_; }
  /// The largest distance from the model that the bounds allow in a step, beside the error of poses
  /// (m), per link.
  void growths(const HeldBackStep& step, std::vector<double>& most);
  [[nodiscard]] PosedStep posed(const HeldBackStep& step) const;
  /// Instants of a step at which the judge looks, less one.
  [[nodiscard]] int looks() const { return trial_.instants * static_cast<int>(every_); }

 private:
  void distances(const HeldBackStep& step, double u, std::vector<double>& distances);
  void bendsOf(const HeldBackStep& step, std::vector<double>& bends);
  [[nodiscard]] std::vector<LinkBound> learn();
  void giveFrames();

  const PersonTrial& trial_;
  std::vector<Pose> frames_, given_, around_;  // as they truly were, and as the library has them
  std::size_t every_;
  double seconds_;
  HeldBack held_;
  std::vector<LinkBound> bounds_;
};

}  // namespace foretouch::tools
