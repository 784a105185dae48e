#include "bench/person/person_trial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "bench/machine.h"
#include "bench/person/held_back.h"
#include "bench/solid/plain_body.h"
#include "lss/index.h"
#include "middleware/query/query.h"

namespace foretouch::tools {
namespace {

/// The judge rounds (m), and looks at some instants: bounds hold in between with this much more.
constexpr double kJudgeRounding = 1e-8, kBetween = 1.01, kBetweenM = 1e-6;
/// Bounds follow from here on (m).
constexpr double kFollowFloor = 5e-5;
constexpr std::size_t kMostFindings = 10;

class Trial {
 public:
  Trial(const SolidStage& stage, const SolidActor& actor, const Placement& place,
        const PersonTrial& trial)
      : trial_(trial),
        avatar_(actor.avatar),
        frames_(placedFrames(actor, place)),
        every_(static_cast<std::size_t>(
            std::max(1.0, std::round(1.0 / (trial.rateHz * actor.clip.frameTimeS))))),
        seconds_(static_cast<double>(every_) * actor.clip.frameTimeS),
        held_(stage.judged, plainBody(actor.avatar), plainOf(frames_)) {
    BracketOptions options;
    QueryOptions plain;
    if (trial.asksOwnLinks) {
      auto rules = PairRules::derive(avatar_);
      if (rules.ok()) {
        pairs_ = askedPairs(avatar_, rules.value());
        options.self = plain.self = std::move(rules).value();
      }
    }
    query_ = BracketQuery::build(avatar_, stage.scene, options).value();
    plain_ = Query::build(avatar_, stage.scene, plain).value();
    bounds_ = trial.bounds.empty() ? learn() : trial.bounds;
  }

  PersonTally run() {
    time();
    for (const HeldBackStep& step : held_.steps(every_)) judge(step);
    return std::move(tally_);
  }

 private:
  static std::vector<Pose> placedFrames(const SolidActor& actor, const Placement& place) {
    std::vector<Pose> frames;
    for (const Pose& frame : actor.clip.frames) {
      auto valid = validatedPose(actor.clip.skeleton, placed(actor.clip.skeleton, frame, place));
      if (!valid.ok()) break;
      frames.push_back(std::move(valid).value());
    }
    return frames;
  }
  static std::vector<oracle::PlainPose> plainOf(const std::vector<Pose>& frames) {
    std::vector<oracle::PlainPose> plain;
    for (const Pose& frame : frames) plain.push_back(plainPose(frame));
    return plain;
  }

  [[nodiscard]] int looks() const { return trial_.instants * static_cast<int>(every_); }

  /// The largest distance of each link's axes, person from model.
  void distances(const HeldBackStep& step, double u, std::vector<double>& distances) {
    const std::vector<HeldBack::Axis> truth = held_.truthAt(step, u);
    const auto& model = held_.modelAt(step, trial_.model, u);
    distances.assign(held_.numLinks(), 0.0);
    for (std::size_t c = 0; c < truth.size(); ++c) {
      double& most = distances[slotOf(held_.linkOf()[c])];
      for (std::size_t end = 0; end < 2; ++end) {
        most = std::max(most, oracle::norm(truth[c][end] - model[c][end]));
      }
    }
  }

  /// How much the given poses around a step bend, per link: the mean of what is known at its ends.
  void bendsOf(const HeldBackStep& step, std::vector<double>& bends) {
    const std::vector<HeldBack::Axis> before = held_.posedAt(step.before);
    const std::vector<HeldBack::Axis> from = held_.posedAt(step.from);
    const std::vector<HeldBack::Axis> to = held_.posedAt(step.to);
    const std::vector<HeldBack::Axis> after = held_.posedAt(step.after);
    const bool hasAfter = step.after != step.to && trial_.model == MotionModel::CubicLate;
    const int known = (step.before != step.from ? 1 : 0) + (hasAfter ? 1 : 0);
    bends.assign(held_.numLinks(), LinkBound::kNone);
    if (known == 0) return;
    std::fill(bends.begin(), bends.end(), 0.0);
    for (std::size_t c = 0; c < from.size(); ++c) {
      double& most = bends[slotOf(held_.linkOf()[c])];
      for (std::size_t e = 0; e < 2; ++e) {
        double sum = 0.0;
        if (step.before != step.from) {
          sum += oracle::norm((to[c][e] - from[c][e]) - (from[c][e] - before[c][e]));
        }
        if (hasAfter) {
          sum += oracle::norm((after[c][e] - to[c][e]) - (to[c][e] - from[c][e]));
        }
        most = std::max(most, sum / known);
      }
    }
  }

