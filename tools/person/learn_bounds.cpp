#include "tools/person/learn_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "articulated/motion.h"
#include "lss/index.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

/// What every followed bound allows (m): below it a share of nothing would be infinite.
constexpr double kFollowFloor = 3e-4;
/// Beyond the last pose, in steps, up to which "ahead" is learned.
constexpr std::size_t kAheadSteps = 4;

/// The ends of all axes of all links at a pose.
using AxisEndsOfPose = std::vector<std::array<Vector3d, 2>>;

class Places {
 public:
  explicit Places(const Avatar& avatar) : avatar_(avatar) {
    for (LinkId link = 0; link < avatar.numLinks(); ++link) {
      linkOf_.insert(linkOf_.end(), avatar.lss(link).size(), link);
    }
  }
  [[nodiscard]] const std::vector<LinkId>& linkOf() const { return linkOf_; }
  void at(const Pose& pose, AxisEndsOfPose& ends) {
    motion_.assign(avatar_.skeleton(), pose, pose);
    motion_.statesAt(0.0, states_);
    ends.clear();
    for (LinkId link = 0; link < avatar_.numLinks(); ++link) {
      const LinkState& state = states_[slotOf(link)];
      for (const Lss& lss : avatar_.lss(link)) {
        ends.push_back({state.pointAt(lss.a), state.pointAt(lss.b)});
      }
    }
  }
  /// The most that two poses differ, per link.
  void differences(const AxisEndsOfPose& one, const AxisEndsOfPose& other,
                   std::vector<double>& most) const {
    most.assign(countOf(avatar_.numLinks()), 0.0);
    for (std::size_t i = 0; i < one.size(); ++i) {
      for (std::size_t end = 0; end < 2; ++end) {
        double& own = most[slotOf(linkOf_[i])];
        own = std::max(own, (one[i][end] - other[i][end]).norm());
      }
    }
  }

 private:
  const Avatar& avatar_;
  std::vector<LinkId> linkOf_;
  ChainMotion motion_;
  std::vector<LinkState> states_;
};

/// |x0 - 2 x1 + x2| of the ends, the largest per link.
void addBends(const AxisEndsOfPose& x0, const AxisEndsOfPose& x1, const AxisEndsOfPose& x2,
              const std::vector<LinkId>& linkOf, double share,
              std::vector<std::vector<double>>& bends) {
  for (std::size_t i = 0; i < x1.size(); ++i) {
    for (std::size_t end = 0; end < 2; ++end) {
      const double bend = (x0[i][end] - 2.0 * x1[i][end] + x2[i][end]).norm();
      bends[slotOf(linkOf[i])][2 * i + end] += share * bend;
    }
  }
}

double quantileOf(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const auto place = static_cast<std::size_t>(
      std::ceil(share * static_cast<double>(values.size())));
  return values[std::min(values.size() - 1, place == 0 ? 0 : place - 1)];
}

/// Two claims of which the lesser counts: each at half of what may fail, so that both together hold.
double eachOfTwo(double quantile) {
  return 1.0 - 0.5 * (1.0 - quantile);
}

}  // namespace

BoundsLearner::Seen& BoundsLearner::seenOf(const std::string& part, MotionModel model,
                                           double rateHz) {
  for (Seen& seen : seen_) {
    if (seen.part == part && seen.model == model && seen.rateHz == rateHz) return seen;
  }
  seen_.push_back({part, model, rateHz, {}, {}, {}, {}});
  return seen_.back();
}

int BoundsLearner::learn(const Clip& clip, const Avatar& avatar) {
  int served = 0;
  for (const double rateHz : request_.ratesHz) {
    const auto every =
        static_cast<std::size_t>(std::max(1.0, std::round(1.0 / (rateHz * clip.frameTimeS))));
    if (every < 2 || clip.frames.size() <= every) continue;
    ++served;
    for (const MotionModel model : request_.models) learnAt(clip, avatar, model, rateHz, every);
  }
  return served;
}

