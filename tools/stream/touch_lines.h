// tools/stream/touch_lines.h: the touches of a stream as lines: of JSON (docs/formats.md, "Streams
// as lines of JSON"), or for people. Pure.
#pragma once

#include <string>

#include "network/wire/messages.h"
#include "tools/stream/stream_touches.h"

namespace foretouch::tools {

/// {"touch":...} if it has ended, {"touch_begins":...} if it begins, and a line break.
[[nodiscard]] std::string endedTouchLine(const StreamTouch& ended);
[[nodiscard]] std::string begunTouchLine(const StreamTouch& begun);

/// What an answer brings, for people, a line each: "avatar 1, pose 42: 'LeftHand' touches 'table'
/// at 41 % of 33.3 ms", "... leaves 'table' after 0.512 s", and where a timeline begins or poses
/// are lost. Empty if nothing begins or ends.
[[nodiscard]] std::string touchesText(const ContactsMessage& message, const TouchEvents& events);

}  // namespace foretouch::tools
