#include "tools/stream/event_line.h"

#include <cstdint>

#include <fmt/format.h>

#include "assets/json_writer.h"
#include "network/wire/codec.h"
#include "network/wire/message_fields.h"
#include "tools/fields_json.h"
#include "tools/json_line.h"
#include "tools/stream/contacts_line.h"
#include "tools/stream/person_text.h"
#include "tools/stream/pushes_text.h"
#include "tools/stream/solid_text.h"

namespace foretouch::tools {
namespace {

void write(const SkeletonMessage& message, JsonWriter& out) {
  writeObject("skeleton", out, [&] {
    writeFields(message, out, wire::kSkeleton);
    writeRows("joints", message.skeleton.joints, out, wire::kSkeletonJoint);
  });
}

void write(const PoseMessage& message, JsonWriter& out) {
  writeObject("pose", out, [&] {
    writeFields(message, out, wire::kPose);
    writeRows("joints", message.joints, out, wire::kPoseJoint, wire::kPoseRotation);
    writeRows("translations", message.translations, out, wire::kMovedJoint, wire::kMovedPlace);
  });
}

void write(const ContactsMessage& message, JsonWriter& out) {
  writeObject("contacts", out, [&] { writeContacts(message, Stamps::With, out); });
}

void write(const SolidMessage& message, JsonWriter& out) {
  writeObject("solid", out, [&] { writeSolid(message, Stamps::With, out); });
}

void write(const PersonMessage& message, JsonWriter& out) {
  writeObject("person_step", out, [&] { writePerson(message, Stamps::With, out); });
}

void write(const PushesMessage& message, JsonWriter& out) {
  writeObject("pushes", out, [&] { writePushes(message, out); });
}

void write(const SpeakerMessage& message, JsonWriter& out) {
  constexpr unsigned kByteBits = 8, kLowByte = 0xff;
  const auto byte = [&](unsigned i) { return message.address >> (kByteBits * i) & kLowByte; };
  writeObject("speaker", out, [&] {
    out.field("avatar", message.avatar);
    out.field("utime", message.utimeUs);
    out.field("address", fmt::format("{}.{}.{}.{}", byte(3), byte(2), byte(1), byte(0)));
    out.field("port", message.port);
  });
}

void write(const StatusMessage& message, JsonWriter& out) {
  writeObject("status", out, [&] { writeStatus(message, out); });
}

template <typename Message>
void writeMessage(const LogEvent& event, JsonWriter& out) {
  Message message;
  const Reject reject = decode(event.payload, message);
  if (reject == Reject::None) return write(message, out);
  out.field("bytes", event.payload.size());
  out.field("refused", toString(reject));
}

void writeContent(const LogEvent& event, const ChannelNames& channels, JsonWriter& out) {
  if (event.channel == channels.pose) return writeMessage<PoseMessage>(event, out);
  if (event.channel == channels.skeleton) return writeMessage<SkeletonMessage>(event, out);
  if (event.channel == channels.contacts) return writeMessage<ContactsMessage>(event, out);
  if (event.channel == channels.solid) return writeMessage<SolidMessage>(event, out);
  if (event.channel == channels.person) return writeMessage<PersonMessage>(event, out);
  if (event.channel == channels.pushes) return writeMessage<PushesMessage>(event, out);
  if (event.channel == channels.speaker) return writeMessage<SpeakerMessage>(event, out);
  if (event.channel == channels.status) return writeMessage<StatusMessage>(event, out);
  out.field("bytes", event.payload.size());
}

}  // namespace

std::string eventLine(const LogEvent& event, const ChannelNames& channels) {
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  out.field("event", event.number);
  out.field("received", event.utimeUs);
  out.field("channel", event.channel);
  writeContent(event, channels, out);
  out.endObject();
  return text + "\n";
}

}  // namespace foretouch::tools
