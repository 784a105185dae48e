#include "middleware/triggers/triggers.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "articulated/try.h"
#include "lss/assert.h"
#include "lss/index.h"
#include "middleware/triggers/link_presence.h"
#include "middleware/triggers/presence.h"
#include "middleware/triggers/presence_teller.h"
#include "middleware/world/world_parts.h"

namespace foretouch {

namespace {

using internal::LinkPresence;
using internal::Presence;
using internal::PresenceSpan;
using internal::PresenceTeller;
using internal::Stretch;
using internal::ToldKey;
using internal::ToldOpen;
using internal::TriggerPair;
using internal::WorldParts;

struct Record {
  BodyId body = 0;
  TriggerVolume volume;
  TriggerOptions options;
  bool isNew = true;        // not updated yet
  std::uint32_t asked = 0;  // bit per group, in the last stretch
};

}  // namespace

struct Triggers::Parts {
  std::uint64_t world = 0;  // the one that they are in; 0: none yet
  std::vector<Record> records;
  std::vector<TriggerId> triggerOf;  // by body
  bool hasBegun = false;
  std::int64_t followedUs = 0;
  internal::BodyBreaks breaks;
  LinkPresence links;
  std::map<ToldKey, ToldOpen> open;
  std::vector<Occupant> occupants;
  // While updating.
  std::map<std::pair<TriggerId, BodyId>, std::vector<WorldPart>> parts;
  TriggerPair pair;
  std::vector<PresenceSpan> spans, ofLink, memory;

