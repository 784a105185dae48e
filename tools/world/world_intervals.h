// tools/world/world_intervals.h: what a followed world tells, as intervals: from when to when two
// touch, and somebody is in a trigger.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "tools/world/followed_world.h"

namespace foretouch::tools {

/// Of two links, or a link and an object of a mesh or of the scene; never of a trigger.
struct ContactInterval {
  WorldPart part;             ///< `goesOn`: until the end of what was followed.
  bool startsInside = false;  ///< No touch was seen: they are known to be in contact first.
};

/// Of somebody in a trigger, or of whom nothing is known there.
struct TriggerStay {
  TriggerId trigger = 0;
  BodyId body = 0;
  LinkId link = kEveryLink;  ///< Whose entering it begins with.
  bool isUnresolved = false;
  bool isAssumed = false;
  bool startsInside = false;  ///< As ContactInterval's.
  bool goesOn = false;        ///< To the end of what was followed.
  WorldTime from, to;
};

struct EventCounts {
  std::int64_t ofContacts[kNumEventKinds] = {};
  std::int64_t ofTriggers[kNumEventKinds] = {};
};

class WorldIntervals {
 public:
  /// `world` outlives it.
  explicit WorldIntervals(const LoadedWorld& world) : world_(world) {}

  /// Stretches in order.
  void add(const FollowedStretch& stretch);
  /// After the last one, which ended there.
  void finish(std::int64_t untilUs);

  /// After finish(): by begin, then by pair.
  [[nodiscard]] const std::vector<ContactInterval>& contacts() const { return contacts_; }
  [[nodiscard]] const std::vector<TriggerStay>& stays() const { return stays_; }
  [[nodiscard]] const EventCounts& counts() const { return counts_; }

 private:
  using PairKey = std::tuple<BodyId, LinkId, BodyId, LinkId, ObjectId, PartKind>;
  using StayKey = std::tuple<TriggerId, BodyId, LinkId>;
  void addParts(const WorldEvents& contacts);
  void addTriggerEvent(const TriggerEvent& event);

  const LoadedWorld& world_;
  std::map<PairKey, ContactInterval> open_;
  std::map<StayKey, TriggerStay> openStays_;
  std::vector<ContactInterval> contacts_;
  std::vector<TriggerStay> stays_;
  EventCounts counts_;
};

}  // namespace foretouch::tools
