#include "tools/replay/followed_touches.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "articulated/try.h"
#include "lss/index.h"

namespace foretouch::tools {
FollowedTouches::FollowedTouches(const ReplayInputs& inputs, StepFollower follower)
    : inputs_(inputs),
      follower_(std::move(follower)),
      ground_(inputs.avatar, inputs.scene, inputs.request.ground) {}

Result<Done> FollowedTouches::add(const StepAnswer& answer, std::vector<ReportedContact>& begun,
                                  std::vector<Touch>& ended) {
  addRows(answer);
  FORETOUCH_TRY(const bool isFollowed, follower_.add(answer.step));
  if (!isFollowed) return Done{};
  takeEvents();
  countRows();
  takeBegun(begun);
  takeEnded(ended);
  return Done{};
}

Result<Done> FollowedTouches::finish(std::vector<ReportedContact>& begun,
                                     std::vector<Touch>& ended) {
  FORETOUCH_CHECK(follower_.finish());
  takeEvents();
  countRows();
  takeBegun(begun);
  for (Live& live : live_) {
    if (!live.isEnded) end(live, follower_.end(), true);
  }
  takeEnded(ended);
  return Done{};
}

void FollowedTouches::addRows(const StepAnswer& answer) {
  const bool isByObject = inputs_.query.scope == Scope::EveryObject;
  const std::vector<LinkContact>& contacts = isByObject ? answer.objects : answer.contacts;
  const std::vector<LinkId>& missed = answer.missedByPoses;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (contacts[i].verdict == Verdict::Undecided) continue;
    Row row;
    row.contact = contacts[i];
    row.object = inputs_.scene.object(contacts[i].triangle);
    row.step = answer.step;
    row.isGround = i < answer.onGround.size() && answer.onGround[i];
    row.isMissed = std::find(missed.begin(), missed.end(), contacts[i].link) != missed.end();
    rows_.push_back(row);
  }
  for (const PairContact& contact : answer.pairs) {
    if (contact.verdict == Verdict::Undecided) continue;
    Row row;
    row.contact = contact;
    row.other = contact.other;
    row.step = answer.step;
    rows_.push_back(row);
  }
}

void FollowedTouches::takeEvents() {
  for (const WorldEvent& event : follower_.events()) {
    if (event.kind == EventKind::Leave || event.kind == EventKind::UnresolvedFrom) end(event);
    if (event.kind == EventKind::Enter || event.kind == EventKind::StartsInside) begin(event);
  }
}

void FollowedTouches::begin(const WorldEvent& event) {
  const StepInstant instant = follower_.instantOf(event.time);
  Live& live = live_.emplace_back();
  live.first = contactOf(event);
  live.object = event.object;
  live.from = instant.steps();
  live.to = std::numeric_limits<double>::infinity();
  Touch& touch = live.touch;
  touch.link = event.a.link;
  if (event.b.body == kStillScene) {
    touch.object = inputs_.scene.objectNames()[slotOf(event.object)];
    touch.isGround = isGround(live.first, instant.step);
  } else {
    touch.other = event.b.link;
    touch.object = inputs_.avatar.skeleton().name(touch.other);
  }
  touch.beginsInside = touch.startsAtAPose = event.kind == EventKind::StartsInside;
  touch.beginS = secondsOf(instant);
  touch.firstStep = instant.step;
  touch.separation = event.separation;
  touch.penetration = event.penetration;
}

bool FollowedTouches::isGround(const LinkContact& contact, std::int64_t step) {
  const ChainMotion motion = follower_.motionOf(step);
  ground_.beginStep(motion);
  return ground_.isGround(contact);
}

LinkContact FollowedTouches::contactOf(const WorldEvent& event) const {
  LinkContact contact;
  contact.link = event.a.link;
  contact.lss = event.a.lss;
  contact.linkTriangle = event.a.triangle;
  contact.verdict =
      event.kind == EventKind::StartsInside ? Verdict::StartsInContact : Verdict::Contact;
  contact.toi = contact.freeUntil = follower_.instantOf(event.time).share;
  contact.separation = event.separation;
  contact.penetration = event.penetration;
  contact.triangle = event.b.triangle;
  contact.p_WScene = event.b.p_W;
  contact.p_WLink = event.a.p_W;
  contact.nhat_SL_W = event.nhat_BA_W;
  return contact;
}

