// tools/stream/solid_text.h: what a solid avatar shows in a stream as lines: of JSON
// (docs/formats.md, "Streams as lines of JSON"), or for people. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "assets/json_writer.h"
#include "network/wire/messages.h"
#include "tools/stream/contacts_line.h"

namespace foretouch::tools {

/// Writes the message's fields into an open object.
void writeSolid(const SolidMessage& message, Stamps stamps, JsonWriter& out);
/// {"solid":...} around these fields, and a line break.
[[nodiscard]] std::string solidLine(const SolidMessage& message, Stamps stamps);

/// For people: "avatar 1, pose 42: shown sliding, 31.2 mm from the tracked pose: 'LeftHand' on
/// 'table'".
[[nodiscard]] std::string solidText(const SolidMessage& message);

/// Finds the shown poses that are news for people. Bounded memory, whatever arrives.
class SolidNews {
 public:
  /// True if the avatar's state or limit is not that of its last pose, if a snap is announced,
  /// or if the pose is its first.
  [[nodiscard]] bool isNews(const SolidMessage& message);

 private:
  struct Last {
    SolidState state = SolidState::Placing;
    SolidLimit limit = SolidLimit::None;
    bool snaps = false;
  };
  std::map<std::int32_t, Last> last_;  // by avatar
};

}  // namespace foretouch::tools
