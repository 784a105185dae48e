#include "tools/person/person_touches.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/bounds/bound_presets.h"
#include "assets/json_writer.h"
#include "lss/index.h"
#include "middleware/bracket/brackets_of.h"
#include "tools/inputs/lost_frames.h"
#include "tools/json_line.h"
#include "tools/person/bound_check.h"
#include "tools/person/pose_gaps.h"

namespace foretouch::tools {
namespace {

/// The four poses around a step; each is read once.
class PosesAround {
 public:
  PosesAround(const ReplayInputs& inputs, const LostFrames& lost, MotionModel model)
      : inputs_(inputs), lost_(lost), model_(model) {}

  Result<PosedStep> at(std::int64_t step) {
    for (; next_ < std::min(step + 3, inputs_.steps.count + 1); ++next_) {
      FORETOUCH_TRY(poses_[slotOf(next_ % kKept)],
                    poseAtFrame(inputs_, inputs_.steps.frameOf(next_)));
    }
    const auto poseOf = [&](std::int64_t i) { return &poses_[slotOf(i % kKept)]; };
    // Not a neighbour in which no link is known.
    const auto besideOf = [&](std::int64_t i) -> const Pose* {
      const bool isThere = i >= 0 && i <= inputs_.steps.count;
      return isThere && !lost_.isAllLost(inputs_.steps.frameOf(i)) ? poseOf(i) : nullptr;
    };
    const double seconds = inputs_.timeOfStep(1) - inputs_.timeOfStep(0);
    const bool isLate = model_ == MotionModel::CubicLate;
    return PosedStep{besideOf(step - 1),
                     poseOf(step),
                     poseOf(step + 1),
                     isLate ? besideOf(step + 2) : nullptr,
                     seconds,
                     seconds,
                     seconds};
  }

 private:
  static constexpr std::int64_t kKept = 4;
  const ReplayInputs& inputs_;
  const LostFrames& lost_;
  MotionModel model_;
  std::int64_t next_ = 0;
  Pose poses_[kKept];
};

/// Asks step by step, joins the brackets, counts them, and checks the clip by them.
class PersonTracker {
 public:
  PersonTracker(const ReplayInputs& inputs, MotionModel model, const std::vector<LinkBound>& bounds,
                const BracketQuery& query)
      : inputs_(inputs),
        model_(model),
        bounds_(bounds),
        query_(query),
        lost_(inputs.avatar, inputs.clip, inputs.match),
        gaps_(bounds.size(), lost_, inputs.steps),
        check_(inputs.avatar, bounds) {}

  Result<PersonAnswer> run() {
    PosesAround poses(inputs_, lost_, model_);
    for (std::int64_t step = 0; step < inputs_.steps.count; ++step) {
      FORETOUCH_TRY(const PosedStep posed, poses.at(step));
      FORETOUCH_CHECK(ask(step, posed));
    }
    FORETOUCH_CHECK(askAcross(gaps_.endAll(inputs_.steps.count)));
    addTouches(joiner_);
    std::stable_sort(
        answer_.touches.begin(), answer_.touches.end(),
        [](const PersonTouch& x, const PersonTouch& y) { return x.beginsS[0] < y.beginsS[0]; });
    return std::move(answer_);
  }

 private:
  Result<Done> ask(std::int64_t step, const PosedStep& posed) {
    const std::vector<LinkBound>& claimed = gaps_.claimed(step, posed, bounds_);
    FORETOUCH_CHECK(askAcross(gaps_.ended()));
    if (gaps_.isAllOpen()) return Done{};
    FORETOUCH_CHECK(query_.answer(posed, model_, claimed, scratch_, brackets_));
    joiner_.add(inputs_.timeOfStep(step), inputs_.timeOfStep(step + 1), brackets_);
    for (const LinkBracket& bracket : brackets_.links) {
      if (!gaps_.isOpen(bracket.link)) count(bracket, 1);
    }
    return check(step, posed);
  }

  void count(const LinkBracket& bracket, std::int64_t steps) {
    if (!inputs_.avatar.lss(bracket.link).empty()) answer_.counts.add(bracket.verdict, steps);
  }

  void addTouches(BracketJoiner& joiner) {
    for (PersonTouch& touch : joiner.finish()) answer_.touches.push_back(touch);
  }

