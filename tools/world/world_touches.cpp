#include "tools/world/world_touches.h"

#include <algorithm>

#include "lss/index.h"

namespace foretouch::tools {
namespace {

/// In [0,1] of the window, as steps of one avatar have it.
double shareOfWindow(const WorldTime& time, const WorldStep& step) {
  return std::clamp(
      microsecondsAfter(step.fromUs, time) / static_cast<double>(step.toUs - step.fromUs), 0.0,
      1.0);
}

double inSeconds(const WorldTime& time) {
  return (static_cast<double>(time.us) + time.fraction) / kUsPerS;
}

}  // namespace

LinkNumbers::LinkNumbers(const LoadedWorld& world) {
  first_.push_back(0);
  for (const LoadedBody& body : world.bodies) {
    first_.push_back(first_.back() + body.shape.skeleton.numJoints());
  }
}

BodyId LinkNumbers::bodyOf(LinkId number) const {
  const auto after = std::upper_bound(first_.begin(), first_.end(), number);
  return static_cast<BodyId>(after - first_.begin()) - 1;
}

WorldTouches::WorldTouches(const LoadedWorld& world)
    : world_(world), numbers_(world), tracker_(TouchScope::FirstOfLink) {}

void WorldTouches::addRow(const WorldContact& contact, const WorldStep& step) {
  LinkContact& seen = contacts_.emplace_back();
  seen.link = numbers_.of(contact.a);
  seen.verdict = contact.verdict;
  seen.toi = seen.freeUntil = shareOfWindow(contact.time, step);
  seen.separation = contact.separation;
  seen.penetration = contact.penetration;
  TouchRow& row = step_.rows.emplace_back();
  row.timeS = inSeconds(contact.time);
  if (contact.b.body != kStillScene) {
    row.other = numbers_.of(contact.b);
  } else if (contact.verdict != Verdict::Undecided) {
    row.object = world_.scene->objectNames()[slotOf(world_.scene->object(contact.b.triangle))];
  }
}

bool WorldTouches::isCarried(BodyId body, BodyId carrier, LinkId link, std::int64_t us) const {
  const BodyStretch* const stretch = stretchAt(world_.bodies[slotOf(body)].stretches, us);
  return stretch != nullptr && stretch->carrier && stretch->carrier->body == carrier &&
         stretch->carrier->link == link;
}

/// What is under way and of which the window says nothing is not known to end: of bodies that are
/// silent or undecided as a whole, and of two that one carries now.
void WorldTouches::addUnknown(const WorldStep& step) {
  std::set<BodyId> silent;
  for (const SilentBody& one : step.answer.silent) {
    if (one.takenTo == WhenSilent::Undecided && one.sinceUs <= step.fromUs) silent.insert(one.body);
  }
  // Nothing is known of what somebody silent carries, either.
  const auto isSilent = [&](BodyId body) {
    while (!silent.empty() && silent.count(body) == 0) {
      const BodyStretch* const stretch =
          stretchAt(world_.bodies[slotOf(body)].stretches, step.fromUs);
      if (stretch == nullptr || !stretch->carrier) return false;
      body = stretch->carrier->body;
    }
    return !silent.empty();
  };
  std::set<std::pair<BodyId, BodyId>> undecided;
  for (const WorldContact& contact : step.answer.contacts) {
    if (contact.a.link == kEveryLink && contact.time.us <= step.fromUs) {
      undecided.emplace(contact.a.body, contact.b.body);
    }
  }
  for (const auto& [link, other] : open_) {
    const BodyId a = numbers_.bodyOf(link);
    const BodyId b = other < 0 ? kStillScene : numbers_.bodyOf(other);
    bool isUnknown = isSilent(a) || undecided.count({a, b}) > 0;
    if (b != kStillScene) {
      isUnknown = isUnknown || isSilent(b) ||
                  isCarried(a, b, numbers_.linkOf(other), step.fromUs) ||
                  isCarried(b, a, numbers_.linkOf(link), step.fromUs);
    }
    if (!isUnknown) continue;
    LinkContact& seen = contacts_.emplace_back();  // undecided, free until 0
    seen.link = link;
    step_.rows.emplace_back().other = other;
  }
}

const std::vector<std::size_t>& WorldTouches::add(const WorldStep& step) {
  step_.step = step.window;
  step_.rows.clear();
  contacts_.clear();
  rowOf_.clear();
  const auto& contacts = step.answer.contacts;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (contacts[i].a.link == kEveryLink) continue;
    addRow(contacts[i], step);
    rowOf_.push_back(i);
  }
  addUnknown(step);
  for (std::size_t i = 0; i < contacts_.size(); ++i) step_.rows[i].contact = &contacts_[i];
  begunRows_.clear();
  tracker_.addStep(step_, ended_, begunRows_);
  begun_.clear();
  for (const std::size_t row : begunRows_) {
    begun_.push_back(rowOf_[row]);
    open_.emplace(contacts_[row].link, step_.rows[row].other);
  }
  keepEnded();
  return begun_;
}

void WorldTouches::keepEnded() {
  for (Touch& touch : ended_) {
    const auto open = open_.find({touch.link, touch.other});
    if (open != open_.end()) open_.erase(open);
    const bool isOwn =
        touch.other >= 0 && numbers_.bodyOf(touch.link) == numbers_.bodyOf(touch.other);
    ++(touch.other < 0 ? counts_.scene : isOwn ? counts_.own : counts_.bodies);
    counts_.missed += touch.isMissed ? 1 : 0;
    listed_.push_back(std::move(touch));
  }
  ended_.clear();
}

void WorldTouches::finish() {
  tracker_.breakOff(ended_);
  keepEnded();
  std::sort(listed_.begin(), listed_.end(), isListedBefore);
}

TouchSides WorldTouches::sidesOf(const TouchPair& touch) const {
  TouchSides sides;
  sides.a = numbers_.bodyOf(touch.link);
  sides.linkOfA = numbers_.linkOf(touch.link);
  if (touch.other < 0) return sides;
  sides.b = numbers_.bodyOf(touch.other);
  sides.linkOfB = numbers_.linkOf(touch.other);
  return sides;
}

}  // namespace foretouch::tools
