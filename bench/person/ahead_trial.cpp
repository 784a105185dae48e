#include "bench/person/ahead_trial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "bench/machine.h"
#include "lss/index.h"
#include "middleware/bracket/bracket_query.h"

namespace foretouch::tools {
namespace {

using Axes = std::vector<HeldBack::Axis>;
constexpr std::size_t kWays = 3;
/// Of capsules: instants per horizon. What is found is told at the instant before it.
constexpr int kGrid = 120;

/// err <= speed tau + acceleration tau^2/2 for all that was seen.
struct AheadBound {
  double speed = 0.0, acceleration = 0.0;
  [[nodiscard]] double at(double tau) const { return tau * (speed + 0.5 * acceleration * tau); }
};

class AheadRun {
 public:
  AheadRun(const SolidStage& stage, const SolidActor& actor, const Placement& place,
           const AheadTrial& trial)
      : person_(stage, actor, place, asPersonTrial(trial)),
        avatar_(actor.avatar),
        frameS_(actor.clip.frameTimeS),
        frames_(static_cast<int>(std::floor(trial.horizonS / frameS_))),
        horizonS_(frames_ * frameS_),
        query_(BracketQuery::build(actor.avatar, stage.scene, {}).value()),
        tallies_(kWays) {
    for (const HeldBackStep& step : person_.steps()) {
      if (step.to + static_cast<std::size_t>(frames_) < person_.frames().size()) {
        steps_.push_back(step);
      }
    }
  }

  std::vector<AheadTally> run() {
    if (frames_ < 2) return tallies_;
    for (auto& bounds : bounds_) bounds.assign(person_.held().numLinks(), {});
    // The speeds from the first instant, and then what more is needed.
    for (const bool isFirst : {true, false}) {
      for (const HeldBackStep& step : steps_) learn(step, isFirst);
    }
    for (const HeldBackStep& step : steps_) judgeStep(step);
    return std::move(tallies_);
  }

 private:
  static PersonTrial asPersonTrial(const AheadTrial& trial) {
    PersonTrial person;
    person.rateHz = trial.rateHz;
    person.model = MotionModel::ConstantRate;
    return person;
  }

  /// Where the person is `frame` frames after a step, which may be between two.
  [[nodiscard]] const Axes& truthAt(const HeldBackStep& step, double frame) {
    const HeldBackStep after{step.to, step.to + static_cast<std::size_t>(frames_), 0, 0};
    return person_.held().truthAt(after, frame / frames_);
  }
  /// Where a way has the axes then.
  [[nodiscard]] Axes placedBy(AheadWay way, const HeldBackStep& step, double tau) {
    if (way == AheadWay::Chain) return person_.held().aheadAt(step, tau / person_.stepS());
    Axes now = person_.held().posedAt(step.to);
    if (way == AheadWay::WiderCapsule) return now;
    const Axes& before = person_.held().posedAt(step.from);
    for (std::size_t c = 0; c < now.size(); ++c) {
      for (std::size_t end = 0; end < 2; ++end) {
        now[c][end] = now[c][end] + (tau / person_.stepS()) * (now[c][end] - before[c][end]);
      }
    }
    return now;
  }

  void learn(const HeldBackStep& step, bool isFirst) {
    const int last = isFirst ? 1 : frames_;
    for (int frame = 1; frame <= last; ++frame) {
      const double tau = frame * frameS_;
      const Axes truth = truthAt(step, frame);
      for (std::size_t way = 0; way < kWays; ++way) {
        const Axes model = placedBy(static_cast<AheadWay>(way), step, tau);
        for (std::size_t c = 0; c < truth.size(); ++c) {
          AheadBound& bound = bounds_[way][slotOf(person_.held().linkOf()[c])];
          for (std::size_t end = 0; end < 2; ++end) {
            const double error = kBetween * oracle::norm(truth[c][end] - model[c][end]) + kBetweenM;
            if (isFirst) {
              bound.speed = std::max(bound.speed, error / tau);
            } else {
              bound.acceleration =
                  std::max(bound.acceleration, 2.0 * (error - bound.speed * tau) / (tau * tau));
            }
          }
        }
      }
    }
  }

  /// When links first touch (s), of those that do within the horizon.
  void findTruth(const HeldBackStep& step) {
    truth_.assign(person_.held().numLinks(), std::nullopt);
    constexpr int kPerFrame = 3;
    for (int i = 0; i <= kPerFrame * frames_; ++i) {
      const double frame = static_cast<double>(i) / kPerFrame;
      const Axes axes = truthAt(step, frame);
      for (std::size_t link = 0; link < truth_.size(); ++link) {
        if (truth_[link] || avatar_.lss(static_cast<LinkId>(link)).empty()) continue;
        const double apart = person_.held().fromScene(axes, static_cast<int>(link), 1e-3);
        if (apart < -kJudgeRounding) truth_[link] = frame * frameS_;
      }
    }
  }