  /// Asks where only speeds say where the person was.
  Result<Done> askAcross(const std::vector<PoseGap>& gaps) {
    for (const PoseGap& gap : gaps) {
      FORETOUCH_CHECK(askAcross(gap));
      keepBracketsOf([&](LinkId link) { return gap.has(link); }, brackets_);
      const std::int64_t before = answer_.counts.intervals;
      for (const LinkBracket& bracket : brackets_.links) count(bracket, gap.to - gap.from);
      answer_.counts.inGaps += answer_.counts.intervals - before;
      BracketJoiner ofPart;
      const bool isOfAll = gap.links.size() == bounds_.size();
      (isOfAll ? joiner_ : ofPart)
          .add(inputs_.timeOfStep(gap.from), inputs_.timeOfStep(gap.to), brackets_);
      addTouches(ofPart);
    }
    return Done{};
  }

  Result<Done> askAcross(const PoseGap& gap) {
    FORETOUCH_TRY(const Pose from, poseAtFrame(inputs_, inputs_.steps.frameOf(gap.from)));
    FORETOUCH_TRY(const Pose to, poseAtFrame(inputs_, inputs_.steps.frameOf(gap.to)));
    PosedStep posed;
    posed.from = &from;
    posed.to = &to;
    posed.seconds = inputs_.timeOfStep(gap.to) - inputs_.timeOfStep(gap.from);
    const std::vector<LinkBound> bounds = gaps_.across(gap, bounds_);
    FORETOUCH_CHECK(query_.answerGap(posed, bounds, scratch_, brackets_));
    check_.across(posed, gap.links, bounds, inputs_.timeOfStep(gap.to), answer_.counts);
    return Done{};
  }

  /// Whether the frames that were left out are within the bounds.
  Result<Done> check(std::int64_t step, const PosedStep& posed) {
    const std::int64_t first = inputs_.steps.frameOf(step);
    const std::int64_t last = inputs_.steps.frameOf(step + 1);
    if (last - first < 2) return Done{};
    check_.begin(posed, model_);
    for (std::int64_t frame = first + 1; frame < last; ++frame) {
      const double u = static_cast<double>(frame - first) / static_cast<double>(last - first);
      FORETOUCH_TRY(const Pose truth, poseAtFrame(inputs_, frame));
      check_.leftOut(
          truth, u, static_cast<double>(frame) * inputs_.clip.frameTimeS, brackets_,
          [&](LinkId link) { return !lost_.isLost(link, frame); }, answer_.counts);
    }
    return Done{};
  }

  const ReplayInputs& inputs_;
  MotionModel model_;
  const std::vector<LinkBound>& bounds_;
  const BracketQuery& query_;
  LostFrames lost_;
  PoseGaps gaps_;
  BoundCheck check_;
  Scratch scratch_;
  StepBrackets brackets_;
  BracketJoiner joiner_;
  PersonAnswer answer_;
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
    if (counts.inGaps > 0) out.field("in_gaps", counts.inGaps);
    out.field("bounds_broken", counts.broken);
    if (counts.broken > 0) {
      out.field("worst_link", inputs.avatar.skeleton().name(counts.worstLink));
      out.field("worst_s", counts.worstS);
      out.field("worst_m", counts.worstM);
    }
  });
}

}  // namespace

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
  FORETOUCH_TRY(PersonAnswer answer,
                PersonTracker(inputs, request.model, bounds.bounds, query).run());
  answer.rateHz = rateOf(inputs);
  for (LinkId link = 0; link < inputs.avatar.numLinks(); ++link) {
    const LinkBound& bound = bounds.bounds[slotOf(link)];
    const bool isBounded = std::isfinite(bound.acceleration) || std::isfinite(bound.followFloor);
    if (!inputs.avatar.lss(link).empty() && !isBounded) {
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
  if (counts.inGaps > 0) {
    notes.push_back(fmt::format(
        "The clip has gaps: of {} of links and steps only gap_speed_m_s says where the person was, "
        "and nothing at the clip's begin and end or where there is none.",
        counts.inGaps));
  }
  if (!answer.unclaimed.empty()) {
    notes.push_back(fmt::format(
        "Of the person nothing is claimed where a link has no bound: {} of the links have none.",
        answer.unclaimed.size()));
  }
  const std::string broken = counts.brokenNote(inputs.avatar.skeleton().name(counts.worstLink));
  if (!broken.empty()) notes.push_back(broken);
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
