// tools/stream/contacts_line.h: the answers and heartbeats of a stream as lines: of JSON
// (docs/formats.md, "Streams as lines of JSON"), or for people. Pure: the same message gives the
// same text.
#pragma once

#include <cstdint>
#include <string>

#include "assets/json_writer.h"
#include "network/wire/messages.h"
#include "tools/stream/message_json.h"

namespace foretouch::tools {

/// The fields of an answer and of a heartbeat, into an open object.
void writeContacts(const ContactsMessage& message, Stamps stamps, JsonWriter& out);
void writeStatus(const StatusMessage& message, JsonWriter& out);

/// writeContacts() and a line break. The objects of its `contacts` are those of a results file,
/// with "utime" instead of "time".
[[nodiscard]] std::string contactsLine(const ContactsMessage& message, Stamps stamps);

/// The same for people: "avatar 1, pose 42: LeftHand touches 'table' at 41 % of 33.3 ms".
[[nodiscard]] std::string contactsText(const ContactsMessage& message);

/// {"status":...} around writeStatus(), and a line break.
[[nodiscard]] std::string statusLine(const StatusMessage& message);
/// The same for people.
[[nodiscard]] std::string statusText(const StatusMessage& message);

/// Microseconds since the epoch of the instant `toi` within the step from `fromUs` to `toUs`,
/// rounded down: never later than the contact.
[[nodiscard]] std::int64_t utimeOf(std::int64_t fromUs, std::int64_t toUs, double toi);
[[nodiscard]] std::int64_t utimeOf(const ContactsMessage& message, double toi);

}  // namespace foretouch::tools
