// tools/person/learn_bounds.h: bounds on how far persons are from a model, learned from clips at
// their full rate: every n-th pose is given, the others say where the person truly was.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/clip.h"
#include "articulated/motion_model.h"
#include "articulated/result.h"
#include "assets/bounds/bounds_file.h"

namespace foretouch::tools {

struct LearnRequest {
  std::vector<MotionModel> models{MotionModel::CubicLate};
  std::vector<double> ratesHz{30.0};  ///< Of the given poses; the nearest whole number of frames.
  double quantile = 0.999;            ///< The share of steps, in (0,1].
  double errorM = 0.0;                ///< How far the tracker is off in a pose.
  bool isByLink = false;              ///< By name, for clips of one skeleton; else by part.
};

/// Takes clips one after the other, then gives the file. For one thread.
class BoundsLearner {
 public:
  explicit BoundsLearner(const LearnRequest& request) : request_(request) {}

  /// How many of the rates the clip serves: it must have two frames or more per given pose.
  int learn(const Clip& clip, const Avatar& avatar);
  /// One entry per part (or link), model and rate.
  [[nodiscard]] BoundsFile bounds() const;

  /// For one part, model and rate: what each link needed in each step.
  struct Seen {
    std::string part;
    MotionModel model = MotionModel::CubicLate;
    double rateHz = 0.0;
    std::vector<double> accelerations, shares, gapSpeeds, aheadAccelerations;
  };

 private:
  [[nodiscard]] Seen& seenOf(const std::string& part, MotionModel model, double rateHz);

  LearnRequest request_;
  std::vector<Seen> seen_;
};

}  // namespace foretouch::tools
