// tools/stream/event_line.h: the events of a log as lines of JSON (docs/formats.md, "Streams as
// lines of JSON"). Pure.
#pragma once

#include <string>

#include "network/log/event_log.h"
#include "tools/settings/channel_names.h"

namespace foretouch::tools {

/// One object and a line break: number, time and channel, and the message if it is one of ours;
/// else its size in bytes, and the reason for its refusal if the channel is ours.
[[nodiscard]] std::string eventLine(const LogEvent& event, const ChannelNames& channels);

}  // namespace foretouch::tools
