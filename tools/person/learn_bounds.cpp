#include "tools/person/learn_bounds.h"

#include <algorithm>
#include <cmath>

#include "lss/index.h"
#include "middleware/bracket/axis_places.h"
#include "tools/percentile.h"

namespace foretouch::tools {
namespace {

/// What every followed bound allows (m): below it a share of nothing would be infinite.
constexpr double kFollowFloor = 5e-5;
/// Steps beyond the last pose up to which "ahead" is learned.
constexpr std::size_t kAheadSteps = 4, kMostAheadPieces = 32;

/// One clip with every n-th pose given, by one model: what each link needs in a step.
class HeldBackClip {
 public:
  HeldBackClip(const Clip& clip, const Avatar& avatar, MotionModel model, std::size_t every,
               double errorM)
      : frames_(clip.frames),
        skeleton_(avatar.skeleton()),
        placer_(avatar),
        model_(model),
        every_(every),
        frameTimeS_(clip.frameTimeS),
        seconds_(static_cast<double>(every) * clip.frameTimeS),
        errorM_(errorM) {}

  [[nodiscard]] double seconds() const { return seconds_; }

  /// False: there is no such step.
  bool begin(std::size_t first) {
    if (first + every_ >= frames_.size()) return false;
    first_ = first;
    last_ = first + every_;
    const bool isLate = model_ == MotionModel::CubicLate && last_ + every_ < frames_.size();
    step_ = {first >= every_ ? &frames_[first - every_] : nullptr,
             &frames_[first],
             &frames_[last_],
             isLate ? &frames_[last_ + every_] : nullptr,
             seconds_,
             seconds_,
             seconds_};
    return true;
  }

  /// How far the person was from the model, as the height of the parabola that holds it (m).
  void strays(std::vector<double>& most) {
    motion_.assign(skeleton_, step_, model_);
    const ChainMotion constant(skeleton_, *step_.from, *step_.to);
    most.assign(countOf(skeleton_.numJoints()), 0.0);
    for (std::size_t frame = first_ + 1; frame < last_; ++frame) {
      const double u = static_cast<double>(frame - first_) / static_cast<double>(every_);
      motion_.isConstantRate() ? constant.poseAt(u, pose_) : motion_.poseAt(u, pose_);
      raise(frame, 4.0 * u * (1.0 - u), most);
    }
  }

  /// How fast the person was at most (m/s).
  void speeds(std::vector<double>& most) {
    most.assign(countOf(skeleton_.numJoints()), 0.0);
    for (std::size_t frame = first_; frame < last_; ++frame) {
      placer_.place(frames_[frame], one_);
      placer_.place(frames_[frame + 1], other_);
      placer_.differences(one_, other_, own_);
      for (std::size_t i = 0; i < own_.size(); ++i)
        most[i] = std::max(most[i], own_[i] / frameTimeS_);
    }
  }

  /// How much the given poses bend around the step (m).
  void bends(std::vector<double>& most) {
    AxisPlaces before, from, to, after;
    placer_.place(*step_.from, from);
    placer_.place(*step_.to, to);
    std::vector<AxisPlacer::Bend> given;
    if (step_.before != nullptr) {
      placer_.place(*step_.before, before);
      given.push_back({&before, &from, &to});
    }
    if (step_.after != nullptr) {
      placer_.place(*step_.after, after);
      given.push_back({&from, &to, &after});
    }
    placer_.bends(given, most);
  }

  /// The acceleration that holds what came after the step, had it gone on (m/s^2): the rate of the
  /// step lags by half of it.
  void ahead(std::vector<double>& most) {
    most.assign(countOf(skeleton_.numJoints()), 0.0);
    const std::size_t end = std::min(frames_.size(), last_ + kAheadSteps * every_ + 1);
    for (std::size_t frame = last_ + 1; frame < end; ++frame) {
      const double tau = static_cast<double>(frame - last_) * frameTimeS_;
      if (!ModelMotion::goOn(step_, tau, kMostAheadPieces, endsS_, ends_)) return;
      std::swap(pose_, ends_.back());
      raise(frame, 0.5 * tau * (seconds_ + tau), most);
    }
  }

 private:
  /// Raises by where the person was at a frame and where pose_ has them.
  void raise(std::size_t frame, double share, std::vector<double>& most) {
    placer_.place(frames_[frame], one_);
    placer_.place(pose_, other_);
    placer_.differences(one_, other_, own_);
    for (std::size_t i = 0; i < own_.size(); ++i) {
      most[i] = std::max(most[i], std::max(0.0, own_[i] - errorM_) / share);
    }
  }

