// tools/stream/message_json.h: what all messages of a stream have in common as JSON.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "assets/json_writer.h"

namespace foretouch::tools {

/// Whether a line has the fields that no replay repeats: stamps, and the time that it took.
enum class Stamps : std::uint8_t { With, Without };

/// {"key":...} around what `write` writes, and a line break.
template <typename Write>
[[nodiscard]] std::string jsonLine(std::string_view key, const Write& write) {
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  out.key(key);
  write(out);
  out.endObject();
  return text + "\n";
}

/// Of one pose of an avatar.
template <typename Message>
void writeMessageHead(const Message& message, JsonWriter& out) {
  out.field("avatar", message.avatar);
  out.field("session", message.session);
  out.field("sequence", message.sequence);
  out.field("utime", message.utimeUs);
}

template <typename Message>
void writeStamps(const Message& message, const char* name, double took, Stamps stamps,
                 JsonWriter& out) {
  if (stamps == Stamps::Without) return;
  out.field("receive_utime", message.receiveUtimeUs);
  out.field("send_utime", message.sendUtimeUs);
  out.field(name, took);
}

}  // namespace foretouch::tools
