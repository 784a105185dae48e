// tools/world/world_intervals.h: what a followed world reports, as intervals: from when to when two
// touch, or a body is in a trigger.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "tools/touches/touch_strength.h"
#include "tools/world/followed_world.h"

namespace foretouch::tools {

/// Between two links, or a link and an object of a mesh or of the scene; never a trigger.
struct ContactInterval {
  WorldPart part;             ///< `goesOn`: until the end of what was followed.
  bool startsInside = false;  ///< No touch was seen: they are known to be in contact first.
  bool isLeft = false;        ///< It ends with a leave, and the two are apart: proven.
  // For a contact:
  WorldContact first;  ///< As it begins.
  TouchStrength strength;
};

/// The stay of a body in a trigger, or a time in which nothing is known of it there.
struct TriggerStay {
  TriggerId trigger = 0;
  BodyId body = 0;
  LinkId link = kEveryLink;  ///< The link whose entering it begins with.
  bool isUnresolved = false;
  bool isAssumed = false;
  bool startsInside = false;  ///< As in ContactInterval.
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
  /// Call after the last one, which ended there.
  void finish(std::int64_t untilUs);

  /// The contacts after finish(), by begin, then by pair.
  [[nodiscard]] const std::vector<ContactInterval>& contacts() const { return contacts_; }
  [[nodiscard]] const std::vector<TriggerStay>& stays() const { return stays_; }
  [[nodiscard]] const EventCounts& counts() const { return counts_; }

 private:
  using PairKey = std::tuple<BodyId, LinkId, BodyId, LinkId, ObjectId, PartKind>;
  using Instant = std::pair<PairKey, WorldTime>;
  using StayKey = std::tuple<TriggerId, BodyId, LinkId>;
  void addParts(const WorldEvents& contacts);
  void close(ContactInterval interval);
  void addTriggerEvent(const TriggerEvent& event);

  const LoadedWorld& world_;
  std::map<PairKey, ContactInterval> open_;
  std::map<Instant, const WorldEvent*> begun_, left_;  // of the stretch that is being added
  std::map<StayKey, TriggerStay> openStays_;
  std::vector<ContactInterval> contacts_;
  std::vector<TriggerStay> stays_;
  EventCounts counts_;
};

}  // namespace foretouch::tools
