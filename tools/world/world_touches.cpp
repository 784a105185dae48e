#include "tools/world/world_touches.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include "lss/index.h"

namespace foretouch::tools {
namespace {

/// The share of the window in [0,1], as steps of one avatar have it.
double shareOfWindow(const WorldTime& time, const WorldStep& step) {
  return std::clamp(
      microsecondsAfter(step.fromUs, time) / static_cast<double>(step.toUs - step.fromUs), 0.0,
      1.0);
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

WorldTouches::WorldTouches(const LoadedWorld& world, const WorldIntervals* followed)
    : world_(world), followed_(followed), numbers_(world), tracker_(TouchScope::FirstOfLink) {
  if (followed != nullptr) takeIntervals();
}

void WorldTouches::takeIntervals() {
  for (const ContactInterval& interval : followed_->contacts()) {
    if (interval.part.kind != PartKind::Contact) continue;
    WorldTouch& touch = listed_.emplace_back();
    touch.first = interval.first;
    touch.strength = interval.strength;
    touch.until = interval.part.to;
    touch.link = numbers_.of(touch.first.a);
    if (touch.first.b.body != kStillScene) touch.other = numbers_.of(touch.first.b);
    touch.object = objectOf(touch.first);
    touch.beginsInside = interval.startsInside;
    touch.isOpen = !interval.isLeft;
    touch.beginS = LoadedWorld::secondsOf(interval.part.from);
    touch.endS = LoadedWorld::secondsOf(interval.part.to);
    touch.contacts = 1;
    touch.separation = touch.first.separation;
    touch.penetration = touch.first.penetration;
    touch.startsAtAPose = interval.startsInside;
    placesOf_[pairOf(touch.first)].push_back(listed_.size() - 1);
  }
}

std::string WorldTouches::objectOf(const WorldContact& contact) const {
  if (contact.b.body != kStillScene || contact.b.triangle < 0) return {};
  return world_.scene->objectNames()[slotOf(world_.scene->object(contact.b.triangle))];
}

WorldTouches::PairKey WorldTouches::pairOf(const WorldContact& contact) const {
  const auto objectOn = [&](const ContactSide& side) -> ObjectId {
    if (side.triangle < 0) return -1;
    const std::optional<Scene>& mesh =
        side.body == kStillScene ? world_.scene : world_.bodies[slotOf(side.body)].shape.mesh;
    return mesh ? mesh->object(side.triangle) : -1;
  };
  return {numbers_.of(contact.a), contact.b.body, contact.b.link,
          std::max(objectOn(contact.a), objectOn(contact.b))};
}

/// What touches where a window begins does so in an interval of the two: all of those are known.
void WorldTouches::addFollowed(const WorldStep& step) {
  if (cuts_.empty()) cuts_.push_back(step.fromUs);
  cuts_.push_back(step.toUs);
  for (const WorldContact& contact : step.answer.contacts) {
    if (contact.verdict != Verdict::StartsInContact) continue;
    const auto places = placesOf_.find(pairOf(contact));
    if (places == placesOf_.end()) continue;  // then it is unresolved
    const auto after = std::upper_bound(
        places->second.begin(), places->second.end(), contact.time,
        [&](const WorldTime& time, std::size_t place) { return time < listed_[place].first.time; });
    if (after == places->second.begin()) continue;
    WorldTouch& touch = listed_[*std::prev(after)];
    if (touch.until < contact.time) continue;
    // Where it starts inside, a window starts, too.
    if (contact.time == touch.first.time) continue;
    ++touch.contacts;
    touch.startsAtAPose = true;
    touch.separation = std::min(touch.separation, contact.separation);
    touch.penetration = std::max(touch.penetration, contact.penetration);
  }
}

/// A check where windows begin and end misses the touch if no such instant is within it.
void WorldTouches::placeInWindows(WorldTouch& touch) const {
  const auto isBefore = [](const WorldTime& time, std::int64_t us) {
    return time < WorldTime{us, 0.0};
  };
  const auto last = static_cast<std::int64_t>(cuts_.size()) - 2;
  const auto begin = std::upper_bound(cuts_.begin(), cuts_.end(), touch.first.time, isBefore);
  const auto end = std::upper_bound(begin, cuts_.end(), touch.until, isBefore);
  const auto windowBefore = [&](auto place) {
    return std::clamp<std::int64_t>(place - cuts_.begin() - 1, 0, last);
  };
  touch.firstStep = windowBefore(begin);
  touch.lastStep = windowBefore(end);
  const bool beginsAtACut =
      begin != cuts_.begin() && WorldTime{*std::prev(begin), 0.0} == touch.first.time;
  touch.isMissed = !beginsAtACut && begin == end;
}

void WorldTouches::addRow(const WorldContact& contact, const WorldStep& step) {
  LinkContact& seen = contacts_.emplace_back();
  seen.link = numbers_.of(contact.a);
  seen.verdict = contact.verdict;
  seen.toi = seen.freeUntil = shareOfWindow(contact.time, step);
  seen.separation = contact.separation;
  seen.penetration = contact.penetration;
  TouchRow& row = step_.rows.emplace_back();
  row.timeS = LoadedWorld::secondsOf(contact.time);
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

/// What is under way, and about which the window says nothing, is not known to end: for bodies that
/// are silent or undecided as a whole, and for two of which one carries the other now.
void WorldTouches::addUnknown(const WorldStep& step) {
  std::set<BodyId> silent;
  for (const SilentBody& one : step.answer.silent) {
    if (one.takenTo == WhenSilent::Undecided && one.sinceUs <= step.fromUs) silent.insert(one.body);
  }
  // Nothing is known of what a silent body carries, either.
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
  for (const auto& [key, first] : open_) {
    const auto& [link, other, object] = key;
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

void WorldTouches::add(const WorldStep& step) {
  followed_ != nullptr ? addFollowed(step) : addAsked(step);
}

void WorldTouches::addAsked(const WorldStep& step) {
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
  keepEnded();
  for (const std::size_t row : begunRows_) {
    const TouchRow& begun = step_.rows[row];
    open_.emplace(Key{contacts_[row].link, begun.other, std::string(begun.object)},
                  contacts[rowOf_[row]]);
  }
}

void WorldTouches::keepEnded() {
  for (Touch& ended : ended_) {
    WorldTouch& touch = listed_.emplace_back();
    static_cast<Touch&>(touch) = std::move(ended);
    const auto open = open_.find({touch.link, touch.other, touch.object});
    if (open == open_.end()) continue;
    touch.first = open->second;
    open_.erase(open);
  }
  ended_.clear();
}

void WorldTouches::count(const Touch& touch) {
  const bool isOwn =
      touch.other >= 0 && numbers_.bodyOf(touch.link) == numbers_.bodyOf(touch.other);
  ++(touch.other < 0 ? counts_.scene : isOwn ? counts_.own : counts_.bodies);
  counts_.missed += touch.isMissed ? 1 : 0;
}

void WorldTouches::finish() {
  tracker_.breakOff(ended_);
  keepEnded();
  if (cuts_.size() > 1) {
    for (WorldTouch& touch : listed_) placeInWindows(touch);
  }
  for (const WorldTouch& touch : listed_) count(touch);
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
