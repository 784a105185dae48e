#include "tools/person/person_touches.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/bounds/bound_presets.h"
#include "assets/json_writer.h"
#include "lss/index.h"
#include "middleware/bracket/axis_places.h"
#include "tools/json_line.h"

namespace foretouch::tools {
namespace {

/// A clip breaks a bound beyond this (m): poses and places are rounded in files.
constexpr double kBreaks = 1e-6;

/// Joins the brackets of steps, counts them, and checks the clip by them.
class PersonTracker {
 public:
  PersonTracker(const ReplayInputs& inputs, std::vector<LinkBound> bounds)
      : inputs_(inputs), bounds_(std::move(bounds)), placer_(inputs.avatar) {}

  void add(std::int64_t step, const StepBrackets& brackets) {
    joiner_.add(inputs_.timeOfStep(step), inputs_.timeOfStep(step + 1), brackets);
    for (const LinkBracket& bracket : brackets.links) {
      if (!inputs_.avatar.lss(bracket.link).empty()) answer_.counts.add(bracket.verdict);
    }
  }

  /// Whether the frames that were left out are within the bounds.
  Result<Done> check(std::int64_t step, const PosedStep& posed, MotionModel model,
                     const StepBrackets& brackets) {
    const std::int64_t first = inputs_.steps.frameOf(step);
    const std::int64_t last = inputs_.steps.frameOf(step + 1);
    if (last - first < 2) return Done{};
    model_.assign(inputs_.avatar.skeleton(), posed, model);
    const ChainMotion constant(inputs_.avatar.skeleton(), *posed.from, *posed.to);
    Pose pose;
    for (std::int64_t frame = first + 1; frame < last; ++frame) {
      const double u = static_cast<double>(frame - first) / static_cast<double>(last - first);
      model_.isConstantRate() ? constant.poseAt(u, pose) : model_.poseAt(u, pose);
      FORETOUCH_TRY(const Pose truth, poseAtFrame(inputs_, frame));
      placer_.place(truth, truth_);
      placer_.place(pose, modelled_);
      placer_.differences(truth_, modelled_, apart_);
      for (const LinkBracket& bracket : brackets.links) {
        if (bracket.verdict != BracketVerdict::Unclaimed) checkLink(bracket, frame, u);
      }
    }
    return Done{};
  }

  PersonAnswer finish() {
    answer_.touches = joiner_.finish();
    return std::move(answer_);
  }

 private:
  void checkLink(const LinkBracket& bracket, std::int64_t frame, double u) {
    const double error = bounds_[slotOf(bracket.link)].error;
    const double rho = error + 4.0 * (bracket.growth - error) * u * (1.0 - u);
    const double beyond = apart_[slotOf(bracket.link)] - rho;
    if (!(beyond > kBreaks)) return;
    PersonCounts& counts = answer_.counts;
    ++counts.broken;
    if (beyond <= counts.worstM) return;
    counts.worstM = beyond;
    counts.worstLink = bracket.link;
    counts.worstS = static_cast<double>(frame) * inputs_.clip.frameTimeS;
  }

  const ReplayInputs& inputs_;
  std::vector<LinkBound> bounds_;
  AxisPlacer placer_;
  ModelMotion model_;
  AxisPlaces truth_, modelled_;
  std::vector<double> apart_;
  BracketJoiner joiner_;
  PersonAnswer answer_;
};

/// The four poses around a step, of which each is read once.
class PosesAround {
 public:
  PosesAround(const ReplayInputs& inputs, MotionModel model) : inputs_(inputs), model_(model) {}

  Result<PosedStep> at(std::int64_t step) {
    for (; next_ < std::min(step + 3, inputs_.steps.count + 1); ++next_) {
      FORETOUCH_TRY(poses_[slotOf(next_ % kKept)],
                    poseAtFrame(inputs_, inputs_.steps.frameOf(next_)));
    }
    const auto poseOf = [&](std::int64_t i) -> const Pose* {
      return i >= 0 && i <= inputs_.steps.count ? &poses_[slotOf(i % kKept)] : nullptr;
    };
    const double seconds = inputs_.timeOfStep(1) - inputs_.timeOfStep(0);
    const bool isLate = model_ == MotionModel::CubicLate;
    return PosedStep{
        poseOf(step - 1), poseOf(step), poseOf(step + 1), isLate ? poseOf(step + 2) : nullptr,
        seconds,          seconds,      seconds};
  }

