#include "tools/stream/told_events.h"

#include <algorithm>

#include <fmt/format.h>

#include "articulated/quoted.h"
#include "assets/json_writer.h"
#include "lss/index.h"
#include "tools/json_line.h"
#include "tools/world/served_bodies.h"
#include "tools/world/world_event_lines.h"
#include "tools/world/world_results.h"

namespace foretouch::tools {
namespace {

/// Beyond so many bodies that the file does not know, forgets their names.
constexpr std::size_t kMostOthers = kMaxToldBodies;

/// A prop of which nothing is known.
LoadedBody bodyOfOneLink() {
  RawSkeleton raw;
  raw.joints.push_back({"body", kNoParent, Eigen::Vector3d::Zero(), Quaternion::Identity()});
  LoadedBody body;
  body.shape.skeleton = Skeleton::build(raw).value();
  return body;
}

bool isGone(const ToldEvent& told) {
  return told.cause == ToldCause::BodyGone;
}

}  // namespace

ToldEvents::ToldEvents(LoadedWorld world)
    : world_(std::move(world)),
      numOfFile_(world_.numBodies()),
      numShapes_(world_.bodies.size()),
      unheard_(bodyOfOneLink()) {}

/// The body for a number that the file does not have. Beyond kMostOthers the last one stands for
/// all others.
BodyId ToldEvents::otherOf(BodyNumber number) {
  const auto known = others_.find(number);
  if (known != others_.end()) return known->second;
  const bool isFull = others_.size() >= kMostOthers;
  const std::size_t place = world_.bodies.size() - (isFull ? 1 : 0);
  const auto id = static_cast<BodyId>(place);
  if (isFull) {
    world_.file.bodies[place].name = "another";
    return id;
  }
  world_.file.bodies.emplace_back().name = fmt::format("#{}", number);
  world_.bodies.push_back(unheard_);
  others_.emplace(number, id);
  return id;
}

bool ToldEvents::isOfFile(BodyNumber number) const {
  return number >= 1 && static_cast<std::size_t>(number) <= numOfFile_ &&
         others_.count(number) == 0;
}

void ToldEvents::take(const BodyMessage& message) {
  const std::vector<FileBody>& bodies = world_.file.bodies;
  const std::size_t place = static_cast<std::size_t>(message.body) - 1;
  if (isOfFile(message.body) && bodies[place].name == message.shape) return;
  const BodyId id = otherOf(message.body);
  world_.file.bodies[slotOf(id)].name = fmt::format("{}#{}", message.shape, message.body);
  for (std::size_t i = 0; i < numShapes_; ++i) {
    if (bodies[i].name == message.shape) world_.bodies[slotOf(id)].shape = world_.bodies[i].shape;
  }
}

BodyId ToldEvents::bodyOf(BodyNumber number) {
  if (number < 0) return number;  // the scene, all bodies
  return isOfFile(number) ? static_cast<BodyId>(number - 1) : otherOf(number);
}

/// What a message says may be of no use: nothing is looked up that is not there.
ContactSide ToldEvents::sideOf(const ContactSide& told) {
  ContactSide side = told;
  side.body = bodyOf(told.body);
  const LinkId links =
      side.body < 0 ? 0 : world_.bodies[slotOf(side.body)].shape.skeleton.numJoints();
  if (side.link < 0 || side.link >= links) side.link = kEveryLink;
  if (side.body == kEveryBody) return side;
  const std::optional<Scene>& mesh = meshOf(world_, side.body);
  if (side.triangle >= 0 && mesh && slotOf(side.triangle) >= mesh->numTriangles()) {
    side.triangle = -1;
  }
  return side;
}

/// Looks nothing up for a side that is not a mesh.
bool ToldEvents::hasObject(BodyId body, ObjectId object) const {
  if (body == kEveryBody || object < 0) return true;
  const std::optional<Scene>& mesh = meshOf(world_, body);
  return !mesh || slotOf(object) < mesh->objectNames().size();
}

std::string ToldEvents::nameOf(BodyId body, LinkId link) const {
  if (body == kStillScene) return "the scene";
  if (body == kEveryBody) return "everybody";
  const std::string name = link == kEveryLink ? "" : world_.linkNameOf(body, link);
  return inQuotes(world_.nameOf(body)) + (name.empty() ? "" : " " + name);
}

std::string ToldEvents::textOf(const ToldEvent& told, const WorldEvent& event) const {
  const std::string a = nameOf(event.a.body, event.a.link), b = nameOf(event.b.body, event.b.link);
  const double lastedS = LoadedWorld::secondsOf(event.time) - LoadedWorld::secondsOf(event.since);
  std::string text = fmt::format("{:.6f} s: ", LoadedWorld::secondsOf(event.time));
  if (isGone(told)) return text + a + " is gone\n";
  switch (event.kind) {
    case EventKind::Enter:
      text += fmt::format("{} touches {}, at {:.2f} m/s", a, b, event.approachSpeed);
      break;
    case EventKind::StartsInside: text += fmt::format("{} is in {}", a, b); break;
    case EventKind::Leave: text += fmt::format("{} leaves {} after {:.3f} s", a, b, lastedS); break;
    case EventKind::UnresolvedFrom:
      text += fmt::format("whether {} touches {} is not known from here on ({})", a, b,
                          toString(event.reason));
      break;
    case EventKind::UnresolvedTo:
      text += fmt::format("whether {} touches {} is known again", a, b);
      break;
  }
  return text + (event.isAssumed ? " (assumed)\n" : "\n");
}

void ToldEvents::tellUnknown(const UnknownPart& part, std::string& json) {
  ContactSide of;
  of.body = part.body;
  of.link = part.link;
  of.triangle = -1;
  const ContactSide side = sideOf(of);
  json += objectLine("unknown", [&](JsonWriter& out) {
    if (side.body == kEveryBody) {
      out.field("everybody", true);
    } else {
      writeSide(world_, {side.body, side.link}, out);
    }
    out.field("reason", toString(part.reason));
    writeInstantObject("from", {part.fromUs, 0.0}, out);
    writeInstantObject("to", {part.toUs, 0.0}, out);
  });
}

/// Reports for people only where it changes.
void ToldEvents::tellNews(const std::set<LinkOfBody>& unknown, std::string& text) {
  for (const auto& [body, link] : unknown) {
    if (unknown_.count({body, link}) == 0) text += nameOf(body, link) + " is not known now\n";
  }
  for (const auto& [body, link] : unknown_) {
    if (unknown.count({body, link}) == 0) text += nameOf(body, link) + " is known again\n";
  }
}

/// The header for the bodies of the file alone.
std::string ToldEvents::headerFrom(std::int64_t fromUs) {
  std::vector<LoadedBody> others(world_.bodies.begin() + static_cast<std::ptrdiff_t>(numShapes_),
                                 world_.bodies.end());
  world_.bodies.resize(numShapes_, unheard_);
  std::string header = eventsHeader(world_, fromUs, std::nullopt);
  for (LoadedBody& other : others) world_.bodies.push_back(std::move(other));
  return header;
}

ToldEvents::Lines ToldEvents::take(const EventsMessage& message) {
  Lines lines;
  const bool isFirst = !sequence_.has_value();
  if (isFirst) lines.json = headerFrom(message.fromUs);
  const bool isOther = timeline_ && *timeline_ != message.timeline;
  const bool isMissing = sequence_ && message.sequence != *sequence_ + 1;
  // They may have been of the last window, and of this one.
  const std::int64_t lostUs = hadMore_ ? fromUs_ : toUs_;
  if (isMissing && lostUs < message.toUs) {
    lines.missing =
        fmt::format("events between {:.6f} s and {:.6f} s did not arrive",
                    LoadedWorld::secondsOf(lostUs), LoadedWorld::secondsOf(message.toUs));
    tellUnknown({kEveryBody, kEveryLink, UndecidedReason::Gap, lostUs, message.toUs}, lines.json);
  }
  if (isOther) {
    lines.json += objectLine("timeline", [&](JsonWriter& out) {
      writeInstantObject("from", {message.fromUs, 0.0}, out);
    });
    lines.text += "all contacts begin anew\n";
  }
  // Several messages of one window repeat what is unknown.
  const bool isNewWindow = isFirst || isMissing || message.toUs != toUs_;
  std::set<LinkOfBody> unknown;
  for (const UnknownPart& part : message.unknown) {
    if (isNewWindow) tellUnknown(part, lines.json);
    ContactSide of;
    of.body = part.body;
    of.link = part.link;
    const ContactSide side = sideOf(of);
    if (part.toUs == message.toUs) unknown.insert({side.body, side.link});
  }
  tellNews(unknown, lines.text);
  unknown_ = std::move(unknown);
  for (const ToldEvent& told : message.events) {
    WorldEvent event = told.event;
    event.a = sideOf(event.a);
    event.b = sideOf(event.b);
    if (!hasObject(event.a.body, event.object) || !hasObject(event.b.body, event.object)) {
      event.object = -1;
    }
    lines.json += eventLine(world_, event, isGone(told) ? "body_gone" : nullptr);
    lines.text += textOf(told, event);
    ++counts_[static_cast<std::size_t>(event.kind)];
  }
  timeline_ = message.timeline;
  sequence_ = message.sequence;
  fromUs_ = message.fromUs;
  toUs_ = message.toUs;
  hadMore_ = message.hasMore;
  return lines;
}

std::string ToldEvents::summary() const {
  return objectLine("summary", [&](JsonWriter& out) { writeEventCounts("events", counts_, out); });
}

}  // namespace foretouch::tools