  /// When a touch is possible first (s).
  [[nodiscard]] std::vector<std::optional<double>> byChain(const HeldBackStep& step) {
    std::vector<LinkBound> bounds(person_.held().numLinks());
    for (std::size_t link = 0; link < bounds.size(); ++link) {
      bounds[link].aheadSpeed = bounds_[0][link].speed;
      bounds[link].aheadAcceleration = bounds_[0][link].acceleration;
    }
    const double begin = threadTimeUs();
    (void)query_.lookAhead(person_.posed(step), horizonS_, bounds, scratch_, brackets_);
    tallies_[0].us += threadTimeUs() - begin;
    ++tallies_[0].poses;
    std::vector<std::optional<double>> told(bounds.size());
    for (const LinkBracket& bracket : brackets_.links) {
      if (bracket.verdict == BracketVerdict::Unclaimed) told[slotOf(bracket.link)] = 0.0;
      if (bracket.verdict != BracketVerdict::Possible) continue;
      told[slotOf(bracket.link)] = bracket.possibleFrom * horizonS_;
    }
    return told;
  }

  [[nodiscard]] std::vector<std::optional<double>> byCapsules(AheadWay way,
                                                              const HeldBackStep& step) {
    const auto& bounds = bounds_[static_cast<std::size_t>(way)];
    std::vector<std::optional<double>> told(bounds.size());
    for (int i = 1; i <= kGrid; ++i) {
      const double tau = horizonS_ * i / kGrid;
      const Axes axes = placedBy(way, step, tau);
      for (std::size_t link = 0; link < bounds.size(); ++link) {
        if (told[link] || avatar_.lss(static_cast<LinkId>(link)).empty()) continue;
        const double growth = bounds[link].at(tau);
        if (person_.held().fromScene(axes, static_cast<int>(link), growth + 1e-3) <= growth) {
          told[link] = horizonS_ * (i - 1) / kGrid;
        }
      }
    }
    return told;
  }

  void judgeStep(const HeldBackStep& step) {
    findTruth(step);
    count(tallies_[0], byChain(step));
    for (const AheadWay way : {AheadWay::Capsule, AheadWay::WiderCapsule}) {
      count(tallies_[static_cast<std::size_t>(way)], byCapsules(way, step));
    }
  }

  void count(AheadTally& tally, const std::vector<std::optional<double>>& told) const {
    for (std::size_t link = 0; link < told.size(); ++link) {
      const bool touchesNow = truth_[link] && *truth_[link] == 0.0;
      if (touchesNow || avatar_.lss(static_cast<LinkId>(link)).empty()) continue;
      ++tally.asked;
      if (!truth_[link]) {
        if (told[link]) ++tally.alarms;
        continue;
      }
      ++tally.touched;
      if (!told[link] || *told[link] > *truth_[link]) {
        ++tally.late;
      } else {
        tally.earlyMs.push_back(1e3 * (*truth_[link] - *told[link]));
      }
    }
  }

  BoundedPerson person_;
  const Avatar& avatar_;
  double frameS_;
  int frames_;  // of the horizon
  double horizonS_;
  BracketQuery query_;
  std::vector<HeldBackStep> steps_;                    // after which the whole horizon is known
  std::array<std::vector<AheadBound>, kWays> bounds_;  // per way and link
  std::vector<std::optional<double>> truth_;           // of the step at hand
  Scratch scratch_;
  StepBrackets brackets_;
  std::vector<AheadTally> tallies_;
};

}  // namespace

const char* toString(AheadWay way) {
  switch (way) {
    case AheadWay::Chain: return "Foretouch";
    case AheadWay::Capsule: return "capsules, acceleration";
    case AheadWay::WiderCapsule: return "capsules, speed";
  }
  return "Foretouch";
}

void AheadTally::add(const AheadTally& other) {
  asked += other.asked;
  touched += other.touched;
  late += other.late;
  alarms += other.alarms;
  poses += other.poses;
  us += other.us;
  earlyMs.insert(earlyMs.end(), other.earlyMs.begin(), other.earlyMs.end());
}

std::vector<AheadTally> judgeAhead(const SolidStage& stage, const SolidActor& actor,
                                   const Placement& place, const AheadTrial& trial) {
  return AheadRun(stage, actor, place, trial).run();
}

}  // namespace foretouch::tools