  const std::vector<Pose>& frames_;
  const Skeleton& skeleton_;
  AxisPlacer placer_;
  MotionModel model_;
  std::size_t every_, first_ = 0, last_ = 0;
  double frameTimeS_, seconds_, errorM_;
  PosedStep step_;
  ModelMotion motion_;
  Pose pose_;
  std::vector<Pose> ends_;
  std::vector<double> endsS_;
  AxisPlaces one_, other_;
  std::vector<double> own_;
};

/// Poses that were not recorded teach nothing.
bool hasGapIn(const Clip& clip, std::int64_t first, std::int64_t last) {
  return std::any_of(clip.gaps.begin(), clip.gaps.end(),
                     [&](const ClipGap& gap) { return gap.first <= last && gap.last >= first; });
}

void addStep(const std::vector<BoundsLearner::Seen*>& seenOfLink, HeldBackClip& clip) {
  std::vector<double> strays, speeds, bends, ahead;
  clip.strays(strays);
  clip.speeds(speeds);
  clip.bends(bends);
  clip.ahead(ahead);
  for (std::size_t i = 0; i < seenOfLink.size(); ++i) {
    if (seenOfLink[i] == nullptr) continue;
    BoundsLearner::Seen& seen = *seenOfLink[i];
    seen.accelerations.push_back(8.0 * strays[i] / (clip.seconds() * clip.seconds()));
    seen.gapSpeeds.push_back(speeds[i]);
    seen.aheadAccelerations.push_back(ahead[i]);
    if (bends[i] > 0.0) {
      seen.shares.push_back(std::max(0.0, strays[i] - kFollowFloor) / bends[i]);
    }
  }
}

BoundEntry entryOf(BoundsLearner::Seen seen, const LearnRequest& request) {
  // Two claims of which the lesser counts: each at half of what may fail, so that both hold.
  const double each = 1.0 - 0.5 * (1.0 - request.quantile);
  BoundEntry entry;
  (request.isByLink ? entry.link : entry.part) = seen.part;
  entry.model = seen.model;
  entry.rateHz = seen.rateHz;
  entry.bound.error = request.errorM;
  entry.bound.acceleration = percentile(seen.accelerations, each);
  if (!seen.shares.empty()) {
    entry.bound.followFloor = kFollowFloor;
    entry.bound.followShare = percentile(seen.shares, each);
  }
  entry.bound.speed = percentile(seen.gapSpeeds, request.quantile);
  entry.bound.aheadAcceleration = percentile(seen.aheadAccelerations, request.quantile);
  entry.bound.aheadSpeed = 0.5 * entry.bound.aheadAcceleration / seen.rateHz;
  entry.quantile = request.quantile;
  entry.count = static_cast<std::int64_t>(seen.accelerations.size());
  return entry;
}

}  // namespace

BoundsLearner::Seen& BoundsLearner::seenOf(const std::string& part, MotionModel model,
                                           double rateHz) {
  for (Seen& seen : seen_) {
    if (seen.part == part && seen.model == model && seen.rateHz == rateHz) return seen;
  }
  Seen seen;
  seen.part = part;
  seen.model = model;
  seen.rateHz = rateHz;
  seen_.push_back(std::move(seen));
  return seen_.back();
}

int BoundsLearner::learn(const Clip& clip, const Avatar& avatar) {
  const std::vector<std::string> parts = boundParts(avatar.skeleton());
  int served = 0;
  for (const double rateHz : request_.ratesHz) {
    const auto every =
        static_cast<std::size_t>(std::max(1.0, std::round(1.0 / (rateHz * clip.frameTimeS))));
    if (every < 2 || clip.frames.size() <= every) continue;
    ++served;
    for (const MotionModel model : request_.models) {
      // Named first: adding one more moves those before.
      const auto nameOf = [&](LinkId link) -> std::string {
        if (request_.isByLink) return avatar.skeleton().name(link);
        return parts[slotOf(link)].empty() ? "all" : parts[slotOf(link)];
      };
      for (LinkId link = 0; link < avatar.numLinks(); ++link) {
        if (!avatar.lss(link).empty()) (void)seenOf(nameOf(link), model, rateHz);
      }
      std::vector<Seen*> seenOfLink;
      for (LinkId link = 0; link < avatar.numLinks(); ++link) {
        const bool hasLss = !avatar.lss(link).empty();
        seenOfLink.push_back(hasLss ? &seenOf(nameOf(link), model, rateHz) : nullptr);
      }
      HeldBackClip held(clip, avatar, model, every, request_.errorM);
      const auto step = static_cast<std::int64_t>(every);
      const auto ahead = step * static_cast<std::int64_t>(kAheadSteps);
      for (std::size_t first = 0; held.begin(first); first += every) {
        const auto frame = static_cast<std::int64_t>(first);
        if (!hasGapIn(clip, frame - step, frame + step + ahead)) addStep(seenOfLink, held);
      }
    }
  }
  return served;
}

BoundsFile BoundsLearner::bounds() const {
  BoundsFile file;
  for (const Seen& seen : seen_) file.entries.push_back(entryOf(seen, request_));
  return file;
}

}  // namespace foretouch::tools
