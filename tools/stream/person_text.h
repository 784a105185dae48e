// tools/stream/person_text.h: what is known of the person of a stream as lines: of JSON
// (docs/formats.md, "Streams as lines of JSON"), or for people. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "assets/json_writer.h"
#include "network/wire/messages.h"
#include "tools/stream/contacts_line.h"

namespace foretouch::tools {

/// Writes the message's fields into an open object.
void writePerson(const PersonMessage& message, Stamps stamps, JsonWriter& out);
/// {"person_step":...} around these fields, and a line break.
[[nodiscard]] std::string personStepLine(const PersonMessage& message, Stamps stamps);

/// For people: "avatar 1, pose 42: the person surely touched 'LeftHand' on 'table', from 3.1 to 4.0
/// ms on".
[[nodiscard]] std::string personStepText(const PersonMessage& message);

/// Finds what is news for people. Bounded memory, whatever arrives.
class PersonNews {
 public:
  /// True if other links touch, surely or perhaps, than in the avatar's last step, if a bound is
  /// broken, or if links that were lost touched.
  [[nodiscard]] bool isNews(const PersonMessage& message);

 private:
  using Touching = std::vector<std::tuple<LinkId, LinkId, BracketVerdict>>;
  std::map<std::int32_t, Touching> last_;  // by avatar
};

}  // namespace foretouch::tools
