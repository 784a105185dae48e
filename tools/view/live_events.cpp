#include "tools/view/live_events.h"

#include <cmath>
#include <memory>
#include <utility>

#include "network/wire/message_fields.h"
#include "tools/contact_json.h"
#include "tools/fields_json.h"
#include "tools/json_line.h"
#include "tools/person/bracket_joiner.h"
#include "tools/reported_contact.h"
#include "tools/stream/contacts_line.h"

namespace foretouch::tools {
namespace {

constexpr std::size_t kStatusTopic = 0;
constexpr std::chrono::seconds kStatusEvery{1};
constexpr double kSecondsPerUs = 1e-6;
/// Poses are for the eye: steps per metre, or per unit of a quaternion. At the end of a chain of a
/// hundred links that is a micrometre.
constexpr double kPoseUnits = 1e8;

void writeRounded(double value, JsonWriter& out) {
  // Adding zero turns -0 into 0, which is shorter.
  out.value(std::round(value * kPoseUnits) / kPoseUnits + 0.0);
}

/// w, x, y, z and the translation of each link, flattened.
void writePose(const char* name, const Pose& pose, JsonWriter& out) {
  out.key(name);
  out.beginArray();
  for (std::size_t i = 0; i < pose.rotations.size(); ++i) {
    const Quaternion& q = pose.rotations[i];
    for (const double value : {q.w(), q.x(), q.y(), q.z()}) writeRounded(value, out);
    for (const double value : pose.translations[i]) writeRounded(value, out);
  }
  out.endArray();
}

void writeSolidStep(const WatchedSolid& solid, JsonWriter& out) {
  writePose("shown_from", solid.from, out);
  writePose("shown_to", solid.to, out);
  writeObject("solid", out, [&] {
    writeFields(solid, out, wire::shownState<WatchedSolid>(), wire::shownLengths<WatchedSolid>());
    if (solid.snapInUs >= 0) {
      out.field("snap_in", static_cast<double>(solid.snapInUs) * kSecondsPerUs);
    }
  });
}

SharedText shared(std::string text) {
  return std::make_shared<const std::string>(std::move(text));
}

}  // namespace

LiveEvents::LiveEvents(ViewFeed& feed, LiveWorld world, std::function<StatusMessage()> status)
    : feed_(feed), world_(std::move(world)), status_(std::move(status)) {}

void LiveEvents::setViewers(std::size_t count) {
  if ((count > 0) != (numViewers_ > 0)) feed_.watch(count > 0);
  numViewers_ = count;
  nextStatus_ = Time();
}

void LiveEvents::collect(Time now, std::vector<ViewEvent>& events) {
  if (now >= nextStatus_) {
    events.push_back(statusEvent());
    nextStatus_ = now + kStatusEvery;
  }
  const std::int64_t nowUs =
      std::chrono::duration_cast<std::chrono::microseconds>(now.time_since_epoch()).count();
  for (std::size_t avatar = 0; avatar < feed_.numAvatars(); ++avatar) {
    if (feed_.take(avatar, nowUs, batch_)) events.push_back(stepEvent(avatar));
  }
}

ViewEvent LiveEvents::statusEvent() const {
  const StatusMessage status = status_();
  std::string text;
  JsonWriter out(text);
  out.field("answered", status.answered);
  out.field("rejected", status.rejected);
  out.field("lost", status.lost);
  out.field("gaps", status.gaps);
  out.field("waiting", status.waiting);
  out.field("query_p50_us", status.queryP50Us);
  out.field("query_p99_us", status.queryP99Us);
  out.field("answer_p50_us", status.latencyP50Us);
  out.field("answer_p99_us", status.latencyP99Us);
  out.field("viewers", numViewers_);
  ViewEvent event;
  event.topic = kStatusTopic;
  event.name = "status";
  event.fields = shared(std::move(text));
  return event;
}

std::string LiveEvents::stepFields(std::size_t avatar) const {
  const WatchedStep& step = batch_.newest();
  std::string text;
  JsonWriter out(text);
  out.field("avatar", world_.avatarIds[avatar]);
  out.field("sequence", step.sequence);
  out.key("utime");
  out.beginArray();
  out.value(step.utimeFromUs);
  out.value(step.utimeToUs);
  out.endArray();
  out.field("t0", secondsOf(step.utimeFromUs));
  out.field("t1", secondsOf(step.utimeToUs));
  out.field("kind", toString(step.kind));
  out.field("lost", step.lost);
  out.field("query_us", step.queryUs);
  out.field("added_us", step.addedUs);
  writePose("from", step.from, out);
  writePose("to", step.to, out);
  if (step.isSolid) writeSolidStep(step.solid, out);
  if (!batch_.brackets().empty()) writePerson(out);
  return text;
}

/// Writes the brackets of all steps of the batch, as a report's touches of a person, step by step.
void LiveEvents::writePerson(JsonWriter& out) const {
  out.list("person", batch_.brackets(), [&](const WatchedBracket& watched) {
    const LinkBracket& bracket = watched.bracket;
    const double from = secondsOf(watched.utimeFromUs), to = secondsOf(watched.utimeToUs);
    const auto at = [&](double t) { return from + t * (to - from); };
    PersonTouch touch;
    touch.link = bracket.link;
    touch.other = bracket.other;
    touch.isCertain = bracket.verdict == BracketVerdict::Certain;
    touch.beginsS[0] = at(bracket.possibleFrom);
    touch.beginsS[1] = at(bracket.certainFrom);
    touch.endsS[0] = at(bracket.certainUntil);
    touch.endsS[1] = at(bracket.possibleUntil);
    touch.growth = bracket.growth;
    const bool isOfScene = bracket.triangle >= 0;
    out.beginObject();
    writeShownTouch(touch, isOfScene ? world_.objectNames[world_.objectOf(bracket.triangle)] : "",
                    out);
    out.endObject();
  });
}

ViewEvent LiveEvents::stepEvent(std::size_t avatar) const {
  ViewEvent event;
  event.topic = kStatusTopic + 1 + avatar;
  event.name = "step";
  event.fields = shared(stepFields(avatar));
  event.steps = batch_.numSteps();
  event.numLeftOut = batch_.numLeftOut();
  event.contacts.count = batch_.contacts().size();
  if (event.contacts.count == 0) return event;
  std::string contacts;
  JsonWriter out(contacts);
  std::size_t next = 0;
  for (const BatchedStep& step : batch_.touchingSteps()) {
    for (; next < step.endOfContacts; ++next) write(batch_.contacts()[next], step, out);
  }
  event.contacts.text = shared(std::move(contacts));
  return event;
}

void LiveEvents::write(const LinkContact& contact, const BatchedStep& step, JsonWriter& out) const {
  const std::string link = std::to_string(contact.link);
  const std::string object =
      contact.triangle < 0 ? "\"\""
                           : jsonString(world_.objectNames[world_.objectOf(contact.triangle)]);
  ContactWords words;
  words.link = link;
  words.object = object;
  words.timeS = timeOf(contact, secondsOf(step.utimeFromUs), secondsOf(step.utimeToUs));
  words.utimeUs = utimeOf(step.utimeFromUs, step.utimeToUs, contact.toi);
  out.beginObject();
  out.field("sequence", step.sequence);
  writeContact(contact, words, out);
  out.endObject();
}

double LiveEvents::secondsOf(std::int64_t utimeUs) const {
  // In doubles: for a wrong sender's clock, a difference of integers might overflow.
  const double us = static_cast<double>(utimeUs) - static_cast<double>(world_.startUtimeUs);
  return us * kSecondsPerUs;
}

}  // namespace foretouch::tools
