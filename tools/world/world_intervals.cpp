#include "tools/world/world_intervals.h"

#include <algorithm>
#include <utility>

#include "lss/index.h"

namespace foretouch::tools {
namespace {

template <typename TwoSided>
auto keyOf(const TwoSided& of, PartKind kind) {
  return std::make_tuple(of.a.body, of.a.link, of.b.body, of.b.link, of.object, kind);
}

WorldContact contactOf(const WorldEvent& event) {
  WorldContact contact;
  contact.a = event.a;
  contact.b = event.b;
  contact.verdict =
      event.kind == EventKind::StartsInside ? Verdict::StartsInContact : Verdict::Contact;
  contact.time = event.time;
  contact.separation = event.separation;
  contact.penetration = event.penetration;
  contact.nhat_BA_W = event.nhat_BA_W;
  contact.isAssumed = event.isAssumed;
  return contact;
}

}  // namespace

void WorldIntervals::add(const FollowedStretch& stretch) {
  for (const WorldEvent& event : stretch.contacts.events) {
    if (!isOfTrigger(world_, event)) ++counts_.ofContacts[slotOf(event.kind)];
  }
  addParts(stretch.contacts);
  for (const TriggerEvent& event : stretch.triggers.events) {
    ++counts_.ofTriggers[slotOf(event.kind)];
    addTriggerEvent(event);
  }
}

void WorldIntervals::addParts(const WorldEvents& contacts) {
  begun_.clear();
  left_.clear();
  for (const WorldEvent& event : contacts.events) {
    const Instant instant{keyOf(event, PartKind::Contact), event.time};
    if (event.kind == EventKind::Enter || event.kind == EventKind::StartsInside) {
      begun_.emplace(instant, &event);
    } else if (event.kind == EventKind::Leave && event.cause == LeaveCause::Apart) {
      left_.emplace(instant, &event);
    }
  }
  for (const WorldPart& part : contacts.parts) {
    if (isOfTrigger(world_, part)) continue;
    const PairKey key = keyOf(part, part.kind);
    ContactInterval interval;
    interval.part = part;
    interval.first.a = part.a;
    interval.first.b = part.b;
    interval.first.time = part.from;
    if (const auto begun = begun_.find({key, part.from}); begun != begun_.end()) {
      const WorldEvent& event = *begun->second;
      interval.startsInside = event.kind == EventKind::StartsInside;
      interval.first = contactOf(event);
      interval.strength = strengthOf(event);
    }
    if (const auto known = open_.find(key); known != open_.end()) {
      if (part.beganBefore) {
        interval = std::move(known->second);
        interval.part.to = part.to;
        interval.part.goesOn = part.goesOn;
        interval.part.isAssumed = interval.part.isAssumed || part.isAssumed;
      } else {
        close(std::move(known->second));
      }
      open_.erase(known);
    }
    if (interval.part.goesOn) {
      open_.emplace(key, std::move(interval));
    } else {
      close(std::move(interval));
    }
  }
}

void WorldIntervals::close(ContactInterval interval) {
  const Instant end{keyOf(interval.part, interval.part.kind), interval.part.to};
  interval.isLeft = !interval.part.goesOn && left_.count(end) != 0;
  contacts_.push_back(std::move(interval));
}

/// What begins ends whatever was before: "unresolved" where a body was inside is not a leave.
void WorldIntervals::addTriggerEvent(const TriggerEvent& event) {
  const FileBody& file = world_.file.bodies[slotOf(world_.triggers.body(event.trigger))];
  const StayKey key{event.trigger, event.body, file.trigger->byLink ? event.link : kEveryLink};
  const auto known = openStays_.find(key);
  if (known != openStays_.end()) {
    known->second.to = event.time;
    stays_.push_back(known->second);
    openStays_.erase(known);
  }
  if (event.kind == EventKind::Leave || event.kind == EventKind::UnresolvedTo) return;
  TriggerStay stay;
  stay.trigger = event.trigger;
  stay.body = event.body;
  stay.link = event.link;
  stay.isUnresolved = event.kind == EventKind::UnresolvedFrom;
  stay.isAssumed = event.isAssumed;
  stay.startsInside = event.kind == EventKind::StartsInside;
  stay.from = stay.to = event.time;
  openStays_.emplace(key, stay);
}

void WorldIntervals::finish(std::int64_t untilUs) {
  for (auto& [key, interval] : open_) contacts_.push_back(std::move(interval));
  open_.clear();
  for (auto& [key, stay] : openStays_) {
    stay.goesOn = true;
    stay.to = {untilUs, 0.0};
    stays_.push_back(stay);
  }
  openStays_.clear();
  std::sort(contacts_.begin(), contacts_.end(),
            [](const ContactInterval& x, const ContactInterval& y) {
              return std::make_pair(x.part.from, keyOf(x.part, x.part.kind)) <
                     std::make_pair(y.part.from, keyOf(y.part, y.part.kind));
            });
  std::sort(stays_.begin(), stays_.end(), [](const TriggerStay& x, const TriggerStay& y) {
    const auto of = [](const TriggerStay& stay) {
      return std::make_tuple(stay.from, stay.trigger, stay.body, stay.link, stay.isUnresolved);
    };
    return of(x) < of(y);
  });
}

}  // namespace foretouch::tools
