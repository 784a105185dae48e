#include "bench/solid/rest_trial.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "articulated/try.h"
#include "bench/solid/figure.h"
#include "middleware/solid/solid_avatar.h"
#include "tools/portable_random.h"

namespace foretouch::tools {
namespace {

constexpr double kNoiseRad = 1e-3, kNoiseM = 5e-4;
constexpr int kRestTicks = 270, kTicksToRest = 30;

using Ends = std::vector<std::array<oracle::Vec3d, 2>>;

/// Squared accelerations per end of an LSS.
class Trembling {
 public:
  void look(const Ends& ends) {
    if (before_.size() == 2) {
      sum_.resize(2 * ends.size(), 0.0);
      for (std::size_t c = 0; c < ends.size(); ++c) {
        for (std::size_t end = 0; end < 2; ++end) {
          const oracle::Vec3d step = ends[c][end] - before_[1][c][end];
          const oracle::Vec3d last = before_[1][c][end] - before_[0][c][end];
          const double a = norm(step - last);
          sum_[2 * c + end] += a * a;
        }
      }
      before_.erase(before_.begin());
    }
    before_.push_back(ends);
  }
  [[nodiscard]] const std::vector<double>& sums() const { return sum_; }
  [[nodiscard]] double sum() const {
    double all = 0.0;
    for (const double s : sum_) all += s;
    return all;
  }

 private:
  std::vector<Ends> before_;
  std::vector<double> sum_;
};

class RestTrial {
 public:
  RestTrial(const SolidStage& stage, const SolidActor& actor, SolidAvatar solid)
      : judge_(stage.judged, plainBody(actor.avatar)),
        audit_(stage.judged, actor.avatar),
        solid_(std::move(solid)) {
    audit_.begin(actor.name + " rests in " + stage.name);
  }

  Result<RestTally> run(const std::vector<Pose>& tracked) {
    std::vector<std::size_t> inside;
    for (std::size_t i = 0; i < tracked.size(); ++i) {
      if (judge_.at(plainPose(tracked[i]), 0.0).link >= 0) inside.push_back(i);
    }
    if (inside.empty()) return RestTally{};
    const std::size_t last = inside[inside.size() / 2];
    for (std::size_t i = 0; i <= last; ++i) FORETOUCH_CHECK(follow(tracked[i]));
    FORETOUCH_CHECK(stay(tracked[last]));
    FORETOUCH_CHECK(tremble(tracked[last]));
    tally_.way = audit_.tally();
    return std::move(tally_);
  }

 private:
  Result<Done> follow(const Pose& target) {
    FORETOUCH_CHECK(solid_.follow({target, 1.0 / kTrialRateHz, nullptr}, tick_));
    audit_.look(tick_);
    return Done{};
  }

  Result<Done> stay(const Pose& target) {
    double most = 0.0;
    int lastMove = 0, free = 0;
    double lift = tick_.lift;
    Ends before = judge_.endsAt(plainPose(tick_.shown));
    for (int i = 0; i < kRestTicks; ++i) {
      FORETOUCH_CHECK(follow(target));
      const Ends& now = judge_.endsAt(plainPose(tick_.shown));
      const double step = largestStep(before, now);
      if (step > 0.0) lastMove = i + 1;
      free = tick_.limit == SolidLimit::None && tick_.lift == lift ? free + 1 : 0;
      lift = tick_.lift;
      if (free > kTicksToRest) {
        most = std::max(most, step);
        tally_.queries += tick_.counters.queries;
        ++tally_.ticks;
      }
      before = now;
    }
    tally_.stillStep.push_back(most);
    tally_.ticksToRest.push_back(lastMove);
    return Done{};
  }

  static double largestStep(const Ends& from, const Ends& to) {
    double most = 0.0;
    for (std::size_t c = 0; c < to.size(); ++c) {
      for (std::size_t end = 0; end < 2; ++end) {
        most = std::max(most, norm(to[c][end] - from[c][end]));
      }
    }
    return most;
  }

  Result<Done> tremble(const Pose& target) {
    PortableRandom random(1);
    Trembling shown, wanted;
    for (int i = 0; i < kRestTicks; ++i) {
      Pose noisy = target;
      for (Quaternion& q : noisy.rotations) {
        const Eigen::Vector3d half = 0.5 * random.inBox(kNoiseRad);
        q = (q * Quaternion(1.0, half.x(), half.y(), half.z())).normalized();
      }
      noisy.translations.front() += random.inBox(kNoiseM);
      FORETOUCH_CHECK(follow(noisy));
      shown.look(judge_.endsAt(plainPose(tick_.shown)));
      wanted.look(judge_.endsAt(plainPose(noisy)));
    }
    double worst = 0.0;
    for (std::size_t i = 0; i < shown.sums().size(); ++i) {
      worst = std::max(worst, std::sqrt(shown.sums()[i] / wanted.sums()[i]));
    }
    tally_.noise.push_back(std::sqrt(shown.sum() / wanted.sum()));
    tally_.worstEnd.push_back(worst);
    return Done{};
  }

  oracle::WayJudge judge_;
  WayAudit audit_;
  SolidAvatar solid_;
  SolidTick tick_;
  RestTally tally_;
};

}  // namespace

void RestTally::add(const RestTally& other) {
  stillStep.insert(stillStep.end(), other.stillStep.begin(), other.stillStep.end());
  ticksToRest.insert(ticksToRest.end(), other.ticksToRest.begin(), other.ticksToRest.end());
  noise.insert(noise.end(), other.noise.begin(), other.noise.end());
  worstEnd.insert(worstEnd.end(), other.worstEnd.begin(), other.worstEnd.end());
  queries += other.queries;
  ticks += other.ticks;
  way.add(other.way);
}

Result<RestTally> tryRest(const SolidStage& stage, const SolidActor& actor,
                          const std::vector<Pose>& tracked, const SolidOptions& options) {
  FORETOUCH_TRY(auto solid, SolidAvatar::build(actor.avatar, stage.scene, options));
  return RestTrial(stage, actor, std::move(solid)).run(tracked);
}

}  // namespace foretouch::tools
