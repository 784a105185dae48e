#include "tools/solid/shown_track.h"

#include <algorithm>
#include <utility>

#include "lss/index.h"

namespace foretouch::tools {
namespace {

/// How long before a tick's end, as its share, the curve leaves a pose that no motion leads from.
constexpr double kJumpShare = 1e-3;

bool isSamePair(const ShownContact& a, const Touch& b) {
  return a.contact.link == b.link && a.other == b.other && a.object == b.object;
}

Touch begun(const ShownContact& contact) {
  Touch touch;
  touch.link = contact.contact.link;
  touch.other = contact.other;
  touch.object = contact.object;
  touch.beginS = touch.endS = contact.timeS;
  touch.firstStep = touch.lastStep = contact.step;
  touch.contacts = 1;
  touch.separation = contact.contact.separation;
  return touch;
}

}  // namespace

void ShownTrack::addPose(double timeS, const Pose& pose, std::int64_t tick, bool isStep) {
  if (!timesS_.empty() && !(timeS > timesS_.back())) {
    // Two pieces nearer in time than doubles can resolve: the later one stands for both.
    poses_.back() = pose;
    return;
  }
  const auto at = static_cast<std::uint32_t>(poses_.size());
  timesS_.push_back(timeS);
  poses_.push_back(pose);
  if (isStep) steps_.push_back({at - 1, at, tick});
}

void ShownTrack::add(const PlayedTick& tick) {
  const double length = tickS(inputs_), beginS = tick.timeS - length;
  const bool isCurve = tick.answer.isCertified && tick.start() == nullptr && !poses_.empty();
  if (isCurve) {
    for (std::size_t i = 0; i < tick.numPieces(); ++i) {
      const double t = tick.timeOfPiece(i);
      addPose(t < 1.0 ? beginS + t * length : tick.timeS, tick.piece(i), tick.tick, true);
    }
  } else if (!poses_.empty()) {
    const Pose before = poses_.back();
    addPose(tick.timeS - kJumpShare * length, before, tick.tick, false);
  }
  if (poses_.empty() || timesS_.back() < tick.timeS) {
    addPose(tick.timeS, tick.answer.shown, tick.tick, isCurve);
  }
  shownAtTick_.push_back(poses_.size() - 1);
  tracked_.push_back(tick.tracked);
  tickTimesS_.push_back(tick.timeS);
  states_.push_back(tick.answer.state);
  deviations_.push_back(tick.answer.deviation);
  addContacts(tick);
}

void ShownTrack::takeContact(const SolidContact& contact, double timeS,
                             std::vector<ShownContact>& found) {
  ShownContact shown;
  shown.contact.link = contact.link;
  shown.contact.verdict = Verdict::Contact;
  shown.contact.toi = shown.contact.freeUntil = 1.0;
  shown.contact.separation = std::max(0.0, contact.gap);
  shown.contact.triangle = contact.triangle;
  shown.contact.lss = contact.lss;
  shown.contact.p_WScene = contact.p_W;
  shown.contact.p_WLink = contact.p_W + contact.gap * contact.nhat_W;
  shown.contact.nhat_SL_W = contact.nhat_W;
  shown.step = static_cast<std::int64_t>(steps_.size()) - 1;
  shown.timeS = timeS;
  shown.push = contact.push;
  shown.slipSpeed = contact.slipSpeed;
  if (contact.triangle >= 0) {
    const Scene& scene = inputs_.scene;
    shown.object = scene.objectNames()[slotOf(scene.object(contact.triangle))];
  } else {
    shown.other = contact.other;
    shown.object = inputs_.avatar.skeleton().name(contact.other);
  }
  for (ShownContact& known : found) {
    if (known.contact.link != contact.link || known.other != shown.other ||
        known.object != shown.object) {
      continue;
    }
    if (shown.push > known.push) known = std::move(shown);
    return;
  }
  found.push_back(std::move(shown));
}

/// Touches end with the last tick that has them: between ticks nothing is asked.
void ShownTrack::addContacts(const PlayedTick& tick) {
  std::vector<ShownContact> found;
  const bool hasStep = !steps_.empty() && steps_.back().tick == tick.tick;
  if (hasStep) {
    for (const SolidContact& contact : tick.answer.contacts) {
      if (contact.triangle >= 0 || contact.other >= 0) takeContact(contact, tick.timeS, found);
    }
  }
  std::vector<ShownTouchOf> still;
  for (ShownTouchOf& open : open_) {
    const bool goesOn = std::any_of(found.begin(), found.end(), [&](const ShownContact& contact) {
      return isSamePair(contact, open.touch);
    });
    (goesOn ? still : touches_).push_back(std::move(open));
  }
  open_ = std::move(still);
  for (ShownContact& contact : found) {
    auto open = std::find_if(open_.begin(), open_.end(), [&](const ShownTouchOf& one) {
      return isSamePair(contact, one.touch);
    });
    if (open == open_.end()) {
      open_.push_back({begun(contact), contacts_.size(), contact.push});
    } else {
      // It goes on from the tick before: shown from the begin of its step.
      contact.contact.toi = contact.contact.freeUntil = 0.0;
      Touch& touch = open->touch;
      touch.endS = contact.timeS;
      touch.lastStep = contact.step;
      touch.separation = std::min(touch.separation, contact.contact.separation);
      ++touch.contacts;
      open->mostPush = std::max(open->mostPush, contact.push);
      contact.timeS = timesS_[steps_.back().from];
    }
    contacts_.push_back(contact);
  }
}

void ShownTrack::finish() {
  for (ShownTouchOf& open : open_) {
    open.touch.isOpen = true;
    touches_.push_back(std::move(open));
  }
  open_.clear();
  std::stable_sort(touches_.begin(), touches_.end(),
                   [](const ShownTouchOf& x, const ShownTouchOf& y) {
                     return isListedBefore(x.touch, y.touch);
                   });
}

}  // namespace foretouch::tools