void BoundsLearner::learnAt(const Clip& clip, const Avatar& avatar, MotionModel model,
                            double rateHz, std::size_t every) {
  const Skeleton& skeleton = avatar.skeleton();
  const std::vector<Pose>& frames = clip.frames;
  const double seconds = static_cast<double>(every) * clip.frameTimeS;
  const std::vector<std::string> parts = boundParts(skeleton);
  Places places(avatar);
  ModelMotion motion;
  AxisEndsOfPose truth, modelled, before, from, to, after;
  std::vector<double> own, most(countOf(skeleton.numJoints()));
  Pose pose;
  for (std::size_t first = 0; first + every < frames.size(); first += every) {
    const std::size_t last = first + every;
    PosedStep step{first >= every ? &frames[first - every] : nullptr, &frames[first], &frames[last],
                   last + every < frames.size() ? &frames[last + every] : nullptr, seconds, seconds,
                   seconds};
    if (model != MotionModel::CubicLate) step.after = nullptr;
    motion.assign(skeleton, step, model);
    const ChainMotion constant(skeleton, *step.from, *step.to);
    std::fill(most.begin(), most.end(), 0.0);
    std::vector<double> speeds(most.size(), 0.0);
    places.at(*step.from, before);
    for (std::size_t frame = first + 1; frame <= last; ++frame) {
      places.at(frames[frame], truth);
      places.differences(before, truth, own);
      for (std::size_t i = 0; i < own.size(); ++i) {
        speeds[i] = std::max(speeds[i], own[i] / clip.frameTimeS);
      }
      std::swap(before, truth);
      if (frame == last) break;
      const double u = static_cast<double>(frame - first) / static_cast<double>(every);
      motion.isConstantRate() ? constant.poseAt(u, pose) : motion.poseAt(u, pose);
      places.at(pose, modelled);
      places.differences(before, modelled, own);
      for (std::size_t i = 0; i < own.size(); ++i) {
        const double beyond = std::max(0.0, own[i] - request_.errorM);
        most[i] = std::max(most[i], beyond / (4.0 * u * (1.0 - u)));
      }
    }
    // How much the given poses bend around the step, as the bracket measures it.
    std::vector<double> bends(most.size(), 0.0);
    const int known = (step.before != nullptr ? 1 : 0) + (step.after != nullptr ? 1 : 0);
    if (known > 0) {
      places.at(*step.from, from);
      places.at(*step.to, to);
      if (step.before != nullptr) places.at(*step.before, before);
      if (step.after != nullptr) places.at(*step.after, after);
      for (std::size_t i = 0; i < from.size(); ++i) {
        for (std::size_t end = 0; end < 2; ++end) {
          double bend = 0.0;
          if (step.before != nullptr) {
            bend += (before[i][end] - 2.0 * from[i][end] + to[i][end]).norm();
          }
          if (step.after != nullptr) {
            bend += (from[i][end] - 2.0 * to[i][end] + after[i][end]).norm();
          }
          double& widest = bends[slotOf(places.linkOf()[i])];
          widest = std::max(widest, bend / known);
        }
      }
    }
    // What came after it, had the step gone on.
    std::vector<double> ahead(most.size(), 0.0);
    const double horizon = static_cast<double>(kAheadSteps) * seconds;
    std::vector<Pose> ends;
    for (std::size_t frame = last + 1; frame < std::min(frames.size(), last + kAheadSteps * every + 1);
         ++frame) {
      const double tau = static_cast<double>(frame - last) * clip.frameTimeS;
      if (!ModelMotion::goOn(step, std::min(tau, horizon), countOf(32), ends)) break;
      places.at(ends.back(), modelled);
      places.at(frames[frame], truth);
      places.differences(truth, modelled, own);
      for (std::size_t i = 0; i < own.size(); ++i) {
        const double beyond = std::max(0.0, own[i] - request_.errorM);
        ahead[i] = std::max(ahead[i], beyond / (0.5 * tau * (seconds + tau)));
      }
    }
    for (LinkId link = 0; link < skeleton.numJoints(); ++link) {
      const auto i = slotOf(link);
      if (avatar.lss(link).empty()) continue;
      const std::string name = request_.isByLink ? skeleton.name(link)
                               : parts[i].empty() ? "all"
                                                  : parts[i];
      Seen& seen = seenOf(name, model, rateHz);
      seen.accelerations.push_back(8.0 * most[i] / (seconds * seconds));
      seen.gapSpeeds.push_back(speeds[i]);
      seen.aheadAccelerations.push_back(ahead[i]);
      if (bends[i] > 0.0) {
        seen.shares.push_back(std::max(0.0, most[i] - kFollowFloor) / bends[i]);
      }
    }
  }
}

BoundsFile BoundsLearner::bounds() const {
  BoundsFile file;
  const double each = eachOfTwo(request_.quantile);
  for (const Seen& seen : seen_) {
    BoundEntry entry;
    (request_.isByLink ? entry.link : entry.part) = seen.part;
    entry.model = seen.model;
    entry.rateHz = seen.rateHz;
    entry.bound.error = request_.errorM;
    entry.bound.acceleration = quantileOf(seen.accelerations, each);
    if (!seen.shares.empty()) {
      entry.bound.followFloor = kFollowFloor;
      entry.bound.followShare = quantileOf(seen.shares, each);
    }
    entry.bound.speed = quantileOf(seen.gapSpeeds, request_.quantile);
    // Rates of the last step lag by half a step.
    entry.bound.aheadAcceleration = quantileOf(seen.aheadAccelerations, request_.quantile);
    entry.bound.aheadSpeed = 0.5 * entry.bound.aheadAcceleration / seen.rateHz;
    entry.quantile = request_.quantile;
    entry.count = static_cast<std::int64_t>(seen.accelerations.size());
    file.entries.push_back(std::move(entry));
  }
  return file;
}

}  // namespace foretouch::tools