  /// The bounds that hold on this clip, per link.
  std::vector<LinkBound> learn() {
    std::vector<LinkBound> bounds(held_.numLinks());
    for (LinkBound& bound : bounds) bound.acceleration = bound.followShare = 0.0;
    std::vector<double> most, bends, own;
    for (const HeldBackStep& step : held_.steps(every_)) {
      bendsOf(step, bends);
      most.assign(held_.numLinks(), 0.0);
      for (int i = 1; i < looks(); ++i) {
        const double u = static_cast<double>(i) / looks();
        distances(step, u, own);
        for (std::size_t link = 0; link < own.size(); ++link) {
          most[link] = std::max(most[link], own[link] / (4.0 * u * (1.0 - u)));
        }
      }
      for (std::size_t link = 0; link < most.size(); ++link) {
        const double needed = kBetween * most[link] + kBetweenM;
        LinkBound& bound = bounds[link];
        bound.acceleration = std::max(bound.acceleration, 8.0 * needed / (seconds_ * seconds_));
        if (std::isfinite(bends[link]) && bends[link] > 0.0) {
          bound.followShare = std::max(bound.followShare, (needed - kFollowFloor) / bends[link]);
        }
      }
    }
    for (LinkBound& bound : bounds) {
      bound.acceleration *= trial_.boundShare;
      bound.followShare *= trial_.boundShare;
      if (trial_.isFollowed) bound.followFloor = kFollowFloor * trial_.boundShare;
    }
    return bounds;
  }

  [[nodiscard]] PosedStep posed(const HeldBackStep& step) const {
    const bool isLate = trial_.model == MotionModel::CubicLate;
    PosedStep posed;
    posed.before = step.before != step.from ? &frames_[step.before] : nullptr;
    posed.from = &frames_[step.from];
    posed.to = &frames_[step.to];
    posed.after = step.after != step.to && isLate ? &frames_[step.after] : nullptr;
    posed.secondsBefore = posed.seconds = posed.secondsAfter = seconds_;
    return posed;
  }

  void ask(const HeldBackStep& step) {
    (void)query_->answer(posed(step), trial_.model, bounds_, scratch_, brackets_);
  }

  void askPlainly(const HeldBackStep& step) {
    motion_.assign(avatar_.skeleton(), frames_[step.from], frames_[step.to]);
    plain_->answer(motion_, scratch_, contacts_);
  }

  /// All steps in order, twice; the second time counts.
  void time() {
    const std::vector<HeldBackStep> steps = held_.steps(every_);
    for (const bool counts : {false, true}) {
      double begin = threadTimeUs();
      for (const HeldBackStep& step : steps) ask(step);
      if (counts) tally_.bracketUs += threadTimeUs() - begin;
      begin = threadTimeUs();
      for (const HeldBackStep& step : steps) askPlainly(step);
      if (counts) tally_.plainUs += threadTimeUs() - begin;
    }
    tally_.steps += steps.size();
  }

  void judge(const HeldBackStep& step) {
    ask(step);
    tally_.pieces += static_cast<std::uint64_t>(brackets_.pieces);
    truths_.resize(countOf(looks()) + 1);
    for (int i = 0; i <= looks(); ++i) {
      truths_[slotOf(i)] = held_.truthAt(step, static_cast<double>(i) / looks());
    }
    if (trial_.asksOwnLinks) {
      for (const std::array<int, 2>& pair : pairs_) {
        LinkBracket bracket;
        bracket.verdict = BracketVerdict::Excluded;
        for (const LinkBracket& one : brackets_.pairs) {
          if (one.link == pair[0] && one.other == pair[1]) bracket = one;
        }
        judgeBracket(step, bracket, pair[0], pair[1]);
      }
      return;
    }
    for (const LinkBracket& bracket : brackets_.links) {
      if (!avatar_.lss(bracket.link).empty()) judgeBracket(step, bracket, bracket.link, -1);
    }
  }

