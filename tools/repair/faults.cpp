#include "tools/repair/faults.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "articulated/try.h"
#include "lss/index.h"
#include "tools/feet/slide_path.h"
#include "tools/feet/stances.h"

namespace foretouch::tools {
namespace {

StepFault contactFault(FaultKind kind, std::int32_t step, const LinkContact& contact) {
  StepFault fault;
  fault.kind = kind;
  fault.step = step;
  fault.link = contact.link;
  fault.isStart = contact.verdict == Verdict::StartsInContact;
  fault.isUndecided = contact.verdict == Verdict::Undecided;
  fault.at = contact.freeUntil;
  fault.p_W = contact.p_WScene;
  fault.normal_W = contact.nhat_SL_W;
  fault.triangle = contact.triangle;
  fault.by = contact.penetration;
  return fault;
}

void addContacts(const RepairStage& stage, std::vector<StepFault>& faults) {
  Scratch scratch;
  StepContacts answer;
  ChainMotion motion;
  const auto& poses = stage.poses();
  for (std::int32_t step = 0; step + 1 < stage.numPoses(); ++step) {
    const std::size_t from = slotOf(step);
    motion.assign(stage.body().skeleton(), poses[from], poses[from + 1]);
    stage.query().answer(motion, scratch, answer);
    for (const LinkContact& contact : answer.perObject) {
      StepFault fault = contactFault(FaultKind::Scene, step, contact);
      if (contact.triangle >= 0) fault.object = stage.feet().level.scene().object(contact.triangle);
      faults.push_back(fault);
    }
    for (const LinkContact& link : answer.links) {
      if (link.verdict != Verdict::Undecided) continue;
      faults.push_back(contactFault(FaultKind::Scene, step, link));
    }
    for (const PairContact& pair : answer.pairs) {
      StepFault fault = contactFault(FaultKind::Own, step, pair);
      fault.other = pair.other;
      faults.push_back(fault);
    }
  }
}

/// The poses of a stance: first to last, within the clip.
std::pair<std::int32_t, std::int32_t> posesOf(const FootStance& stance, const FeetInputs& inputs) {
  const double begin = inputs.timeOf(0), step = inputs.stepS();
  const double first = std::ceil((stance.fromS - begin) / step - 1e-6);
  const double last = std::floor((stance.toS - begin) / step + 1e-6);
  return {static_cast<std::int32_t>(std::max(0.0, first)),
          static_cast<std::int32_t>(std::min(last, static_cast<double>(inputs.steps())))};
}

void addDepths(const RepairStage& stage, const FeetAnswer& feet, std::vector<StepFault>& faults) {
  const FeetInputs& inputs = stage.feet();
  const std::size_t parts = inputs.body.parts.size();
  for (const FootStance& stance : feet.stances) {
    if (stance.kind == StanceKind::Hovers || inputs.body.parts[stance.part].isHand()) continue;
    const auto [first, last] = posesOf(stance, inputs);
    StepFault fault;
    fault.kind = FaultKind::Under;
    fault.part = stance.part;
    fault.link = stage.linkOf(inputs.body.parts[stance.part].links.front());
    for (std::int32_t pose = first; pose <= last; ++pose) {
      const PartSample& sample = feet.sample(pose, stance.part, parts);
      if (!(sample.depth > kNoFault)) continue;
      fault.step = std::min(pose, stage.numPoses() - 2);
      fault.by = sample.depth;
      faults.push_back(fault);
    }
  }
}

bool bears(const RepairStage& stage, const FeetAnswer& feet, std::size_t part, std::int64_t pose) {
  const auto& parts = stage.feet().body.parts;
  const double height = feet.sample(pose, part, parts.size()).height;
  for (std::size_t other = 0; other < parts.size(); ++other) {
    if (parts[other].limb != parts[part].limb) continue;
    if (feet.sample(pose, other, parts.size()).height < height - kBears) return false;
  }
  return true;
}

void addSlides(const RepairStage& stage, Faults& faults) {
  for (const FootStance& stance : faults.feet.stances) {
    if (stance.looks.empty() || stage.feet().body.parts[stance.part].isHand()) continue;
    BearingStance bearing;
    bearing.part = stance.part;
    bearing.fromFrame = stance.fromFrame;
    bearing.toFrame = stance.toFrame;
    SlidePath path(kSlideRuler);
    for (const RestLook& look : stance.looks) {
      if (!bears(stage, faults.feet, stance.part, look.step)) continue;
      bearing.looks.push_back(look);
      path.add(look.way_W);
    }
    bearing.slide = path.length();
    bearing.moved = path.farthest();
    StepFault fault;
    fault.kind = FaultKind::Slide;
    fault.part = stance.part;
    fault.link = stage.linkOf(stage.feet().body.parts[stance.part].links.front());
    fault.by = bearing.slide;
    for (const RestLook& look : bearing.looks) {
      if (!bearing.isFault(stage.request().mostSlide)) break;
      const auto step = static_cast<std::int32_t>(look.step);
      if (look.way_W.isZero(0.0)) continue;
      fault.step = step;
      faults.all.push_back(fault);
    }
    faults.bearing.push_back(std::move(bearing));
  }
}

void addLimits(const RepairStage& stage, std::vector<StepFault>& faults) {
  for (std::size_t k = 0; k < stage.knobs().size(); ++k) {
    const Knob& knob = stage.knobs()[k];
    for (std::int32_t pose = 0; knob.isLimited() && pose < stage.numPoses(); ++pose) {
      const double value = knob.values[slotOf(stage.frameOf(pose))] +
                           stage.changes()(static_cast<Eigen::Index>(k), pose);
      const double excess = std::max(knob.lower - value, value - knob.upper);
      if (!(excess > kLimitRounding)) continue;
      StepFault fault;
      fault.kind = FaultKind::Limit;
      fault.link = static_cast<LinkId>(k);
      fault.step = pose;
      fault.by = excess;
      faults.push_back(fault);
    }
  }
}

}  // namespace

const char* toString(FaultKind kind) {
  switch (kind) {
    case FaultKind::Scene: return "touches";
    case FaultKind::Own: return "touches itself";
    case FaultKind::Under: return "under the ground";
    case FaultKind::Slide: return "slides";
    case FaultKind::Limit: return "beyond its limits";
  }
  return "";
}

std::int64_t Faults::countOf(FaultKind kind) const {
  std::int64_t count = 0;
  std::int32_t last = -1;
  for (const StepFault& fault : all) {
    if (fault.kind != kind || fault.step == last) continue;
    ++count;
    last = fault.step;
  }
  return count;
}

Result<Faults> faultsOf(const RepairStage& stage) {
  Faults faults;
  addContacts(stage, faults.all);
  FORETOUCH_TRY(faults.feet, stancesOf(stage.feet(), [](std::int64_t) { return true; }));
  addDepths(stage, faults.feet, faults.all);
  addSlides(stage, faults);
  addLimits(stage, faults.all);
  std::stable_sort(faults.all.begin(), faults.all.end(),
                   [](const StepFault& x, const StepFault& y) { return x.step < y.step; });
  faults.isFaulty.assign(slotOf(stage.numPoses() - 1), 0);
  for (const StepFault& fault : faults.all) {
    faults.isFaulty[std::min(slotOf(fault.step), faults.isFaulty.size() - 1)] = 1;
  }
  faults.faulty = std::count(faults.isFaulty.begin(), faults.isFaulty.end(), std::uint8_t{1});
  return faults;
}

}  // namespace foretouch::tools
