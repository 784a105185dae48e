#include "tools/stream/stream_touches.h"

#include <utility>

#include "tools/microseconds.h"
#include "tools/stream/contacts_line.h"

namespace foretouch::tools {
namespace {

/// Bound the memory against answers that no service sends: beyond so many touches all are ended as
/// open, beyond so many links the names are forgotten.
constexpr std::size_t kMostOpen = 4096;
constexpr std::size_t kMostNames = 4096;

}  // namespace

void StreamTouches::take(const ContactsMessage& message, const std::vector<bool>& onGround,
                         TouchEvents& events) {
  const bool follows = message.kind != StepKind::First && sequence_ &&
                       session_ == message.session && *sequence_ == message.sequenceFrom;
  if (!follows || tracker_.open() > kMostOpen) breakOff(events);
  avatar_ = message.avatar;
  session_ = message.session;
  sequence_ = message.sequenceTo;
  addRows(message, onGround);
  begun_.clear();
  tracker_.addStep(step_, ended_, begun_);
  for (const std::size_t i : begun_) {
    events.begun.push_back(named(TouchTracker::firstOf(step_.rows[i], step_.step)));
  }
  // What happened between the two poses is not known: what is open may have ended and begun again.
  if (message.kind == StepKind::AcrossGap) tracker_.breakOff(ended_);
  for (Touch& touch : ended_) events.ended.push_back(named(std::move(touch)));
  ended_.clear();
}

void StreamTouches::breakOff(TouchEvents& events) {
  tracker_.breakOff(ended_);
  for (Touch& touch : ended_) events.ended.push_back(named(std::move(touch)));
  ended_.clear();
}

void StreamTouches::addRows(const ContactsMessage& message, const std::vector<bool>& onGround) {
  if (names_.size() > kMostNames) names_.clear();
  step_.step = message.sequenceTo;
  step_.rows.clear();
  for (std::size_t i = 0; i < message.contacts.size(); ++i) {
    const AnsweredContact& answered = message.contacts[i];
    names_[answered.contact.link] = answered.linkName;
    TouchRow& row = step_.rows.emplace_back();
    row.contact = &answered.contact;
    row.object = answered.objectName;
    row.utimeUs = utimeOf(message, answered.contact.toi);
    row.timeS = static_cast<double>(row.utimeUs) / kUsPerS;
    row.isGround = i < onGround.size() && onGround[i];
  }
}

StreamTouch StreamTouches::named(Touch touch) const {
  const auto name = names_.find(touch.link);
  return {std::move(touch), avatar_, session_, name == names_.end() ? "" : name->second};
}

}  // namespace foretouch::tools
