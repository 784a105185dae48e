#include "tools/world/world_event_lines.h"

#include <iterator>
#include <optional>

#include "lss/index.h"
#include "tools/json_line.h"
#include "tools/replay/results_writer.h"
#include "tools/world/world_results.h"

namespace foretouch::tools {
namespace {

bool isTold(EventKind kind) {
  return kind != EventKind::UnresolvedFrom && kind != EventKind::UnresolvedTo;
}

/// True if the event says where two are, at an instant.
bool isOfTwo(const WorldEvent& event) {
  return isTold(event.kind) && event.b.body != kEveryBody;
}

bool ends(EventKind kind) {
  return kind == EventKind::Leave || kind == EventKind::UnresolvedTo;
}

/// Writes which body it is. The object, if any, is b's, or a's where a is a mesh.
void writeWho(const LoadedWorld& world, const ContactSide& side, ObjectId object, JsonWriter& out) {
  if (side.body == kEveryBody) {
    out.field("everybody", true);
    return;
  }
  writeSide(world, {side.body, side.link}, out);
  const std::optional<Scene>& mesh = meshOf(world, side.body);
  if (object >= 0 && mesh) out.field("object", mesh->objectNames()[slotOf(object)]);
}

void writeEventSide(const LoadedWorld& world, const ContactSide& side, const WorldEvent& event,
                    JsonWriter& out) {
  if (isOfTwo(event)) return writeContactSide(world, side, true, out);
  out.beginObject();
  writeWho(world, side, event.object, out);
  out.endObject();
}

void writeContactFields(const WorldEvent& event, JsonWriter& out) {
  out.field("separation", event.separation);
  if (event.penetration > 0.0) out.field("penetration", event.penetration);
  out.field("normal", event.nhat_BA_W);
  out.field("velocity", event.velocity_W);
  writeStrength(strengthOf(event), out);
  out.key("points");
  out.beginArray();
  for (std::size_t i = 0; i < event.numPoints; ++i) {
    const EventPoint& point = event.points[i];
    out.beginObject();
    out.field("a", point.p_WA);
    out.field("b", point.p_WB);
    out.field("separation", point.separation);
    out.endObject();
  }
  out.endArray();
}

void write(const LoadedWorld& world, const WorldEvent& event, const char* cause, JsonWriter& out) {
  out.beginObject();
  out.field("event", toString(event.kind));
  writeInstant("time", event.time, out);
  if (ends(event.kind)) writeInstantObject("since", event.since, out);
  out.key("a");
  writeEventSide(world, event.a, event, out);
  out.key("b");
  writeEventSide(world, event.b, event, out);
  if (isOfTwo(event)) writeContactFields(event, out);
  if (!isTold(event.kind)) out.field("reason", toString(event.reason));
  if (event.kind == EventKind::Leave && event.cause != LeaveCause::Apart) {
    out.field("cause", event.cause == LeaveCause::NotAsked ? "not_asked" : "moved");
  }
  if (cause != nullptr) out.field("cause", cause);
  if (event.isAssumed) out.field("assumed", true);
  out.endObject();
}

/// Writes which volume it is, and what is in it.
void writeTriggerSides(const LoadedWorld& world, TriggerId trigger, const NamedSide& who,
                       JsonWriter& out) {
  out.field("trigger", world.nameOf(world.triggers.body(trigger)));
  writeObject("who", out, [&] { writeSide(world, who, out); });
}

void write(const LoadedWorld& world, const TriggerEvent& event, JsonWriter& out) {
  out.beginObject();
  out.field("event", toString(event.kind));
  writeInstant("time", event.time, out);
  if (ends(event.kind)) writeInstantObject("since", event.since, out);
  writeTriggerSides(world, event.trigger, {event.body, event.link}, out);
  if (event.isAssumed) out.field("assumed", true);
  out.endObject();
}

void writeTrigger(const LoadedWorld& world, TriggerId trigger, JsonWriter& out) {
  const FileBody& file = world.file.bodies[slotOf(world.triggers.body(trigger))];
  out.beginObject();
  out.field("name", file.name);
  out.field("made_of", madeOf(file.shape));
  if (const std::string path = fileOf(file.shape); !path.empty()) {
    writeFileName("file", path, out);
  }
  out.field("by_link", file.trigger->byLink);
  if (!file.trigger->watched.empty()) {
    writeObjects("watches", file.trigger->watched, out, [&](const FileWatch& watch) {
      out.field("body", watch.body);
      if (!watch.link.empty()) out.field("link", watch.link);
    });
  }
  out.endObject();
}

/// Writes how it begins and ends.
template <typename Interval>
void writeCourse(const Interval& of, bool startsInside, JsonWriter& out) {
  writeInstantObject("from", of.from, out);
  writeInstantObject("to", of.to, out);
  if (startsInside) out.field("starts_inside", true);
  if (of.goesOn) out.field("goes_on", true);
  if (of.isAssumed) out.field("assumed", true);
}

}  // namespace

void writeEventCounts(const char* name, const std::int64_t (&counts)[kNumEventKinds],
                      JsonWriter& out) {
  writeObject(name, out, [&] {
    for (std::size_t kind = 0; kind < kNumEventKinds; ++kind) {
      out.field(toString(static_cast<EventKind>(kind)), counts[kind]);
    }
  });
}

std::string eventLine(const LoadedWorld& world, const WorldEvent& event, const char* cause) {
  std::string text;
  JsonWriter out(text);
  write(world, event, cause, out);
  return text + "\n";
}

std::string eventsHeader(const LoadedWorld& world, std::int64_t fromUs,
                         std::optional<std::int64_t> untilUs) {
  std::string text;
  JsonWriter out(text);
  beginResults(out, "foretouch-events");
  writeWorldFields(world, out);
  out.field("from", LoadedWorld::secondsOf(fromUs));
  out.key("until");
  untilUs ? out.value(LoadedWorld::secondsOf(*untilUs)) : out.null();
  writeBodies(world, out);
  out.key("triggers");
  out.beginArray();
  const std::int32_t triggers = untilUs ? world.triggers.numTriggers() : 0;
  for (TriggerId trigger = 0; trigger < triggers; ++trigger) {
    writeTrigger(world, trigger, out);
  }
  out.endArray();
  out.endObject();
  return text + "\n";
}

std::string eventLines(const LoadedWorld& world, const FollowedStretch& stretch) {
  std::string text;
  const auto tellTrigger = [&](const TriggerEvent& event) {
    JsonWriter out(text);
    write(world, event, out);
    text += "\n";
  };
  const auto isBefore = [](const auto& x, const auto& y) {
    return std::tie(x.time, x.kind) < std::tie(y.time, y.kind);
  };
  auto trigger = stretch.triggers.events.begin();
  for (const WorldEvent& event : stretch.contacts.events) {
    for (; trigger != stretch.triggers.events.end() && isBefore(*trigger, event); ++trigger) {
      tellTrigger(*trigger);
    }
    if (!isOfTrigger(world, event)) text += eventLine(world, event);
  }
  for (; trigger != stretch.triggers.events.end(); ++trigger) tellTrigger(*trigger);
  return text;
}

void writeInterval(const LoadedWorld& world, const ContactInterval& interval, JsonWriter& out) {
  const WorldPart& part = interval.part;
  const bool isContact = part.kind == PartKind::Contact;
  out.field("kind", isContact ? "contact" : "unresolved");
  if (!isContact) out.field("reason", toString(part.reason));
  writeObject("a", out, [&] { writeWho(world, part.a, part.object, out); });
  writeObject("b", out, [&] { writeWho(world, part.b, part.object, out); });
  writeCourse(part, interval.startsInside, out);
}

void writeStay(const LoadedWorld& world, const TriggerStay& stay, JsonWriter& out) {
  out.field("kind", stay.isUnresolved ? "unresolved" : "inside");
  writeTriggerSides(world, stay.trigger, {stay.body, stay.link}, out);
  writeCourse(stay, stay.startsInside, out);
}

std::string intervalLines(const LoadedWorld& world, const WorldIntervals& intervals) {
  std::string text;
  const auto line = [&](const char* name, const auto& writeFields) {
    text += objectLine(name, writeFields);
  };
  for (const ContactInterval& interval : intervals.contacts()) {
    line("interval", [&](JsonWriter& out) { writeInterval(world, interval, out); });
  }
  for (const TriggerStay& stay : intervals.stays()) {
    line("stay", [&](JsonWriter& out) { writeStay(world, stay, out); });
  }
  line("summary", [&](JsonWriter& out) {
    writeEventCounts("events", intervals.counts().ofContacts, out);
    writeEventCounts("trigger_events", intervals.counts().ofTriggers, out);
    out.field("intervals", intervals.contacts().size());
    out.field("stays", intervals.stays().size());
  });
  return text;
}

}  // namespace foretouch::tools