/// Where nothing is known of several, each ends.
void FollowedTouches::end(const WorldEvent& event) {
  const bool isLeft = event.kind == EventKind::Leave && event.cause == LeaveCause::Apart;
  const LinkId other = event.b.body == kStillScene ? -1 : event.b.link;
  const bool isOfAll = event.a.link == kEveryLink || event.b.body == kEveryBody;
  for (Live& live : live_) {
    const bool isIts =
        live.touch.link == event.a.link && live.touch.other == other && live.object == event.object;
    if (!live.isEnded && (isOfAll || isIts)) end(live, follower_.instantOf(event.time), !isLeft);
  }
}

void FollowedTouches::end(Live& live, const StepInstant& instant, bool isOpen) {
  live.isEnded = true;
  live.to = instant.steps();
  live.touch.isOpen = isOpen;
  live.touch.endS = secondsOf(instant);
  live.touch.lastStep = instant.step;
}

void FollowedTouches::countRows() {
  for (const Row& row : rows_) {
    Live* const live = liveOf(row);
    if (live == nullptr) continue;
    const StepInstant instant{row.step, row.contact.toi};
    count(row, secondsOf(instant), *live);
  }
  rows_.clear();
}

/// The touch that goes on at the row's instant. A step and the follower may find the same contact
/// at two instants of the step: each at one that is proven, and within the tolerance.
FollowedTouches::Live* FollowedTouches::liveOf(const Row& row) {
  Live* beginning = nullptr;
  for (Live& live : live_) {
    const bool isIts = live.touch.link == row.contact.link && live.touch.other == row.other &&
                       live.object == row.object;
    if (!isIts) continue;
    if (live.from <= row.at() && row.at() <= live.to) return &live;
    const bool isLater = row.at() < live.from && live.touch.firstStep == row.step;
    if (isLater && beginning == nullptr) beginning = &live;
  }
  return beginning;
}

/// The row that begins a touch in a step's answer begins it in the list.
void FollowedTouches::count(const Row& row, double timeS, Live& live) {
  Touch& touch = live.touch;
  if (touch.contacts == 0 && row.step == touch.firstStep &&
      row.contact.verdict == Verdict::Contact) {
    live.first = row.contact;
    live.isMissed = row.isMissed;
    live.from = row.at();
    touch.beginS = timeS;
  }
  ++touch.contacts;
  touch.startsAtAPose = touch.startsAtAPose || row.contact.verdict == Verdict::StartsInContact;
  touch.isGround = touch.isGround && row.isGround;
  touch.separation = std::min(touch.separation, row.contact.separation);
  touch.penetration = std::max(touch.penetration, row.contact.penetration);
}

void FollowedTouches::takeBegun(std::vector<ReportedContact>& begun) {
  for (Live& live : live_) {
    if (!std::exchange(live.isNew, false)) continue;
    const Touch& touch = live.touch;
    begun.push_back(
        {live.first, touch.firstStep, touch.beginS, touch.object, live.isMissed, touch.other});
  }
}

void FollowedTouches::takeEnded(std::vector<Touch>& ended) {
  const auto open = std::stable_partition(live_.begin(), live_.end(),
                                          [](const Live& live) { return live.isEnded; });
  for (auto live = live_.begin(); live != open; ++live) {
    // No pose is in it.
    live->touch.isMissed = std::ceil(live->from) > live->to;
    ended.push_back(std::move(live->touch));
  }
  live_.erase(live_.begin(), open);
}

double FollowedTouches::secondsOf(const StepInstant& instant) const {
  const double beginS = inputs_.timeOfStep(instant.step);
  return beginS + instant.share * (inputs_.timeOfStep(instant.step + 1) - beginS);
}

}  // namespace foretouch::tools
