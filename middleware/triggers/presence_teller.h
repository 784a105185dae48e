// middleware/triggers/presence_teller.h: what is reported of a body or link in a trigger: the
// events that follow from what it does in it. Not installed.
#pragma once

#include <optional>
#include <tuple>
#include <vector>

#include "middleware/triggers/link_presence.h"
#include "middleware/triggers/presence.h"
#include "middleware/triggers/trigger_event.h"

namespace foretouch::internal {

/// What a stretch reports on.
using ToldKey = std::tuple<TriggerId, BodyId, LinkId>;

/// What has begun and not ended.
struct ToldOpen {
  Presence presence = Presence::Inside;
  WorldTime since;
  bool isAssumed = false;
  LinkId link = 0;  // the one that made it begin
};

/// The events of one key in a stretch.
class PresenceTeller {
 public:
  PresenceTeller(const ToldKey& key, const Stretch& stretch, std::vector<TriggerEvent>& events)
      : key_(key), from_{stretch.fromUs, 0.0}, to_{stretch.toUs, 0.0}, events_(events) {}

  /// What is open at the end, from what was open at the begin. `spans` are united.
  std::optional<ToldOpen> tell(std::optional<ToldOpen> open,
                               const std::vector<PresenceSpan>& spans);

 private:
  ToldOpen begin(const PresenceSpan& span, bool wasUnresolved);
  void end(const ToldOpen& open, const WorldTime& time, bool becomesUnresolved);
  void add(EventKind kind, const WorldTime& time, const WorldTime& since, bool isAssumed,
           LinkId link);

  const ToldKey& key_;
  WorldTime from_, to_;
  std::vector<TriggerEvent>& events_;
};

/// By time; at one instant: what ends that began before, what begins, and what ends as it begins.
[[nodiscard]] bool isEarlier(const TriggerEvent& x, const TriggerEvent& y);

}  // namespace foretouch::internal