 private:
  static constexpr std::int64_t kKept = 4;
  const ReplayInputs& inputs_;
  MotionModel model_;
  std::int64_t next_ = 0;
  Pose poses_[kKept];
};

double rateOf(const ReplayInputs& inputs) {
  return 1.0 / (inputs.timeOfStep(1) - inputs.timeOfStep(0));
}

std::string lineOf(const ReplayInputs& inputs, const PersonTouch& touch) {
  const Skeleton& skeleton = inputs.avatar.skeleton();
  PersonNames names;
  names.link = skeleton.name(touch.link);
  if (touch.other != kNoParent) names.other = skeleton.name(touch.other);
  if (touch.triangle >= 0) {
    names.object = inputs.scene.objectNames()[slotOf(inputs.scene.object(touch.triangle))];
  }
  return personTouchLine(names, touch);
}

std::string lineOf(const ReplayInputs& inputs, const PersonRequest& request,
                   const PersonAnswer& answer) {
  const PersonCounts& counts = answer.counts;
  return objectLine("person", [&](JsonWriter& out) {
    out.field("bounds", std::filesystem::path(request.boundsPath).filename().string());
    out.field("between", toString(request.model));
    out.field("rate_hz", answer.rateHz);
    out.field("link_steps", counts.intervals);
    out.field("excluded", counts.excluded);
    out.field("possible", counts.possible);
    out.field("certain", counts.certain);
    out.field("unclaimed", counts.unclaimed);
    out.field("bounds_broken", counts.broken);
    if (counts.broken > 0) {
      out.field("worst_link", inputs.avatar.skeleton().name(counts.worstLink));
      out.field("worst_s", counts.worstS);
      out.field("worst_m", counts.worstM);
    }
  });
}

}  // namespace

void PersonCounts::add(BracketVerdict verdict) {
  ++intervals;
  switch (verdict) {
    case BracketVerdict::Unclaimed: ++unclaimed; break;
    case BracketVerdict::Excluded: ++excluded; break;
    case BracketVerdict::Possible: ++possible; break;
    case BracketVerdict::Certain: ++certain; break;
  }
}

void PersonCounts::addExcluded(std::int64_t more) {
  intervals += more;
  excluded += more;
}

Result<LinkBounds> personBounds(const ReplayInputs& inputs, const PersonRequest& request) {
  if (!request.isAsked()) return LinkBounds{};
  FORETOUCH_TRY(const BoundsFile file, readBounds(request.boundsPath));
  return inFile(boundsOf(file, inputs.avatar.skeleton(), request.model, rateOf(inputs)),
                request.boundsPath);
}

Result<PersonAnswer> personTouches(const ReplayInputs& inputs, const PersonRequest& request,
                                   const LinkBounds& bounds) {
  FORETOUCH_TRY(const auto query,
                BracketQuery::build(inputs.avatar, inputs.scene, bracketOptionsOf(inputs.query)));
  PersonTracker tracker(inputs, bounds.bounds);
  PosesAround poses(inputs, request.model);
  Scratch scratch;
  StepBrackets brackets;
  for (std::int64_t step = 0; step < inputs.steps.count; ++step) {
    FORETOUCH_TRY(const PosedStep posed, poses.at(step));
    FORETOUCH_CHECK(query.answer(posed, request.model, bounds.bounds, scratch, brackets));
    tracker.add(step, brackets);
    FORETOUCH_CHECK(tracker.check(step, posed, request.model, brackets));
  }
  PersonAnswer answer = tracker.finish();
  answer.rateHz = rateOf(inputs);
  for (LinkId link = 0; link < inputs.avatar.numLinks(); ++link) {
    if (!inputs.avatar.lss(link).empty() && bounds.entryOf[slotOf(link)] < 0) {
      answer.unclaimed.push_back(link);
    }
  }
  return answer;
}

std::string personLines(const ReplayInputs& inputs, const PersonRequest& request,
                        const PersonAnswer& answer) {
  std::string text;
  for (const PersonTouch& touch : answer.touches) text += lineOf(inputs, touch);
  return text + lineOf(inputs, request, answer);
}

std::string personText(const ReplayInputs& inputs, const PersonRequest& request,
                       const PersonAnswer& answer) {
  const PersonCounts& counts = answer.counts;
  const auto certain = std::count_if(answer.touches.begin(), answer.touches.end(),
                                     [](const PersonTouch& touch) { return touch.isCertain; });
  const auto percent = [&](std::int64_t part) {
    return counts.intervals == 0
               ? 0.0
               : 100.0 * static_cast<double>(part) / static_cast<double>(counts.intervals);
  };
  std::string text = fmt::format(
      "\nthe person, within the bounds of {} ({}, {:.3g} poses per second):\n"
      "{:<22}{:>10}\n{:<22}{:>10}\n{:<22}{:>10.2f} %   of links and steps: touched nothing\n"
      "{:<22}{:>10.2f} %\n{:<22}{:>10.2f} %\n",
      request.boundsPath, toString(request.model), answer.rateHz, "surely touched", certain,
      "perhaps touched", static_cast<std::int64_t>(answer.touches.size()) - certain, "excluded",
      percent(counts.excluded), "certain", percent(counts.certain), "undecided",
      percent(counts.possible));
  if (counts.unclaimed > 0) {
    text += fmt::format("{:<22}{:>10.2f} %\n", "unclaimed", percent(counts.unclaimed));
  }
  for (const std::string& note : personNotes(inputs, answer)) text += note + "\n";
  return text;
}

std::vector<std::string> personNotes(const ReplayInputs& inputs, const PersonAnswer& answer) {
  const PersonCounts& counts = answer.counts;
  std::vector<std::string> notes;
  if (counts.unclaimed > 0) {
    notes.push_back(fmt::format(
        "Of the person nothing is claimed where a link has no bound: {} of the links have none.",
        answer.unclaimed.size()));
  }
  if (counts.broken > 0) {
    notes.push_back(fmt::format(
        "The clip breaks its bounds at {} of the poses that were left out, link by link: {} at "
        "{:.3f} s by {:.1f} mm. What is said of the person there does not hold.",
        counts.broken, inputs.avatar.skeleton().name(counts.worstLink), counts.worstS,
        1e3 * counts.worstM));
  }
  return notes;
}

Result<PersonTold> tellPerson(const ReplayInputs& inputs, const PersonRequest& request,
                              const LinkBounds& bounds) {
  if (!request.isAsked()) return PersonTold{};
  FORETOUCH_TRY(auto answer, personTouches(inputs, request, bounds));
  PersonTold told;
  told.lines = personLines(inputs, request, answer);
  told.text = personText(inputs, request, answer);
  told.answer = std::move(answer);
  return told;
}

}  // namespace foretouch::tools
