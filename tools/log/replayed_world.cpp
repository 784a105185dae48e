#include "tools/log/replayed_world.h"

#include "network/wire/codec.h"

namespace foretouch::tools {

void ReplayedWorld::take(const LogEvent& event, const ChannelNames& channels) {
  if (event.channel == channels.body) return tell(event, body_);
  if (event.channel == channels.rigidPose) return tell(event, rigid_);
  if (event.channel == channels.events) return compare(event, recorded_, journal_);
  if (event.channel == channels.pushes) compare(event, recordedPushes_, pushes_);
}

template <typename Message>
void ReplayedWorld::compare(const LogEvent& event, Message& message, JournalCheck& check) {
  if (decode(event.payload, message) != Reject::None) {
    ++unreadable_;
  } else {
    check.addRecorded(message, event.payload);
  }
}

bool ReplayedWorld::takeShown(const LogEvent& event) {
  const bool isReadable = decode(event.payload, recordedSolid_) == Reject::None;
  if (!isReadable || !solver_.isSolid(recordedSolid_.avatar)) return false;
  solids_.addRecorded(recordedSolid_, event.payload);
  return true;
}

/// The service recorded what it accepted, and then moved the watermark.
template <typename Message>
void ReplayedWorld::tell(const LogEvent& event, Message& message) {
  if (decode(event.payload, message) != Reject::None) {
    ++unreadable_;
    return;
  }
  if (solver_.take(message, event.utimeUs) == Reject::None) advance();
}

void ReplayedWorld::take(BodyNumber avatar, const StreamStep& step, std::int64_t receiveUtimeUs) {
  if (solver_.take(avatar, step, receiveUtimeUs) == Reject::None) advance();
}

void ReplayedWorld::advance() {
  solver_.advance(answers_);
  for (const ShownBody& body : solver_.shown()) {
    ++numShown_;
    add(body.solid, solids_);
    add(body.pushes, pushes_);
  }
  for (const EventsMessage& answer : answers_) {
    ++numAnswers_;
    if (sink_) sink_(answer);
    add(answer, journal_);
  }
}

template <typename Message>
void ReplayedWorld::add(const Message& message, JournalCheck& check) {
  if (!compares_) return;
  encode(message, payload_);
  check.addReplayed(message, payload_);
}

}  // namespace foretouch::tools
