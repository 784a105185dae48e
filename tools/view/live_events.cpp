#include "tools/view/live_events.h"

#include <cmath>
#include <iterator>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "tools/contact_json.h"
#include "tools/json_text.h"
#include "tools/stream/contacts_line.h"

namespace foretouch::tools {
namespace {

constexpr std::size_t kStatusTopic = 0;
constexpr std::chrono::seconds kStatusEvery{1};
constexpr double kSecondsPerUs = 1e-6;
/// Poses are for the eye: so many to a metre, or to the length of a quaternion. At the end of a
/// chain of a hundred links that is a micrometre.
constexpr double kPoseUnits = 1e8;

using Text = fmt::memory_buffer;

void appendRounded(double value, Text& text) {
  // Adding zero makes -0 the 0 that is shorter.
  fmt::format_to(std::back_inserter(text), "{}", std::round(value * kPoseUnits) / kPoseUnits + 0.0);
}

/// w, x, y, z and the translation of each link, flattened.
void appendPose(const char* name, const Pose& pose, Text& text) {
  fmt::format_to(std::back_inserter(text), ",\"{}\":", name);
  char separator = '[';
  const auto append = [&](double value) {
    text.push_back(separator);
    appendRounded(value, text);
    separator = ',';
  };
  for (std::size_t i = 0; i < pose.rotations.size(); ++i) {
    const Quaternion& q = pose.rotations[i];
    for (const double value : {q.w(), q.x(), q.y(), q.z()}) append(value);
    for (const double value : pose.translations[i]) append(value);
  }
  text.push_back(']');
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
  ViewEvent event;
  event.topic = kStatusTopic;
  event.name = "status";
  event.head = shared(fmt::format(
      R"({{"answered":{},"rejected":{},"lost":{},"gaps":{},"waiting":{},"query_p50_us":{},"query_p99_us":{},"answer_p50_us":{},"answer_p99_us":{},"viewers":{})",
      status.answered, status.rejected, status.lost, status.gaps, status.waiting,
      numberText(status.queryP50Us), numberText(status.queryP99Us), numberText(status.latencyP50Us),
      numberText(status.latencyP99Us), numViewers_));
  return event;
}

ViewEvent LiveEvents::stepEvent(std::size_t avatar) const {
  const WatchedStep& step = batch_.newest();
  Text text;
  fmt::format_to(
      std::back_inserter(text),
      R"({{"avatar":{},"sequence":{},"utime":[{},{}],"t0":{},"t1":{},"kind":"{}","lost":{},"query_us":{},"added_us":{})",
      world_.avatarIds[avatar], step.sequence, step.utimeFromUs, step.utimeToUs,
      numberText(secondsOf(step.utimeFromUs)), numberText(secondsOf(step.utimeToUs)),
      toString(step.kind), step.lost, numberText(step.queryUs), numberText(step.addedUs));
  appendPose("from", step.from, text);
  appendPose("to", step.to, text);

  ViewEvent event;
  event.topic = kStatusTopic + 1 + avatar;
  event.name = "step";
  event.head = shared(fmt::to_string(text));
  event.steps = batch_.numSteps();
  event.numLeftOut = batch_.numLeftOut();
  event.contacts.count = batch_.contacts().size();
  if (event.contacts.count == 0) return event;
  std::string contacts;
  for (const WatchedContact& watched : batch_.contacts()) {
    if (!contacts.empty()) contacts += ',';
    contacts += contactText(watched);
  }
  event.contacts.text = shared(std::move(contacts));
  return event;
}

std::string LiveEvents::contactText(const WatchedContact& watched) const {
  const LinkContact& contact = watched.contact;
  const std::string link = std::to_string(contact.link);
  const std::string object =
      contact.triangle < 0 ? "\"\""
                           : jsonString(world_.objectNames[world_.objectOf(contact.triangle)]);
  const double fromS = secondsOf(watched.utimeFromUs);
  const double spanS = secondsOf(watched.utimeToUs) - fromS;
  const std::string instant =
      fmt::format(R"("time":{},"utime":{})", numberText(fromS + contact.toi * spanS),
                  utimeOf(watched.utimeFromUs, watched.utimeToUs, contact.toi));
  std::string text = fmt::format(R"({{"sequence":{},)", watched.sequence);
  std::string rest;
  appendContact(contact, {link, object, toString(watched.reason), instant}, rest);
  return text.append(rest, 1, std::string::npos);  // without its brace
}

double LiveEvents::secondsOf(std::int64_t utimeUs) const {
  // Whatever a sender's clock says: no difference of integers, which might not fit.
  const double us = static_cast<double>(utimeUs) - static_cast<double>(world_.startUtimeUs);
  return us * kSecondsPerUs;
}

}  // namespace foretouch::tools
