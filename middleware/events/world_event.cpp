#include "middleware/events/world_event.h"

#include <tuple>

namespace foretouch {

const char* toString(EventKind kind) {
  switch (kind) {
    case EventKind::Leave: return "leave";
    case EventKind::UnresolvedTo: return "unresolved_to";
    case EventKind::StartsInside: return "starts_inside";
    case EventKind::Enter: return "enter";
    case EventKind::UnresolvedFrom: return "unresolved_from";
  }
  return "enter";
}

bool comesBefore(const WorldEvent& x, const WorldEvent& y) {
  if (!(x.time == y.time)) return x.time < y.time;
  const auto key = [](const WorldEvent& event) {
    return std::make_tuple(event.kind, event.a.body, event.a.link, event.b.body, event.b.link,
                           event.object);
  };
  return key(x) < key(y);
}

void EventCounters::add(const EventCounters& more) {
  windows += more.windows;
  contacts += more.contacts;
  stretches += more.stretches;
  contactLooks += more.contactLooks;
  freeLooks += more.freeLooks;
  pairs += more.pairs;
}

}  // namespace foretouch
