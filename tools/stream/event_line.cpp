#include "tools/stream/event_line.h"

#include <cstdint>

#include <fmt/format.h>

#include "network/wire/codec.h"
#include "tools/json_text.h"
#include "tools/stream/contacts_line.h"

namespace foretouch::tools {
namespace {

std::string numbers(const Eigen::Vector3d& v) {
  return fmt::format("[{},{},{}]", numberText(v.x()), numberText(v.y()), numberText(v.z()));
}

std::string numbers(const Quaternion& q) {
  return fmt::format("[{},{},{},{}]", numberText(q.w()), numberText(q.x()), numberText(q.y()),
                     numberText(q.z()));
}

/// Beyond what a JSON number holds everywhere.
std::string hashText(std::int64_t hash) {
  return fmt::format("\"{:016x}\"", static_cast<std::uint64_t>(hash));
}

std::string fieldOf(const SkeletonMessage& message) {
  std::string text = fmt::format(
      R"("skeleton":{{"avatar":{},"session":{},"send_utime":{},"generation":{},"hash":{},"source":{},"rate":{},"joints":[)",
      message.avatar, message.session, message.sendUtimeUs, message.generation,
      hashText(message.hash), jsonString(message.source), numberText(message.rateHz));
  const char* separator = "";
  for (const RawJoint& joint : message.skeleton.joints) {
    text += fmt::format(R"({}{{"name":{},"parent":{},"offset":{},"rotation":{}}})", separator,
                        jsonString(joint.name), joint.parent, numbers(joint.offset),
                        numbers(joint.rotation));
    separator = ",";
  }
  return text + "]}";
}

std::string fieldOf(const PoseMessage& message) {
  std::string text = fmt::format(
      R"("pose":{{"avatar":{},"session":{},"sequence":{},"utime":{},"send_utime":{},"skeleton_hash":{},"joints":[)",
      message.avatar, message.session, message.sequence, message.utimeUs, message.sendUtimeUs,
      hashText(message.skeletonHash));
  const char* separator = "";
  for (const PoseJoint& joint : message.joints) {
    text += fmt::format(R"({}{{"joint":{},"flags":{},"rotation":{}}})", separator, joint.joint,
                        joint.flags, numbers(joint.rotation));
    separator = ",";
  }
  text += R"(],"translations":[)";
  separator = "";
  for (const PoseTranslation& translation : message.translations) {
    text += fmt::format(R"({}{{"joint":{},"translation":{}}})", separator, translation.joint,
                        numbers(translation.translation));
    separator = ",";
  }
  return text + "]}";
}

std::string fieldOf(const ContactsMessage& message) {
  std::string object = contactsLine(message, Stamps::With);
  object.pop_back();  // the line break
  return "\"contacts\":" + object;
}

std::string fieldOf(const StatusMessage& message) {
  const std::string line = statusLine(message);  // {"status":{...}} and a line break
  return line.substr(1, line.size() - 3);
}

template <typename Message>
std::string readField(const LogEvent& event) {
  Message message;
  const Reject reject = decode(event.payload, message);
  if (reject == Reject::None) return fieldOf(message);
  return fmt::format(R"("bytes":{},"refused":"{}")", event.payload.size(), toString(reject));
}

std::string contentOf(const LogEvent& event, const ChannelNames& channels) {
  if (event.channel == channels.pose) return readField<PoseMessage>(event);
  if (event.channel == channels.skeleton) return readField<SkeletonMessage>(event);
  if (event.channel == channels.contacts) return readField<ContactsMessage>(event);
  if (event.channel == channels.status) return readField<StatusMessage>(event);
  return fmt::format(R"("bytes":{})", event.payload.size());
}

}  // namespace

std::string eventLine(const LogEvent& event, const ChannelNames& channels) {
  return fmt::format("{{\"event\":{},\"received\":{},\"channel\":{},{}}}\n", event.number,
                     event.utimeUs, jsonString(event.channel), contentOf(event, channels));
}

}  // namespace foretouch::tools
