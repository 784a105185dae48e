#include "tools/stream/event_line.h"

#include <cstdint>

#include <fmt/format.h>

#include "assets/json_writer.h"
#include "network/wire/codec.h"
#include "tools/stream/contacts_line.h"
#include "tools/stream/person_text.h"
#include "tools/stream/pushes_text.h"
#include "tools/stream/solid_text.h"

namespace foretouch::tools {
namespace {

void writeRotation(const Quaternion& q, JsonWriter& out) {
  out.key("rotation");
  out.beginArray();
  for (const double value : {q.w(), q.x(), q.y(), q.z()}) out.value(value);
  out.endArray();
}

void write(const SkeletonMessage& message, JsonWriter& out) {
  out.key("skeleton");
  out.beginObject();
  out.field("avatar", message.avatar);
  out.field("session", message.session);
  out.field("send_utime", message.sendUtimeUs);
  out.field("generation", message.generation);
  out.field("hash", hashText(message.hash));
  out.field("source", message.source);
  out.field("rate", message.rateHz);
  out.list("joints", message.skeleton.joints, [&](const RawJoint& joint) {
    out.beginObject();
    out.field("name", joint.name);
    out.field("parent", joint.parent);
    out.field("offset", joint.offset);
    writeRotation(joint.rotation, out);
    out.endObject();
  });
  out.endObject();
}

void write(const PoseMessage& message, JsonWriter& out) {
  out.key("pose");
  out.beginObject();
  out.field("avatar", message.avatar);
  out.field("session", message.session);
  out.field("sequence", message.sequence);
  out.field("utime", message.utimeUs);
  out.field("send_utime", message.sendUtimeUs);
  out.field("skeleton_hash", hashText(message.skeletonHash));
  out.list("joints", message.joints, [&](const PoseJoint& joint) {
    out.beginObject();
    out.field("joint", joint.joint);
    out.field("flags", joint.flags);
    writeRotation(joint.rotation, out);
    out.endObject();
  });
  out.list("translations", message.translations, [&](const PoseTranslation& translation) {
    out.beginObject();
    out.field("joint", translation.joint);
    out.field("translation", translation.translation);
    out.endObject();
  });
  out.endObject();
}

void write(const ContactsMessage& message, JsonWriter& out) {
  out.key("contacts");
  writeContacts(message, Stamps::With, out);
}

void write(const SolidMessage& message, JsonWriter& out) {
  out.key("solid");
  writeSolid(message, Stamps::With, out);
}

void write(const PersonMessage& message, JsonWriter& out) {
  out.key("person_step");
  writePerson(message, Stamps::With, out);
}

void write(const PushesMessage& message, JsonWriter& out) {
  out.key("pushes");
  writePushes(message, out);
}

void write(const SpeakerMessage& message, JsonWriter& out) {
  constexpr unsigned kByteBits = 8, kLowByte = 0xff;
  const auto byte = [&](unsigned i) { return message.address >> (kByteBits * i) & kLowByte; };
  out.key("speaker");
  out.beginObject();
  out.field("avatar", message.avatar);
  out.field("utime", message.utimeUs);
  out.field("address", fmt::format("{}.{}.{}.{}", byte(3), byte(2), byte(1), byte(0)));
  out.field("port", message.port);
  out.endObject();
}

void write(const StatusMessage& message, JsonWriter& out) {
  out.key("status");
  writeStatus(message, out);
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