  [[nodiscard]] double separation(const std::vector<HeldBack::Axis>& axes, int link, int other) {
    return other < 0 ? held_.fromScene(axes, link, 1e-3) : held_.fromLink(axes, link, other);
  }

  void judgeBracket(const HeldBackStep& step, const LinkBracket& bracket, int link, int other) {
    ++tally_.intervals;
    std::uint64_t* const counts[] = {&tally_.unclaimed, &tally_.excluded, &tally_.possible,
                                     &tally_.certain};
    ++*counts[static_cast<std::size_t>(bracket.verdict)];
    tally_.growthsMm.push_back(1e3 * bracket.growth);
    bool hasTouched = false, touchesFirst = false, touchesLast = false, isMissed = false;
    for (int i = 0; i <= looks(); ++i) {
      const double u = static_cast<double>(i) / looks();
      if (!(separation(truths_[slotOf(i)], link, other) < -kJudgeRounding)) continue;
      hasTouched = true;
      touchesFirst = touchesFirst || i == 0;
      touchesLast = touchesLast || i == looks();
      const bool isExcluded = bracket.verdict == BracketVerdict::Excluded ||
                              (bracket.verdict != BracketVerdict::Unclaimed &&
                               (u < bracket.possibleFrom || u > bracket.possibleUntil));
      if (!isExcluded || isMissed) continue;
      isMissed = true;
      ++tally_.missed;
      find(fmt::format("missed: link {} {} step {} at {:.6f}", link, other, step.from, u));
    }
    if (bracket.verdict == BracketVerdict::Certain) checkCertain(step, bracket, link, other);
    if (!hasTouched || touchesFirst) return;
    ++tally_.fresh;
    if (!touchesLast) ++tally_.missedByPoses;
    if (bracket.verdict != BracketVerdict::Certain) return;
    ++tally_.freshCertain;
    tally_.widthsMs.push_back(1e3 * seconds_ * (bracket.certainFrom - bracket.possibleFrom));
  }

  void checkCertain(const HeldBackStep& step, const LinkBracket& bracket, int link, int other) {
    for (const double u : {bracket.certainFrom, bracket.certainUntil}) {
      const double apart = separation(held_.truthAt(step, u), link, other);
      if (!(apart > kJudgeRounding)) continue;
      ++tally_.lied;
      find(fmt::format("lied: link {} {} step {} at {:.6f}, {:.3g} m apart", link, other, step.from,
                       u, apart));
    }
  }

  void find(std::string text) {
    if (tally_.findings.size() < kMostFindings) tally_.findings.push_back(std::move(text));
  }

  const PersonTrial& trial_;
  const Avatar& avatar_;
  std::vector<Pose> frames_;
  std::size_t every_;
  double seconds_;
  HeldBack held_;
  std::vector<std::array<int, 2>> pairs_;
  std::optional<BracketQuery> query_;
  std::optional<Query> plain_;
  std::vector<LinkBound> bounds_;
  Scratch scratch_;
  StepBrackets brackets_;
  StepContacts contacts_;
  ChainMotion motion_;
  std::vector<std::vector<HeldBack::Axis>> truths_;  // of the step at hand
  PersonTally tally_;
};

}  // namespace

void PersonTally::add(const PersonTally& o) {
  intervals += o.intervals;
  missed += o.missed;
  lied += o.lied;
  excluded += o.excluded;
  possible += o.possible;
  certain += o.certain;
  unclaimed += o.unclaimed;
  fresh += o.fresh;
  freshCertain += o.freshCertain;
  missedByPoses += o.missedByPoses;
  widthsMs.insert(widthsMs.end(), o.widthsMs.begin(), o.widthsMs.end());
  growthsMm.insert(growthsMm.end(), o.growthsMm.begin(), o.growthsMm.end());
  bracketUs += o.bracketUs;
  plainUs += o.plainUs;
  pieces += o.pieces;
  steps += o.steps;
  findings.insert(findings.end(), o.findings.begin(), o.findings.end());
}

PersonTally judgePerson(const SolidStage& stage, const SolidActor& actor, const Placement& place,
                        const PersonTrial& trial) {
  return Trial(stage, actor, place, trial).run();
}

}  // namespace foretouch::tools