  [[nodiscard]] TriggerId find(BodyId body) const {
    const bool isOne = body >= 0 && slotOf(body) < triggerOf.size();
    return isOne ? triggerOf[slotOf(body)] : -1;
  }
  Result<Done> checkedWorld(const WorldParts& asked) const;
  Result<Done> checkedTrigger(TriggerId trigger) const;
  void sortParts(const WorldParts& of, const std::vector<WorldPart>& given);
  void addPart(const WorldParts& of, TriggerId trigger, const ContactSide& other, WorldPart part);
  void askAll(const WorldParts& of, const Stretch& stretch, std::vector<TriggerEvent>& events);
  void ask(const WorldParts& of, TriggerId trigger, BodyId body, const Stretch& stretch,
           std::vector<TriggerEvent>& events);
  bool fillPair();
  void tell(TriggerId trigger, BodyId body, const Stretch& stretch,
            std::vector<TriggerEvent>& events);
  void tellOne(const ToldKey& key, std::vector<PresenceSpan>& of, const Stretch& stretch,
               std::vector<TriggerEvent>& events);
  void listOccupants();
};

Result<Done> Triggers::Parts::checkedWorld(const WorldParts& asked) const {
  if (world == 0 || world == asked.identity) return Done{};
  return Error::of(ErrorCode::Mismatch, "expected the world that the triggers were added to");
}

Result<Done> Triggers::Parts::checkedTrigger(TriggerId trigger) const {
  if (trigger >= 0 && slotOf(trigger) < records.size()) return Done{};
  return Error::at(trigger, ErrorCode::UnknownName,
                   "expected one of " + std::to_string(records.size()) + " triggers, found " +
                       std::to_string(trigger));
}

namespace {

/// The link that a trigger looks at; nothing if it does not look at the body at all.
std::optional<LinkId> watchedLinkOf(const Record& record, BodyId body, bool isTrigger) {
  if (record.options.watched.empty()) {
    return isTrigger ? std::nullopt : std::optional<LinkId>(kEveryLink);
  }
  std::optional<LinkId> found;
  for (const Watched& watched : record.options.watched) {
    if (watched.body != body) continue;
    found = found && *found != watched.link ? kEveryLink : watched.link;
  }
  return found;
}

Result<Done> checkedWatched(const World& world, const Watched& watched) {
  const bool isBody = watched.body >= 0 && watched.body < world.numBodies();
  const std::int32_t links = isBody ? world.parts().kindOf(watched.body).skeleton.numJoints() : 0;
  if (isBody && (watched.link == kEveryLink || (watched.link >= 0 && watched.link < links))) {
    return Done{};
  }
  return Error::at(watched.body, ErrorCode::UnknownName,
                   "watched: expected a body that was added and a link of it, found body " +
                       std::to_string(watched.body) + ", link " + std::to_string(watched.link));
}

bool isWatched(const Record& record, BodyId body, LinkId link) {
  if (record.options.watched.empty()) return true;
  return std::any_of(
      record.options.watched.begin(), record.options.watched.end(), [&](const Watched& watched) {
        return watched.body == body && (watched.link == kEveryLink || watched.link == link);
      });
}

}  // namespace

/// A whole body that is silent is so for every trigger; a trigger, for every body.
void Triggers::Parts::sortParts(const WorldParts& of, const std::vector<WorldPart>& given) {
  parts.clear();
  for (const WorldPart& part : given) {
    const TriggerId one = find(part.a.body), other = find(part.b.body);
    if (part.b.body == kEveryBody) {
      for (std::size_t t = 0; t < records.size(); ++t) {
        if (records[t].body != part.a.body) addPart(of, static_cast<TriggerId>(t), part.a, part);
      }
      for (BodyId body = 0; one >= 0 && body < static_cast<BodyId>(of.bodies.size()); ++body) {
        ContactSide everything;
        everything.body = body;
        everything.link = kEveryLink;
        if (body != part.a.body) addPart(of, one, everything, part);
      }
      continue;
    }
    if (one >= 0) addPart(of, one, part.b, part);
    if (other >= 0) addPart(of, other, part.a, part);
  }
}

void Triggers::Parts::addPart(const WorldParts& of, TriggerId trigger, const ContactSide& other,
                              WorldPart part) {
  if (other.body < 0 || !of.isAsked(records[slotOf(trigger)].body, other.body)) return;
  part.a = other;
  part.b = {};
  part.b.body = records[slotOf(trigger)].body;
  parts[{trigger, other.body}].push_back(part);
}

void Triggers::Parts::askAll(const WorldParts& of, const Stretch& stretch,
                             std::vector<TriggerEvent>& events) {
  for (std::size_t t = 0; t < records.size(); ++t) {
    Record& record = records[t];
    const std::uint32_t before = record.asked;
    record.asked = 0;
    for (BodyId body = 0; body < static_cast<BodyId>(of.bodies.size()); ++body) {
      if (body == record.body) continue;
      const std::uint32_t bit = 1U << static_cast<unsigned>(of.body(body).options.group);
      const bool isAsked = of.isAsked(record.body, body);
      if (isAsked) record.asked |= bit;
      pair.cuts.clear();
      if (record.isNew || (isAsked && (before & bit) == 0)) pair.cuts.push_back(stretch.fromUs);
      ask(of, static_cast<TriggerId>(t), body, stretch, events);
    }
    record.isNew = false;
  }
}

void Triggers::Parts::ask(const WorldParts& of, TriggerId trigger, BodyId body,
                          const Stretch& stretch, std::vector<TriggerEvent>& events) {
  const Record& record = records[slotOf(trigger)];
  const auto link = watchedLinkOf(record, body, find(body) >= 0);
  spans.clear();
  if (link && of.isAsked(record.body, body)) {
    pair.trigger = trigger;
    pair.ofTrigger = record.body;
    pair.body = body;
    pair.volume = &record.volume.parts();
    pair.watchedLink = *link;
    if (!fillPair() && !links.isKept(trigger, body)) return;
    links.append(pair, spans);
    spans.erase(std::remove_if(
                    spans.begin(), spans.end(),
                    [&](const PresenceSpan& span) { return !isWatched(record, body, span.link); }),
                spans.end());
  }
  tell(trigger, body, stretch, events);
}

/// Whether the two do something, or what is known of them breaks off.
bool Triggers::Parts::fillPair() {
  const auto own = parts.find({pair.trigger, pair.body});
  pair.parts.clear();
  if (own != parts.end()) pair.parts = own->second;
  pair.silences.clear();
  for (const BodyId one : {pair.ofTrigger, pair.body}) {
    const std::vector<std::int64_t>& cuts = breaks.cuts(one);
    const std::vector<Stretch>& silences = breaks.silences(one);
    pair.cuts.insert(pair.cuts.end(), cuts.begin(), cuts.end());
    pair.silences.insert(pair.silences.end(), silences.begin(), silences.end());
  }
  std::sort(pair.cuts.begin(), pair.cuts.end());
  pair.cuts.erase(std::unique(pair.cuts.begin(), pair.cuts.end()), pair.cuts.end());
  return !pair.parts.empty() || !pair.cuts.empty() || !pair.silences.empty();
}

/// Reports on the body as one, or on its links.
void Triggers::Parts::tell(TriggerId trigger, BodyId body, const Stretch& stretch,
                           std::vector<TriggerEvent>& events) {
  if (!records[slotOf(trigger)].options.byLink) {
    tellOne({trigger, body, kEveryLink}, spans, stretch, events);
    return;
  }
  std::vector<LinkId> told;
  for (const PresenceSpan& span : spans) told.push_back(span.link);
  for (auto known = open.lower_bound({trigger, body, kEveryLink}); known != open.end(); ++known) {
    const auto& [ofTrigger, ofBody, link] = known->first;
    if (ofTrigger != trigger || ofBody != body) break;
    told.push_back(link);
  }
  std::sort(told.begin(), told.end());
  told.erase(std::unique(told.begin(), told.end()), told.end());
  for (const LinkId link : told) {
    ofLink.clear();
    std::copy_if(spans.begin(), spans.end(), std::back_inserter(ofLink),
                 [&](const PresenceSpan& span) { return span.link == link; });
    tellOne({trigger, body, link}, ofLink, stretch, events);
  }
}

void Triggers::Parts::tellOne(const ToldKey& key, std::vector<PresenceSpan>& of,
                              const Stretch& stretch, std::vector<TriggerEvent>& events) {
  const auto known = open.find(key);
  std::optional<ToldOpen> now;
  if (known != open.end()) now = known->second;
  internal::unite(of, memory);
  now = PresenceTeller(key, stretch, events).tell(now, of);
  if (now) {
    open[key] = *now;
  } else if (known != open.end()) {
    open.erase(known);
  }
}

void Triggers::Parts::listOccupants() {
  occupants.clear();
  for (const auto& [key, one] : open) {
    const auto& [trigger, body, link] = key;
    occupants.push_back({trigger, body, link, one.presence == Presence::Unresolved, one.since});
  }
}

Triggers::Triggers() : parts_(std::make_unique<Parts>()) {}
Triggers::~Triggers() = default;
Triggers::Triggers(Triggers&&) noexcept = default;
Triggers& Triggers::operator=(Triggers&&) noexcept = default;

Result<TriggerId> Triggers::add(World& world, const TriggerVolume& volume,
                                const TriggerOptions& options) {
  FORETOUCH_CHECK(parts_->checkedWorld(world.parts()));
  for (const Watched& watched : options.watched) FORETOUCH_CHECK(checkedWatched(world, watched));
  BodyOptions ofBody;
  ofBody.group = options.group;
  ofBody.whenSilent = options.whenSilent;
  ofBody.isVolume = true;
  const auto& shape = volume.parts();
  FORETOUCH_TRY(const BodyId body, shape.solid ? world.add(*shape.solid, ofBody)
                                               : world.add(shape.mesh->scene(), ofBody));
  FORETOUCH_CHECK(world.ask(options.group, options.group, false));
  FORETOUCH_CHECK(world.askStill(options.group, false));
  const auto trigger = static_cast<TriggerId>(parts_->records.size());
  parts_->world = world.parts().identity;
  parts_->records.push_back({body, volume, options});
  parts_->triggerOf.resize(countOf(world.numBodies()), -1);
  parts_->triggerOf[slotOf(body)] = trigger;
  return trigger;
}

Result<Done> Triggers::watch(const World& world, TriggerId trigger, const Watched& watched) {
  FORETOUCH_CHECK(parts_->checkedWorld(world.parts()));
  FORETOUCH_CHECK(parts_->checkedTrigger(trigger));
  FORETOUCH_CHECK(checkedWatched(world, watched));
  Record& record = parts_->records[slotOf(trigger)];
  if (!record.isNew) {
    return Error::at(trigger, ErrorCode::OutOfRange,
                     "expected a trigger whose events were not told yet");
  }
  record.options.watched.push_back(watched);
  return Done{};
}

void Triggers::beginAnew() {
  parts_->hasBegun = false;
  parts_->links = {};
  parts_->breaks = {};
  parts_->open.clear();
  parts_->occupants.clear();
}

std::int32_t Triggers::numTriggers() const {
  return static_cast<std::int32_t>(parts_->records.size());
}

BodyId Triggers::body(TriggerId trigger) const {
  FORETOUCH_ASSERT(trigger >= 0 && trigger < numTriggers());
  return parts_->records[slotOf(trigger)].body;
}

TriggerId Triggers::triggerOf(BodyId body) const {
  return parts_->find(body);
}

Result<Done> Triggers::stand(World& world, TriggerId trigger, std::int64_t fromUs,
                             const RigidPose& pose) {
  FORETOUCH_CHECK(parts_->checkedWorld(world.parts()));
  FORETOUCH_CHECK(parts_->checkedTrigger(trigger));
  const BodyId body = this->body(trigger);
  FORETOUCH_CHECK(world.push(body, fromUs, pose));
  const std::int64_t untilUs = std::min(fromUs + kLongestPieceUs, kMostUtimeUs);
  return untilUs > fromUs ? world.push(body, untilUs, pose) : Result<Done>(Done{});
}

Result<Done> Triggers::update(const World& world, const WorldEvents& events,
                              TriggerEvents& answer) {
  const WorldParts& of = world.parts();
  FORETOUCH_CHECK(parts_->checkedWorld(of));
  answer.events.clear();
  answer.counters = {};
  const Stretch stretch{events.fromUs, events.toUs};
  if (parts_->hasBegun && stretch.fromUs != parts_->followedUs) {
    return Error::of(ErrorCode::Mismatch,
                     "expected the events from " + std::to_string(parts_->followedUs) +
                         " us on, found those from " + std::to_string(stretch.fromUs) + " us");
  }
  if (stretch.toUs <= stretch.fromUs) return Done{};
  parts_->world = of.identity;
  parts_->sortParts(of, events.parts);
  parts_->breaks.find(of, stretch);
  parts_->links.begin(of, stretch);
  parts_->askAll(of, stretch, answer.events);
  std::stable_sort(answer.events.begin(), answer.events.end(), internal::isEarlier);
  answer.counters = parts_->links.counters();
  parts_->hasBegun = true;
  parts_->followedUs = stretch.toUs;
  parts_->listOccupants();
  return Done{};
}

const std::vector<Occupant>& Triggers::occupants() const {
  return parts_->occupants;
}

}  // namespace foretouch
