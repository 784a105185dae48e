#include "tools/log/replayed_world.h"

#include "network/wire/codec.h"

namespace foretouch::tools {

void ReplayedWorld::take(const LogEvent& event, const ChannelNames& channels) {
  if (event.channel == channels.body) return tell(event, body_);
  if (event.channel == channels.rigidPose) return tell(event, rigid_);
  if (event.channel != channels.events) return;
  if (decode(event.payload, recorded_) != Reject::None) {
    ++unreadable_;
  } else {
    journal_.addRecorded(recorded_, event.payload);
  }
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
  for (const EventsMessage& answer : answers_) {
    ++numAnswers_;
    if (sink_) sink_(answer);
    if (!compares_) continue;
    encode(answer, payload_);
    journal_.addReplayed(answer, payload_);
  }
}

}  // namespace foretouch::tools
