#include "tools/touches/touch_tracker.h"

#include <algorithm>
#include <utility>

namespace foretouch::tools {

void TouchTracker::addStep(const TouchStep& step, std::vector<Touch>& ended,
                           std::vector<std::size_t>& begun) {
  index(step);
  endWhatDoesNotPersist(step.step, ended);
  for (std::size_t i = 0; i < step.rows.size(); ++i) {
    if (!step.rows[i].isUndecided() && take(step.rows[i], step.step)) begun.push_back(i);
  }
}

void TouchTracker::breakOff(std::vector<Touch>& ended) {
  for (auto& [pair, open] : open_) {
    Touch& touch = open.touch;
    touch.isOpen = true;
    touch.isMissed = !touch.startsAtAPose && open.isLastMissed;
    ended.push_back(std::move(touch));
  }
  open_.clear();
}

void TouchTracker::index(const TouchStep& step) {
  rowOf_.clear();
  contactOf_.clear();
  undecidedOf_.clear();
  for (const TouchRow& row : step.rows) {
    const bool isOfScene = row.other < 0;
    if (!isOfScene || !row.isUndecided()) rowOf_.try_emplace(keyOf(row), &row);
    if (!isOfScene) continue;
    (row.isUndecided() ? undecidedOf_ : contactOf_).try_emplace(row.contact->link, &row);
  }
}

/// What is undecided from the earlier pose on may go on; else that pose is free of contact.
TouchTracker::Fate TouchTracker::fateBy(const TouchRow& undecided) {
  return undecided.contact->freeUntil > 0.0 ? Fate::Left : Fate::Unknown;
}

TouchTracker::Fate TouchTracker::fateOf(const TouchPair& pair) const {
  const auto row = rowOf_.find(keyOf(pair));
  if (row != rowOf_.end()) {
    if (row->second->isUndecided()) return fateBy(*row->second);
    return row->second->isAtStart() ? Fate::Persists : Fate::Left;
  }
  if (pair.other >= 0) return Fate::Left;
  if (scope_ == TouchScope::FirstOfLink) {
    const auto first = contactOf_.find(pair.link);
    if (first != contactOf_.end()) return first->second->isAtStart() ? Fate::Hidden : Fate::Left;
  }
  const auto undecided = undecidedOf_.find(pair.link);
  return undecided == undecidedOf_.end() ? Fate::Left : fateBy(*undecided->second);
}

void TouchTracker::endWhatDoesNotPersist(std::int64_t step, std::vector<Touch>& ended) {
  for (auto at = open_.begin(); at != open_.end();) {
    Touch& touch = at->second.touch;
    const Fate fate = fateOf(touch);
    if (fate == Fate::Persists || fate == Fate::Hidden) {
      ++at;
      continue;
    }
    // The pose that ended its last step is free of it only if this step begins there.
    const bool isSeenToEnd = fate == Fate::Left && touch.lastStep == step - 1;
    touch.isOpen = fate == Fate::Unknown;
    touch.isMissed = !touch.startsAtAPose && (isSeenToEnd || at->second.isLastMissed);
    ended.push_back(std::move(touch));
    at = open_.erase(at);
  }
}

/// True if the row begins a touch.
bool TouchTracker::take(const TouchRow& row, std::int64_t step) {
  const auto at = open_.find(keyOf(row));
  if (at != open_.end()) {
    grow(at->second, row, step);
    return false;
  }
  Open open{firstOf(row, step), row.isMissed};
  TouchPair pair = open.touch;
  open_.emplace(std::move(pair), std::move(open));
  return true;
}

Touch TouchTracker::firstOf(const TouchRow& row, std::int64_t step) {
  Touch touch;
  touch.link = row.contact->link;
  touch.other = row.other;
  touch.object = row.object;
  touch.beginsInside = row.isAtStart();
  touch.startsAtAPose = row.contact->verdict == Verdict::StartsInContact;
  touch.isGround = row.isGround;
  touch.beginS = touch.endS = row.timeS;
  touch.beginUs = touch.endUs = row.utimeUs;
  touch.firstStep = touch.lastStep = step;
  touch.contacts = 1;
  touch.separation = row.contact->separation;
  touch.penetration = row.contact->penetration;
  return touch;
}

void TouchTracker::grow(Open& open, const TouchRow& row, std::int64_t step) {
  const Touch next = firstOf(row, step);
  Touch& touch = open.touch;
  touch.startsAtAPose = touch.startsAtAPose || next.startsAtAPose;
  touch.isGround = touch.isGround && next.isGround;
  touch.endS = std::max(touch.endS, next.endS);
  touch.endUs = std::max(touch.endUs, next.endUs);
  touch.lastStep = step;
  ++touch.contacts;
  touch.separation = std::min(touch.separation, next.separation);
  touch.penetration = std::max(touch.penetration, next.penetration);
  open.isLastMissed = row.isMissed;
}

}  // namespace foretouch::tools
