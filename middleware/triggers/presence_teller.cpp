#include "middleware/triggers/presence_teller.h"

#include <tuple>

namespace foretouch::internal {
namespace {

int rankOf(const TriggerEvent& event) {
  if (event.kind != EventKind::Leave && event.kind != EventKind::UnresolvedTo) return 1;
  return event.since < event.time ? 0 : 2;
}

}  // namespace

std::optional<ToldOpen> PresenceTeller::tell(std::optional<ToldOpen> open,
                                             const std::vector<PresenceSpan>& spans) {
  WorldTime until = from_;  // the end of what is open
  for (const PresenceSpan& span : spans) {
    const bool goesOn = open && open->presence == span.presence && !(until < span.from);
    if (!goesOn) {
      const bool wasUnresolved = open && open->presence == Presence::Unresolved;
      const bool isAtOnce = open && !(until < span.from);
      if (open) end(*open, until, isAtOnce && span.presence == Presence::Unresolved);
      open = begin(span, isAtOnce && wasUnresolved);
    }
    open->isAssumed = open->isAssumed || span.isAssumed;
    until = span.to;
  }
  if (open && until < to_) {
    end(*open, until, false);
    open.reset();
  }
  return open;
}

ToldOpen PresenceTeller::begin(const PresenceSpan& span, bool wasUnresolved) {
  const EventKind kind = span.presence == Presence::Unresolved ? EventKind::UnresolvedFrom
                         : span.isFirstKnown || wasUnresolved  ? EventKind::StartsInside
                                                               : EventKind::Enter;
  add(kind, span.from, span.from, span.isAssumed, span.link);
  return {span.presence, span.from, span.isAssumed, span.link};
}

/// An event that it becomes unresolved also says that it has ended.
void PresenceTeller::end(const ToldOpen& open, const WorldTime& time, bool becomesUnresolved) {
  if (open.presence == Presence::Unresolved) {
    add(EventKind::UnresolvedTo, time, open.since, open.isAssumed, open.link);
  } else if (!becomesUnresolved) {
    add(EventKind::Leave, time, open.since, open.isAssumed, open.link);
  }
}

void PresenceTeller::add(EventKind kind, const WorldTime& time, const WorldTime& since,
                         bool isAssumed, LinkId link) {
  events_.push_back({kind, std::get<0>(key_), std::get<1>(key_), link, time, since, isAssumed});
}

bool isEarlier(const TriggerEvent& x, const TriggerEvent& y) {
  if (!(x.time == y.time)) return x.time < y.time;
  const auto key = [](const TriggerEvent& event) {
    return std::make_tuple(rankOf(event), event.trigger, event.body, event.link);
  };
  return key(x) < key(y);
}

}  // namespace foretouch::internal
