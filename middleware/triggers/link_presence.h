// middleware/triggers/link_presence.h: what each link of a body does in a trigger through a stretch
// of world time: the parts in which the two are in contact, or unresolved, and in between, whether
// it is inside. Not installed.
#pragma once

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "middleware/depth/body_places.h"
#include "middleware/events/world_event.h"
#include "middleware/triggers/body_breaks.h"
#include "middleware/triggers/presence.h"
#include "middleware/triggers/trigger_event.h"
#include "middleware/triggers/volume_parts.h"
#include "middleware/world/world_parts.h"

namespace foretouch::internal {

/// Two bodies, one of them a trigger, in a stretch.
struct TriggerPair {
  TriggerId trigger = 0;
  BodyId ofTrigger = 0, body = 0;
  const VolumeParts* volume = nullptr;
  LinkId watchedLink = kEveryLink;
  std::vector<WorldPart> parts;    ///< Theirs: `a` is the body's side, `b` the trigger's.
  std::vector<std::int64_t> cuts;  ///< Of both, in order: see BodyBreaks.
  std::vector<Stretch> silences;   ///< Of both.
};

/// For one thread. Keeps what each link does where a stretch ends.
class LinkPresence {
 public:
  void begin(const WorldParts& world, const Stretch& stretch);
  /// Whether something is kept of the two.
  [[nodiscard]] bool isKept(TriggerId trigger, BodyId body) const;
  /// Appends what the links do that are watched. Those of the stretch before must have been asked.
  void append(const TriggerPair& pair, std::vector<PresenceSpan>& spans);

  [[nodiscard]] const TriggerCounters& counters() const { return counters_; }

 private:
  /// How a link ends a stretch, unless it is outside.
  enum class End : std::uint8_t { Inside, Touching, Unresolved };
  using Key = std::tuple<TriggerId, BodyId, LinkId>;
  /// A time in which nothing touches.
  struct Gap {
    WorldTime from, to;
    bool isNew = false;  // it begins at a cut
  };

  void appendLink(const TriggerPair& pair, LinkId link, std::vector<PresenceSpan>& spans);
  void appendParts(const TriggerPair& pair, LinkId link);
  void findGaps(const TriggerPair& pair);
  [[nodiscard]] Presence presenceIn(const TriggerPair& pair, LinkId link, const Gap& gap);
  [[nodiscard]] bool isAssumedIn(const TriggerPair& pair, const Gap& gap);
  [[nodiscard]] Presence decide(const TriggerPair& pair, LinkId link, const WorldTime& time);
  [[nodiscard]] bool isCarriedBy(const TriggerPair& pair, LinkId link, std::int64_t us) const;
  void findPieces(BodyId body, LinkId link);
  void keep(const Key& key, const std::vector<PresenceSpan>& spans, std::size_t first,
            bool isTouching);

  const WorldParts* world_ = nullptr;
  Stretch stretch_;
  std::map<Key, End> ends_;
  TriggerCounters counters_;
  std::vector<PresenceSpan> touching_;  // one link's, by time
  std::vector<Gap> gaps_;
  BodyPlaces bodies_;
  std::vector<LinkPlace> ofTrigger_, ofBody_;
  std::vector<Lss> pieces_;  // of the link's surface: their axes hold a point of each
  ClosedMesh::Memory memory_;
};

}  // namespace foretouch::internal
