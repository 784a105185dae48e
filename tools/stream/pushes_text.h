// tools/stream/pushes_text.h: what moves and presses against a solid body as lines: of JSON
// (docs/formats.md, "Streams as lines of JSON"), or for people. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "assets/json_writer.h"
#include "network/wire/world_messages.h"
#include "tools/stream/contacts_line.h"

namespace foretouch::tools {

/// Writes the message's fields into an open object.
void writePushes(const PushesMessage& message, JsonWriter& out);
/// {"pushes":...} around these fields, and a line break.
[[nodiscard]] std::string pushesLine(const PushesMessage& message);

/// For people: "avatar 1, pose 42: body 3 presses 'LeftHand' (12 mm)".
[[nodiscard]] std::string pushesText(const PushesMessage& message);

/// Finds what is news for people. Bounded memory, whatever arrives.
class PushesNews {
 public:
  /// True if other bodies press or crush, or at other links, than at the body's last tick; a first
  /// tick is no news if nothing presses.
  [[nodiscard]] bool isNews(const PushesMessage& message);

 private:
  using Pair = std::pair<std::int32_t, LinkId>;
  struct Last {
    std::set<Pair> pressing, crushing;
  };
  std::map<std::int32_t, Last> last_;  // by avatar
};

}  // namespace foretouch::tools
